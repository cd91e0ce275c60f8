// KHR_materials_sheen: fibres that stand on the surface. A. Conty Estevez and C. Kulla, "Production Friendly Microfacet
// Sheen BRDF", SIGGRAPH 2017.
#ifdef SHEEN
const float LEAST_SHEEN_ALPHA = 1e-3;  // fibres that all stand upright would be seen from the side alone

float sheen_fit(float x, float alpha) {
    float m = (1.0 - alpha) * (1.0 - alpha);
    float a = mix(21.5473, 25.3245, m);
    float b = mix(3.82987, 3.32435, m);
    float c = mix(0.19823, 0.16801, m);
    float d = mix(-1.97760, -1.27393, m);
    float e = mix(-4.32054, -4.85967, m);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

float sheen_lambda(float cosine, float alpha) {
    return cosine < 0.5 ? exp(sheen_fit(cosine, alpha))
                        : exp(2.0 * sheen_fit(0.5, alpha) - sheen_fit(1.0 - cosine, alpha));
}

// Reflected by white fibres: D ("Sheen distribution") times V ("Sheen visibility").
float sheen_brdf(Point point, float n_dot_l, vec3 half_way) {
    if (point.n_dot_v <= LEAST_COSINE) return 0.0;
    float alpha = max(point.sheen_roughness * point.sheen_roughness, LEAST_SHEEN_ALPHA);
    vec3 across = cross(point.normal, half_way);
    float sine_squared = min(dot(across, across), 1.0);
    float d = (2.0 + 1.0 / alpha) * pow(sine_squared, 0.5 / alpha) / (2.0 * PI);
    float lambdas = sheen_lambda(point.n_dot_v, alpha) + sheen_lambda(n_dot_l, alpha);
    float v = clamp(1.0 / ((1.0 + lambdas) * 4.0 * point.n_dot_v * n_dot_l), 0.0, 1.0);
    return d * v;
}
#endif

// The base below the sheen, and the sheen, under light from all around ("Albedo-scaling technique").
vec3 sheen_over(Point point, vec3 base) {
#ifdef SHEEN
    vec3 around = point.occlusion * (environment_irradiance(point.normal) + AMBIENT);
    return base * (1.0 - max3(point.sheen_color) * point.sheen_albedo) +
           point.sheen_color * point.sheen_albedo * around;
#else
    return base;
#endif
}

// The same under one light.
vec3 sheen_over(Point point, vec3 base, float n_dot_l, vec3 half_way) {
#ifdef SHEEN
    float albedo = max(point.sheen_albedo, brdf_terms(n_dot_l, point.sheen_roughness).z);
    return base * (1.0 - max3(point.sheen_color) * albedo) + point.sheen_color * sheen_brdf(point, n_dot_l, half_way);
#else
    return base;
#endif
}
