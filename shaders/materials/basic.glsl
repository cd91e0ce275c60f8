#ifdef MATERIAL_BASIC
// Unlit. material[0].rgb: colour.
vec3 shade(Surface surface) {
    vec3 color = material[0].rgb * surface.tint;
#ifdef HAS_CUBE
    color *= environment(surface.position_object);
#endif
    return color;
}
#endif
