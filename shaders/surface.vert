// Every mesh, for every view. One source and an invariant position: layered and one-pass drawing give equal bytes.
#include "view.glsl"
#include "draw.glsl"

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
#ifdef HAS_MAP
layout(location = 2) in vec2 a_uv;
out vec2 v_uv;
#endif
#ifdef HAS_VERTEX_COLORS
layout(location = 3) in vec4 a_color;
out vec4 v_color;
#endif
#ifdef HAS_CUBE
out vec3 v_position_object;
#endif

invariant gl_Position;
out vec3 v_position;  // world
out vec3 v_normal;    // world, any length
flat out vec4 v_eye;
#ifdef OUTPUTS
flat out vec4 v_view_position;
flat out vec3 v_view_forward;
#endif

void main() {
    vec4 position_world = u_model * vec4(a_position, 1.0);
    gl_Position = a_view_matrix * position_world;
    route_to_layer();
    v_position = position_world.xyz;
    v_normal = mat3(u_normal_matrix) * a_normal;
    v_eye = a_view_eye;
#ifdef HAS_MAP
    v_uv = a_uv;
#endif
#ifdef HAS_VERTEX_COLORS
    v_color = a_color;
#endif
#ifdef HAS_CUBE
    v_position_object = a_position;
#endif
#ifdef OUTPUTS
    v_view_position = a_view_position;
    v_view_forward = a_view_forward.xyz;
#endif
}
