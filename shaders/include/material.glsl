// The GLSL file of the material replaces this file (cpp/cubecam/render/passes/programs.cpp).
