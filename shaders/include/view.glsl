// A view (cpp/cubecam/render/resources/view_record.hpp): one record for each instance or, if the instances are nodes
// (INSTANCED), a uniform block.
#ifdef INSTANCED
layout(std140, binding = 4) uniform View {
    mat4 u_view_matrix;
    vec4 u_view_eye;
    vec4 u_view_position;
    vec4 u_view_forward;
    vec4 u_origin;  // xyz: world position of the origin of positions
};
#define a_view_matrix u_view_matrix
#define a_view_eye u_view_eye
#define a_view_position u_view_position
#define a_view_forward u_view_forward
#else
layout(location = 4) in mat4 a_view_matrix;
layout(location = 8) in vec4 a_view_eye;
layout(location = 9) in vec4 a_view_position;
layout(location = 10) in vec4 a_view_forward;
#endif

// Sends the triangle to the view's layer. Without the extension each layer is bound alone, and this function does
// nothing.
void route_to_layer() {
#ifdef LAYERED
    gl_Layer = int(a_view_forward.w);
#endif
}
