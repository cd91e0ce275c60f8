// A draw call: a node (cpp/cubecam/render/passes/draw_block.hpp writes this block). Fragment shaders get what they need of
// it as flat inputs (surface.glsl), except a user's source.
layout(std140, binding = 0) uniform Draw {
    mat4 u_model;          // to the world, counted from u_origin
    mat4 u_normal_matrix;  // inverse transpose of u_model, upper 3x3
    float u_alpha;         // opacity and the colours' alpha; shade() returns what else counts
    int u_node_id;
    vec4 u_origin;         // xyz: world position of the view; positions are small near it, and floats precise
};
