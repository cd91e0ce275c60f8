// The source of a ShaderMaterial or an ImageEffect replaces this file (cpp/cubecam/render/passes/user_program.cpp).
