// The background: one quad, visible where nothing else was drawn. Here a_view_matrix contains the rays of the view's
// pixels (cpp/cubecam/render/resources/sky_rays.hpp), without the camera's position: moving it does not move the sky.
#include "include/view.glsl"

layout(location = 0) uniform float u_depth;  // the clear value of the depth buffer

flat out mat3 v_rays;
flat out vec2 v_centre;

invariant gl_Position;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    v_rays = mat3(a_view_matrix);
    v_centre = a_view_matrix[3].xy;
    gl_Position = vec4(corner, u_depth, 1.0);
    route_to_layer();
}
