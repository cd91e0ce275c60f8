// Lights that have a direction. They are in the units of KHR_lights_punctual: lux for directional lights, candela for the
// others if their decay is 2. Light that facets scatter more than once is left out.
#if !defined(LIGHT_COUNT) || LIGHT_COUNT > 0
void add_light(Point point, int index, Light source, inout vec3 base, inout vec3 coat) {
    vec3 to_light = source.position.xyz - point.from_origin * is_at_place(source.position);
    float distance_squared = dot(to_light, to_light);
    to_light *= inversesqrt(max(distance_squared, 1e-36));  // a light on the surface must not give NaN
    vec3 half_way = to_light + point.view;
    half_way *= inversesqrt(max(dot(half_way, half_way), 1e-36));
    float n_dot_l = dot(point.normal, to_light);
    float v_dot_h = dot(point.view, half_way);

    vec3 light = source.color.rgb;
#ifdef LIGHT_DECAY
    light *= source.position.w == 0.0 ? 1.0 : pow(distance_squared, -0.5 * source.color.a);
#endif
#ifdef LIGHT_RANGE
    light *= range_share(source.position, distance_squared);
#endif
#ifdef LIGHT_CONE
    light *= cone_share(source.cone, -to_light);
#endif
    light *= light_visibility(index, point.from_origin, point.geometric_normal);

#ifdef CLEARCOAT
    coat += light * coat_under_light(point, to_light, half_way);
#endif
    if (n_dot_l <= 0.0) return;
    float facet = 0.0;
    if (point.n_dot_v > LEAST_COSINE) {
        facet = facets_of(point, half_way) * unmasked_of(point, to_light, n_dot_l) *
                unmasked_of(point, point.view, point.n_dot_v);
    }
    vec3 dielectric = vec3(0.0);
#ifdef DIELECTRIC
    vec3 fresnel = dielectric_fresnel(point, v_dot_h);
    vec3 below = point.color / PI;
#ifdef TRANSMISSION
    below *= 1.0 - point.transmission;
#endif
    dielectric = fresnel * facet + (1.0 - max3(fresnel)) * below;
#endif
    vec3 metal = vec3(0.0);
#ifdef METAL
    metal = metal_fresnel(point, v_dot_h) * facet;
#endif
    base += light * n_dot_l * sheen_over(point, mix_of(point, dielectric, metal), n_dot_l, half_way);
}
#endif

void add_lights(Point point, inout vec3 base, inout vec3 coat) {
#if FLAT_LIGHT_COUNT > 0
    for (int i = 0; i < FLAT_LIGHT_COUNT; ++i) add_light(point, i, flat_light(i), base, coat);
#endif
#ifndef LIGHT_COUNT
    for (int i = 0; i < u_counts.x; ++i) add_light(point, i, u_lights[i], base, coat);
#elif LIGHT_COUNT > FLAT_LIGHT_COUNT
    for (int i = FLAT_LIGHT_COUNT; i < LIGHT_COUNT; ++i) add_light(point, i, u_lights[i], base, coat);
#endif
}
