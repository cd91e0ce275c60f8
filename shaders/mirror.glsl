#ifdef MATERIAL_MIRROR
// u_parameters: env_weight, color_weight, F0 (with FRESNEL).
// Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994.
vec3 shade(Surface surface) {
    vec3 reflected = reflect(surface.incident, surface.normal);
    float weight = u_parameters.x;
#ifdef FRESNEL
    float f0 = u_parameters.z;
    float m = 1.0 - clamp(-dot(surface.incident, surface.normal), 0.0, 1.0);
    weight *= f0 + (1.0 - f0) * (m * m) * (m * m) * m;
#endif
    return weight * u_tint.rgb * environment(reflected) + u_parameters.y * u_color.rgb;
}
#endif
