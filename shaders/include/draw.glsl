// A draw call: a node (cpp/cubecam/render/passes/draw_block.hpp writes this block).
//
// Fragment shaders get what they need of it as flat inputs (surface.glsl), which llvmpipe loads once a triangle, while it
// reads a uniform block anew for every eight pixels (docs/adr/0004).
layout(std140, binding = 0) uniform Draw {
    mat4 u_model;          // to the world, counted from u_origin
    mat4 u_normal_matrix;  // inverse transpose of u_model, upper 3x3
    vec4 u_material[2];    // the material's own, see its file
    float u_alpha;         // opacity and the colours' alpha; maps and vertex colours come on top
    int u_node_id;
    vec4 u_origin;         // xyz: world position of the view; positions are small near it, and floats precise
};
