// One draw call: a node (cpp/cubecam/render/surface_pass.cpp writes this block).
layout(std140, binding = 0) uniform Draw {
    mat4 u_model;
    mat4 u_normal_matrix;  // inverse transpose of u_model, upper 3x3
    vec4 u_color;          // linear RGB; a: the surface's whole alpha but for maps and vertex colours
    vec4 u_tint;
    vec4 u_parameters;     // the material's own, see its file
    int u_node_id;
    int u_translucent;     // 0: alpha is written as 1
};
