// Casters of one light. Here a_view_matrix goes directly from the mesh's own space to clip space.
#include "include/view.glsl"

layout(location = 0) in vec3 a_position;
#ifdef HOLES
#define STAGE out
#include "include/mask.glsl"
#ifdef UNIT_MASK
layout(location = MASK_UV) in vec2 a_uv;
#endif
#ifdef HAS_VERTEX_COLORS
layout(location = 3) in vec4 a_color;
#endif
#endif

// A caster covers the same texels whether it has holes or not.
invariant gl_Position;
#ifdef UNIT_MASK
invariant v_uv;
#endif

void main() {
    gl_Position = a_view_matrix * vec4(a_position, 1.0);
#ifdef UNIT_MASK
    v_uv = vec2(dot(u_mask_rows[0].xyz, vec3(a_uv, 1.0)), dot(u_mask_rows[1].xyz, vec3(a_uv, 1.0)));
#endif
#if defined(HOLES) && defined(HAS_VERTEX_COLORS)
    v_alpha = a_color.a;
#endif
}
