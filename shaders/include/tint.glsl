// The factor for the colour of a material: the product of its map and the vertex colours.
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
