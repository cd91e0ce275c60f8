// KHR_materials_iridescence: a thin film, in which light interferes with itself. L. Belcour and P. Barla, "A Practical
// Extension to Microfacet Theory for the Modeling of Varying Iridescence", SIGGRAPH 2017, in the form of the
// extension's text ("Iridescence Fresnel"), which uses Schlick's approximation at both boundaries.
#ifdef IRIDESCENCE
// The answer of the eye to a phase, in linear RGB; the sensitivities are sums of Gaussians ("Analytic Spectral
// Integration").
vec3 sensitivity(float path, vec3 shift) {
    float phase = 2.0 * PI * path * 1e-9;
    const vec3 height = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    const vec3 place = vec3(1.6810e+06, 1.7953e+06, 2.2084e+06);
    const vec3 width = vec3(4.3278e+09, 9.3046e+09, 6.6121e+09);
    vec3 xyz = height * sqrt(2.0 * PI * width) * cos(place * phase + shift) * exp(-phase * phase * width);
    xyz.x += 9.7470e-14 * sqrt(2.0 * PI * 4.5282e+09) * cos(2.2399e+06 * phase + shift.x) *
             exp(-4.5282e+09 * phase * phase);
    const mat3 to_rgb = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                             0.0415560, 1.0572252);
    return to_rgb * (xyz / 1.0685e-7);
}

// The reflectance of the film over a base of the reflectance `f0`.
vec3 film_fresnel(Point point, vec3 f0, float cosine) {
    float ior = IRIDESCENCE_IOR;
    float cosine_inside = sqrt(1.0 - (1.0 - cosine * cosine) / (ior * ior));

    float head_on = (ior - 1.0) / (ior + 1.0);
    float outer = mix(head_on * head_on, 1.0, schlick_weight(cosine));
    float through = 1.0 - outer;
    vec3 root = sqrt(clamp(f0 + 0.0001, 0.0, 0.9999));  // an index of refraction ends below infinity
    vec3 base_ior = (1.0 + root) / (1.0 - root);
    vec3 inner = (base_ior - ior) / (base_ior + ior);
    inner = mix(inner * inner, vec3(1.0), schlick_weight(cosine_inside));

    // The phase turns by half at the outer boundary, from inside, and at the base where it is the thinner medium.
    vec3 shift = vec3(PI) + PI * vec3(lessThan(base_ior, vec3(ior)));
    float path = 2.0 * ior * point.film_thickness * cosine_inside;

    vec3 both = clamp(outer * inner, 1e-5, 0.9999);
    vec3 several = through * through * inner / (1.0 - both);
    vec3 sum = outer + several;
    vec3 order = several - through;
    for (int m = 1; m <= 2; ++m) {
        order *= sqrt(both);
        sum += order * 2.0 * sensitivity(float(m) * path, float(m) * shift);
    }
    return max(sum, 0.0);
}

// The F0 with which Schlick's term gives `f` at this angle, so that tables of F0 apply.
vec3 f0_of(vec3 f, float cosine) {
    float weight = min(schlick_weight(cosine), 0.9999);
    return clamp((f - weight) / (1.0 - weight), 0.0, 1.0);
}
#endif
