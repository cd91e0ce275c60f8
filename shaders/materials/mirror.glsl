// material[0]: env_weight * tint, f0 (with FRESNEL). material[1].rgb: color_weight * color. Schlick, "An Inexpensive
// BRDF Model for Physically-based Rendering", Eurographics 1994.
vec3 shade(Surface surface) {
    vec3 reflected = material[0].rgb * environment(reflect(surface.incident, surface.normal));
#ifdef FRESNEL
    float f0 = material[0].a;
    float m = 1.0 - clamp(-dot(surface.incident, surface.normal), 0.0, 1.0);
    reflected *= f0 + (1.0 - f0) * (m * m) * (m * m) * m;
#endif
    return reflected + material[1].rgb;
}
