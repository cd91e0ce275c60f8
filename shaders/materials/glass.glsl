// material[0]: tint, eta = n_outside / n_inside = 1 / ior. Without FRESNEL only the refraction, except at total
// reflection. With ROUGH, material[1].xy: the roughness of what is reflected and of what is refracted at one surface.
// With BODY light goes through both sides of the body; material[3].rgb: extinction for each world unit. With DISPERSION
// material[2].rgb is eta for red, green and blue.
#ifdef ROUGH
#include "include/main_direction.glsl"
#endif
#ifdef BODY
#include "include/body.glsl"
#endif

// The share of unpolarised light that the surface of a dielectric reflects, without total reflection: M. Born, E. Wolf,
// "Principles of Optics", section 1.5.2. eta = n_outside / n_inside.
float dielectric_reflectance(float cos_i, float eta) {
    cos_i = clamp(cos_i, 0.0, 1.0);
    float cos_t = sqrt(max(1.0 - eta * eta * (1.0 - cos_i * cos_i), 0.0));
    float r_s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float r_p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (r_s * r_s + r_p * r_p);
}

#if defined(BODY) && defined(ROUGH)
// The roughness of a mirror that spreads light as both sides of the body do. Seen from outside, a facet that leans by a small
// angle d turns light by 2 d where a mirror reflects it, by |ior - 1| d where it goes in or out, and by 2 ior d where it is
// reflected inside. Variances of lobes add up: L. Belcour, "Efficient Rendering of Layered Materials using an Atomic
// Decomposition with Statistical Operators", ACM Transactions on Graphics 37(4), 2018, section 4.
float passed_roughness(float ior, int reflections) {
    float through = 0.5 * (ior - 1.0);
    float variance = 2.0 * through * through + float(reflections) * ior * ior;
    return sqrt(min(material[1].x * material[1].x * sqrt(variance), 1.0));
}
#endif

vec3 refracted_by(Surface surface, float eta) { return refract(surface.incident, surface.normal, eta); }

// The light that the surface lets through, without its tint. Where all light is reflected, it is that from `reflected`.
vec3 passed_light(Surface surface, vec3 reflected, float eta) {
    vec3 refracted = refracted_by(surface, eta);
    bool total = dot(refracted, refracted) == 0.0;
    vec3 direction = total ? reflected : refracted;
#ifdef BODY
    Passage passage = Passage(surface.from_origin, direction, 0.0, 0);
    if (!total) passage = through_body(surface.from_origin, direction, 1.0 / eta);
#ifdef ROUGH
    float roughness = passage.met > 0 ? passed_roughness(1.0 / eta, passage.met - 1) : material[1].y;
    vec3 light = environment_filtered_from(passage.from_origin, passage.direction, total ? material[1].x : roughness);
#else
    vec3 light = environment_from(passage.from_origin, passage.direction);
#endif
    return light * exp(-material[3].rgb * min(passage.way, 1e30));
#elif defined(ROUGH)
    return environment_filtered(direction, total ? material[1].x : material[1].y);
#else
    return environment(direction);
#endif
}

vec3 shade(Surface surface) {
    float eta = material[0].a;
    vec3 reflected = reflect(surface.incident, surface.normal);
    vec3 refracted = refracted_by(surface, eta);
    bool total = dot(refracted, refracted) == 0.0;

    float f = 0.0;
#ifdef FRESNEL
    f = dielectric_reflectance(-dot(surface.incident, surface.normal), eta);
#endif
    f = total ? 1.0 : f;

    // Every fragment makes all lookups: the level of a mipmapped lookup depends on the neighbour fragments.
#ifdef ROUGH
    reflected = main_direction(surface.normal, -surface.incident, material[1].x);
    vec3 mirrored = environment_filtered(reflected, material[1].x);
#else
    vec3 mirrored = environment(reflected);
#endif
#ifdef DISPERSION
    // KHR_materials_dispersion: each colour has its own index of refraction.
    vec3 etas = material[2].rgb;
    vec3 passed = vec3(passed_light(surface, reflected, etas.r).r, passed_light(surface, reflected, etas.g).g,
                       passed_light(surface, reflected, etas.b).b);
#else
    vec3 passed = passed_light(surface, reflected, eta);
#endif
    return f * mirrored + (1.0 - f) * material[0].rgb * passed;
}
