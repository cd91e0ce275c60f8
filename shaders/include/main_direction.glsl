// The main direction of the light that a surface of this roughness reflects: S. Lagarde and C. de Rousiers, "Moving
// Frostbite to PBR", SIGGRAPH 2014, section 4.9.3. Its length is not 1.
vec3 main_direction(vec3 normal, vec3 view, float roughness) {
    float alpha = roughness * roughness;
    return mix(normal, reflect(-view, normal), (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha));
}
