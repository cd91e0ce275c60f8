#ifdef MATERIAL_BASIC
// Unlit.
vec3 shade(Surface surface) {
    vec3 color = surface.color.rgb;
#ifdef HAS_CUBE
    color *= environment(surface.position_object);
#endif
    return color;
}
#endif
