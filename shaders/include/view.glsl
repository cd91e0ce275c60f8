// A view: one record an instance (cpp/cubecam/render/resources/instance.hpp).
layout(location = 4) in mat4 a_view_matrix;
layout(location = 8) in vec4 a_view_eye;
layout(location = 9) in vec4 a_view_position;
layout(location = 10) in vec4 a_view_forward;

// Sends the triangle to the view's layer. Without the extension each layer is bound alone, and nothing is to be said.
void route_to_layer() {
#ifdef LAYERED
    gl_Layer = int(a_view_forward.w);
#endif
}
