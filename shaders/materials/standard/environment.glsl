// The base of the material under light from all around: the environment and ambient lights.

// The integrals of the specular lobe under uniform light, scale and bias of F0: B. Karis, "Real Shading in Unreal Engine
// 4", SIGGRAPH 2013. On a smooth surface they are exact.
vec2 terms_of(Point point) {
#ifdef SMOOTH
    float weight = schlick_weight(point.n_dot_v);
    return vec2(1.0 - weight, weight);
#elif defined(SAMPLED) && !defined(DIELECTRIC) && !defined(MULTIPLE_SCATTERING)
    return vec2(0.0);  // samples alone make the lobe
#else
    return brdf_terms(point.n_dot_v, point.roughness).xy;
#endif
}

// The light that the lobe gathers, for its two factors: it reflects f0 * scale + f90 * bias.
void gather(Point point, vec2 terms, out vec3 scale, out vec3 bias) {
#ifdef SAMPLED
    add_samples(point, scale, bias);
#else
#if defined(SMOOTH)
    vec3 light = environment(reflect(-point.view, point.normal)) + AMBIENT;
#elif defined(ANISOTROPY)
    vec3 light = environment_filtered(main_direction(bent_normal(point), point.view, point.roughness), point.roughness);
    light += AMBIENT;
#else
    vec3 light = environment_filtered(main_direction(point.normal, point.view, point.roughness), point.roughness);
    light += AMBIENT;
#endif
    scale = terms.x * light;
    bias = terms.y * light;
#endif
    scale *= point.occlusion;
    bias *= point.occlusion;
}

// A lobe with its reflectances head-on and at grazing angles; adds to `share` what it reflects of uniform light. Light
// that the facets scatter more than once: C. Fdez-Aguera, "A Multiple-Scattering Microfacet Model for Real-Time
// Image-based Lighting", JCGT 8(1), 2019; its mean reflectance is that of Schlick's term.
vec3 lobe(vec3 f0, float f90, vec2 terms, vec3 scale, vec3 bias, vec3 around, out vec3 share) {
    vec3 light = f0 * scale + f90 * bias;
    share = f0 * terms.x + f90 * terms.y;
#ifdef MULTIPLE_SCATTERING
    vec3 mean = min(f0 + (f90 - f0) / 21.0, 1.0);
    float lost = 1.0 - (terms.x + terms.y);
    vec3 several = share * mean * lost / (1.0 - mean * lost);
    light += several * around;
    share += several;
#endif
    return light;
}

vec3 base_under_environment(Point point) {
    vec2 terms = terms_of(point);
    vec3 scale;
    vec3 bias;
    gather(point, terms, scale, bias);
    vec3 around = vec3(0.0);
#if defined(DIELECTRIC) || defined(MULTIPLE_SCATTERING)
    around = point.occlusion * (environment_irradiance(point.normal) + AMBIENT);
#endif
    vec3 share;
    vec3 dielectric = vec3(0.0);
#ifdef DIELECTRIC
    dielectric = lobe(f0_around(point, point.f0), point.f90, terms, scale, bias, around, share);
    vec3 below = around;
#ifdef TRANSMISSION
    below = mix(below, transmitted(point), point.transmission);
#endif
    dielectric += point.color * (1.0 - max3(share)) * below;
#endif
    vec3 metal = vec3(0.0);
#ifdef METAL
    metal = lobe(f0_around(point, point.color), 1.0, terms, scale, bias, around, share);
#endif
    return mix_of(point, dielectric, metal);
}
