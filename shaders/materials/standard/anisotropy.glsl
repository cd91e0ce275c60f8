// KHR_materials_anisotropy: facets that are rougher along the tangent than along the bitangent. D is that of B. Burley,
// "Physically-Based Shading at Disney", SIGGRAPH 2012; V is the separable form with the roughness of each direction.
#ifdef ANISOTROPY
float stretched_facets(Point point, vec3 half_way) {
    float along = max(point.alpha_along, LEAST_ALPHA);
    float across = max(point.alpha, LEAST_ALPHA);
    vec3 f = vec3(dot(point.tangent, half_way) / along, dot(point.bitangent, half_way) / across,
                  dot(point.normal, half_way));
    float d = dot(f, f);
    return 1.0 / (PI * along * across * d * d);
}

float stretched_unmasked(Point point, vec3 direction, float cosine) {
    float along = max(point.alpha_along, LEAST_ALPHA);
    float across = max(point.alpha, LEAST_ALPHA);
    return 1.0 / (cosine + length(vec3(along * dot(point.tangent, direction), across * dot(point.bitangent, direction),
                                       cosine)));
}

// The normal of the mirror that reflects the middle of the stretched highlight ("Image-based lighting").
vec3 bent_normal(Point point) {
    vec3 bent = cross(point.bitangent, point.view);
    bent = normalize(cross(bent, point.bitangent));
    float a = 1.0 - point.anisotropy * (1.0 - point.roughness);
    return normalize(mix(bent, point.normal, (a * a) * (a * a)));
}
#endif

float facets_of(Point point, vec3 half_way) {
#ifdef ANISOTROPY
    return stretched_facets(point, half_way);
#else
    float alpha = max(point.alpha, LEAST_ALPHA);
    return facets(alpha * alpha, point.normal, half_way);
#endif
}

float unmasked_of(Point point, vec3 direction, float cosine) {
#ifdef ANISOTROPY
    return stretched_unmasked(point, direction, cosine);
#else
    float alpha = max(point.alpha, LEAST_ALPHA);
    return unmasked(alpha * alpha, cosine);
#endif
}
