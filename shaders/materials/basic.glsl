// An unlit material. material[0].rgb: colour.
#include "include/tint.glsl"

#ifdef HAS_CUBEMAP
layout(binding = UNIT_CUBEMAP) uniform samplerCube u_cubemap;
#endif

vec4 shade(Surface surface) {
    vec4 tint = tint_of(surface);
    vec3 color = material[0].rgb * tint.rgb;
#ifdef HAS_CUBEMAP
    color *= texture(u_cubemap, surface.position_object).rgb;
#endif
    return vec4(color, tint.a);
}
