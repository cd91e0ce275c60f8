// A node (cpp/cubecam/render/resources/node_record.hpp). If nodes are drawn together (INSTANCED), each node is a record
// of attributes; otherwise the node is a uniform block. Fragment shaders get the values that they need as flat inputs
// (surface.glsl), except a user's source, which has the block.
#ifdef INSTANCED
layout(location = 4) in vec4 a_model[4];          // columns; [0].w: alpha
layout(location = 8) in vec4 a_normal_matrix[3];  // columns
#ifdef FLAT_MATERIAL
layout(location = 11) in vec4 a_material[MATERIAL_SIZE];
#define u_material a_material
#endif
#if defined(OUTPUTS) || defined(SCREEN_REFLECTIONS)
layout(location = 13) in ivec2 a_id_and_label;
#define u_node_id a_id_and_label.x
#define u_label a_id_and_label.y
#endif
#define u_model mat4(vec4(a_model[0].xyz, 0.0), vec4(a_model[1].xyz, 0.0), vec4(a_model[2].xyz, 0.0), \
                     vec4(a_model[3].xyz, 1.0))
#define u_normal_matrix mat3(a_normal_matrix[0].xyz, a_normal_matrix[1].xyz, a_normal_matrix[2].xyz)
#define u_alpha a_model[0].w
#else
layout(std140, binding = 0) uniform Node {
    mat4 u_model;          // to the world, relative to u_origin
    mat4 u_normal_matrix;  // inverse transpose of u_model, upper 3x3
    float u_alpha;         // opacity and the colours' alpha; shade() returns all other factors
    int u_node_id;
    int u_label;
    vec4 u_origin;         // xyz: world position of the view; near it positions are small, so floats are precise
};
#endif
