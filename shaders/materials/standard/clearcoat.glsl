// KHR_materials_clearcoat: a clear layer over everything, emission included.
#ifdef CLEARCOAT
float coat_under_light(Point point, vec3 to_light, vec3 half_way) {
    float cosine = dot(point.coat_normal, to_light);
    if (cosine <= 0.0 || point.coat_n_dot_v <= LEAST_COSINE) return 0.0;
    float alpha = max(point.coat_roughness * point.coat_roughness, LEAST_ALPHA);
    return cosine * facets(alpha * alpha, point.coat_normal, half_way) * unmasked(alpha * alpha, cosine) *
           unmasked(alpha * alpha, point.coat_n_dot_v);
}
#endif

// What a coat that reflects everything shows of the light from all around.
vec3 coat_under_environment(Point point) {
#if defined(CLEARCOAT_SMOOTH)
    return environment(reflect(-point.view, point.coat_normal)) + AMBIENT;
#elif defined(CLEARCOAT)
    vec3 light =
        environment_filtered(main_direction(point.coat_normal, point.view, point.coat_roughness), point.coat_roughness) +
        AMBIENT;
#ifndef COAT_SCATTERING
    vec3 terms = brdf_terms(point.coat_n_dot_v, point.coat_roughness);
    light *= terms.x + terms.y;
#endif
    return light;
#else
    return vec3(0.0);
#endif
}

vec3 coat_over(Point point, vec3 base, vec3 coat) {
#ifdef CLEARCOAT
    return mix(base, coat, point.coat);
#else
    return base;
#endif
}
