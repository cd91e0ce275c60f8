// This pass writes only depth. A surface with holes has none there.
#ifdef HOLES
#define STAGE in
#include "include/mask.glsl"
#ifdef UNIT_MASK
layout(binding = UNIT_MASK) uniform sampler2D u_map;
#endif

void main() {
    float alpha = u_mask.x;
#ifdef UNIT_MASK
    alpha *= texture(u_map, v_uv).a;
#endif
#ifdef HAS_VERTEX_COLORS
    alpha *= v_alpha;
#endif
    if (alpha < u_mask.y) discard;
}
#else
void main() {}
#endif
