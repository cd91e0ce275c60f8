#ifdef MATERIAL_PHONG
// B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975, with white highlights.
// v_material[0]: ka * color * ambient light, shininess. v_material[1]: kd * color, ks.
vec3 light_answer(Surface surface, vec4 light_position, vec4 light_color) {
    vec3 to_light = light_position.xyz - surface.position * light_position.w;
    float distance_squared = dot(to_light, to_light);
    to_light *= inversesqrt(distance_squared);
    float n_dot_l = dot(surface.normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
    // dot(reflect(-to_light, normal), -incident)
    float r_dot_v = dot(to_light, surface.incident) - 2.0 * n_dot_l * dot(surface.normal, surface.incident);
    float highlight = pow(clamp(r_dot_v, 0.0, 1.0), v_material[0].a);
    vec3 answer = n_dot_l * v_material[1].rgb * surface.tint + v_material[1].a * highlight;
#ifdef LIGHT_DECAY
    answer *= light_position.w == 0.0 ? 1.0 : pow(distance_squared, -0.5 * light_color.a);
#endif
    return answer * light_color.rgb;
}

vec3 shade(Surface surface) {
    vec3 result = v_material[0].rgb * surface.tint;
#ifdef LIGHT_COUNT
#if LIGHT_COUNT > 0
    for (int i = 0; i < LIGHT_COUNT; ++i) {
        result += light_answer(surface, v_light_position[i], v_light_color[i]);
    }
#endif
#else
    for (int i = 0; i < u_counts.x; ++i) {
        result += light_answer(surface, u_lights[i].position, u_lights[i].color);
    }
#endif
    return result;
}
#endif
