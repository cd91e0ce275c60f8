// The metallic-roughness material of glTF 2.0 (section 3.9, appendix B) and the KHR_materials extensions. The layers lie,
// from below: metal or dielectric, sheen, emission, clear coat. Every extension is a switch: llvmpipe runs both sides of
// a branch.
#include "materials/standard/constants.glsl"
#include "materials/standard/maps.glsl"
#ifndef UNLIT
#include "materials/standard/normals.glsl"
#include "materials/standard/microfacets.glsl"
#include "include/main_direction.glsl"
#include "materials/standard/point.glsl"
#include "materials/standard/anisotropy.glsl"
#include "materials/standard/iridescence.glsl"
#include "materials/standard/fresnel.glsl"
#include "materials/standard/sheen.glsl"
#include "materials/standard/clearcoat.glsl"
#include "materials/standard/transmission.glsl"
#include "materials/standard/sampled.glsl"
#include "materials/standard/environment.glsl"
#include "materials/standard/lights.glsl"

// The light that the surface sends to the eye.
vec3 light_of(Point point) {
    vec3 base = sheen_over(point, base_under_environment(point));
    vec3 coat = point.occlusion * coat_under_environment(point);
    add_lights(point, base, coat);
    base += point.emission;
    return coat_over(point, base, coat);
}
#endif

vec4 shade(Surface surface) {
    vec4 base = base_color(surface);
#ifdef UNLIT
    vec3 light = base.rgb;
#else
    vec3 light = light_of(point_of(surface, base.rgb));
#endif
    // The end of the shader: the lookups above need the values of neighbour fragments.
#ifdef ALPHA_MASK
    if (base.a * COLOR.a < ALPHA_CUTOFF) discard;
    base.a = 1.0;
#elif defined(ALPHA_OPAQUE)
    base.a = 1.0;
#endif
    return vec4(light, base.a);
}
