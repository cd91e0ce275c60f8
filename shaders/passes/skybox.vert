// The background: one quad, visible where nothing else was drawn. Here a_view_matrix goes from clip space to the world
// without translation, so moving the camera does not move the sky.
#include "include/view.glsl"

layout(location = 0) uniform float u_depth;  // the clear value of the depth buffer

out vec4 v_near;
out vec4 v_far;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    v_near = a_view_matrix * vec4(corner, -1.0, 1.0);
    v_far = a_view_matrix * vec4(corner, 1.0, 1.0);
    gl_Position = vec4(corner, u_depth, 1.0);
    route_to_layer();
}
