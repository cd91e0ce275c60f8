// material[0]: tint, eta = n_outside / n_inside = 1 / ior. Without FRESNEL only the refraction, except at total
// reflection. With ROUGH, material[1].xy: the roughness of what is reflected and of what is refracted. Reflectance of
// unpolarised light: M. Born, E. Wolf, "Principles of Optics", section 1.5.2.
#ifdef ROUGH
#include "include/main_direction.glsl"
#endif

vec3 shade(Surface surface) {
    float eta = material[0].a;
    vec3 reflected = reflect(surface.incident, surface.normal);
    vec3 refracted = refract(surface.incident, surface.normal, eta);
    bool total = dot(refracted, refracted) == 0.0;

    float f = 0.0;
#ifdef FRESNEL
    float cos_i = clamp(-dot(surface.incident, surface.normal), 0.0, 1.0);
    float cos_t = sqrt(max(1.0 - eta * eta * (1.0 - cos_i * cos_i), 0.0));
    float r_s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    float r_p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    f = 0.5 * (r_s * r_s + r_p * r_p);
#endif
    f = total ? 1.0 : f;

    // Every fragment makes both lookups: the level of a mipmapped lookup depends on the neighbour fragments.
#ifdef ROUGH
    reflected = main_direction(surface.normal, -surface.incident, material[1].x);
    vec3 mirrored = environment_filtered(reflected, material[1].x);
    vec3 passed = environment_filtered(total ? reflected : refracted, total ? material[1].x : material[1].y);
    return f * mirrored + (1.0 - f) * material[0].rgb * passed;
#else
    return f * environment(reflected) + (1.0 - f) * material[0].rgb * environment(total ? reflected : refracted);
#endif
}
