#ifdef MATERIAL_PHONG
// B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975, with white highlights.
// u_parameters: ka, kd, ks, shininess.
vec3 shade(Surface surface) {
    vec3 result = u_parameters.x * surface.color.rgb * u_ambient.rgb;
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        Light light = u_lights[i];
        vec3 to_light = light.position.xyz - surface.position * light.position.w;
        float distance_squared = dot(to_light, to_light);
        to_light *= inversesqrt(distance_squared);
        float n_dot_l = dot(surface.normal, to_light);
        if (n_dot_l > 0.0) {
            // dot(reflect(-to_light, normal), -incident)
            float r_dot_v = dot(to_light, surface.incident) - 2.0 * n_dot_l * dot(surface.normal, surface.incident);
            float highlight = pow(clamp(r_dot_v, 0.0, 1.0), u_parameters.w);
            vec3 answer = u_parameters.y * n_dot_l * surface.color.rgb + u_parameters.z * highlight;
            result += answer * light.color.rgb * light_falloff(light, distance_squared);
        }
    }
    return result;
}
#endif
