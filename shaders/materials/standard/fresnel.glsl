// The share of light that facets reflect: of metals with F0 = base colour, of dielectrics with F0 from the index of
// refraction (glTF 2.0, B.2.1 and B.2.2, KHR_materials_ior, KHR_materials_specular).
vec3 metal_fresnel(Point point, float cosine) {
    vec3 f = mix(point.color, vec3(1.0), schlick_weight(cosine));
#ifdef IRIDESCENCE
    f = mix(f, film_fresnel(point, point.color, cosine), point.iridescence);
#endif
    return f;
}

vec3 dielectric_fresnel(Point point, float cosine) {
    vec3 f = mix(point.f0, vec3(point.f90), schlick_weight(cosine));
#ifdef IRIDESCENCE
    f = mix(f, film_fresnel(point, point.f0, cosine), point.iridescence);
#endif
    return f;
}

// The F0 under light from all around, which has no half-way vector: a film is seen along the normal.
vec3 f0_around(Point point, vec3 f0) {
#ifdef IRIDESCENCE
    vec3 film = f0_of(film_fresnel(point, f0, point.n_dot_v), point.n_dot_v);
    return mix(f0, film, point.iridescence);
#else
    return f0;
#endif
}

// The base of the material: dielectric and metal, mixed (glTF 2.0, B.1).
vec3 mix_of(Point point, vec3 dielectric, vec3 metal) {
#if defined(METAL) && defined(DIELECTRIC)
    return mix(dielectric, metal, point.metallic);
#elif defined(METAL)
    return metal;
#else
    return dielectric;
#endif
}
