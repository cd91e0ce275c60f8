// Stands for the source of a ShaderMaterial or an ImageEffect, which takes its place (cpp/cubecam/render/passes/user_program.cpp).
