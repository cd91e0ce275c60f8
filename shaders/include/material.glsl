// Stands for the GLSL file of the material, which takes its place (cpp/cubecam/render/passes/programs.cpp).
