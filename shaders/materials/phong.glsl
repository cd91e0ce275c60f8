// B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975, with white highlights.
// material[0]: ka * color * (1 + ambient light), shininess. material[1]: kd * color, ks.
#include "include/tint.glsl"

#if !defined(LIGHT_COUNT) || LIGHT_COUNT > 0
vec3 light_answer(Surface surface, vec3 tint, int index, Light source) {
    vec4 place = source.position;
    vec4 light = source.color;
    vec3 to_light = place.xyz - surface.from_origin * is_at_place(place);
    float distance_squared = dot(to_light, to_light);
    to_light *= inversesqrt(max(distance_squared, 1e-36));  // a light on the surface must not give NaN
    float n_dot_l = dot(surface.normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
    // dot(reflect(-to_light, normal), -incident)
    float r_dot_v = dot(to_light, surface.incident) - 2.0 * n_dot_l * dot(surface.normal, surface.incident);
    float highlight = pow(clamp(r_dot_v, 0.0, 1.0), material[0].a);
    vec3 answer = n_dot_l * material[1].rgb * tint + material[1].a * highlight;
#ifdef LIGHT_DECAY
    answer *= place.w == 0.0 ? 1.0 : pow(distance_squared, -0.5 * light.a);
#endif
#ifdef LIGHT_RANGE
    answer *= range_share(place, distance_squared);
#endif
#ifdef LIGHT_CONE
    answer *= cone_share(source.cone, -to_light);
#endif
    answer *= light_visibility(index, surface.from_origin, surface.normal);
    return answer * light.rgb;
}
#endif

vec4 shade(Surface surface) {
    vec4 tint = tint_of(surface);
    vec3 result = material[0].rgb * tint.rgb;
#if FLAT_LIGHT_COUNT > 0
    for (int i = 0; i < FLAT_LIGHT_COUNT; ++i) result += light_answer(surface, tint.rgb, i, flat_light(i));
#endif
#ifndef LIGHT_COUNT
    for (int i = 0; i < u_counts.x; ++i) result += light_answer(surface, tint.rgb, i, u_lights[i]);
#elif LIGHT_COUNT > FLAT_LIGHT_COUNT
    for (int i = FLAT_LIGHT_COUNT; i < LIGHT_COUNT; ++i) {
        result += light_answer(surface, tint.rgb, i, u_lights[i]);
    }
#endif
    return vec4(result, tint.a);
}
