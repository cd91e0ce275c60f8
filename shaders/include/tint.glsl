// What multiplies the colour of a material that has a map and vertex colours: the product of both.
#ifdef HAS_MAP
layout(binding = UNIT_MAP) uniform sampler2D u_map;
#endif

vec4 tint_of(Surface surface) {
#ifdef HAS_MAP
    return texture(u_map, surface.uv) * surface.color;
#else
    return surface.color;
#endif
}
