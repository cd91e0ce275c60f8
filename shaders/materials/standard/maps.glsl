// The maps. Each function returns the factor of a map, or 1 if the material has no such map.
#ifdef HAS_MAP
layout(binding = UNIT_MAP) uniform sampler2D u_map;
#endif
#ifdef HAS_METALLIC_ROUGHNESS_MAP
layout(binding = UNIT_METALLIC_ROUGHNESS_MAP) uniform sampler2D u_metallic_roughness_map;
#endif
#ifdef HAS_NORMAL_MAP
layout(binding = UNIT_NORMAL_MAP) uniform sampler2D u_normal_map;
#endif
#ifdef HAS_OCCLUSION_MAP
layout(binding = UNIT_OCCLUSION_MAP) uniform sampler2D u_occlusion_map;
#endif
#ifdef HAS_EMISSIVE_MAP
layout(binding = UNIT_EMISSIVE_MAP) uniform sampler2D u_emissive_map;
#endif
#ifdef HAS_SPECULAR_MAP
layout(binding = UNIT_SPECULAR_MAP) uniform sampler2D u_specular_map;
#endif
#ifdef HAS_SPECULAR_COLOR_MAP
layout(binding = UNIT_SPECULAR_COLOR_MAP) uniform sampler2D u_specular_color_map;
#endif
#ifdef HAS_CLEARCOAT_MAP
layout(binding = UNIT_CLEARCOAT_MAP) uniform sampler2D u_clearcoat_map;
#endif
#ifdef HAS_CLEARCOAT_ROUGHNESS_MAP
layout(binding = UNIT_CLEARCOAT_ROUGHNESS_MAP) uniform sampler2D u_clearcoat_roughness_map;
#endif
#ifdef HAS_CLEARCOAT_NORMAL_MAP
layout(binding = UNIT_CLEARCOAT_NORMAL_MAP) uniform sampler2D u_clearcoat_normal_map;
#endif
#ifdef HAS_SHEEN_COLOR_MAP
layout(binding = UNIT_SHEEN_COLOR_MAP) uniform sampler2D u_sheen_color_map;
#endif
#ifdef HAS_SHEEN_ROUGHNESS_MAP
layout(binding = UNIT_SHEEN_ROUGHNESS_MAP) uniform sampler2D u_sheen_roughness_map;
#endif
#ifdef HAS_IRIDESCENCE_MAP
layout(binding = UNIT_IRIDESCENCE_MAP) uniform sampler2D u_iridescence_map;
#endif
#ifdef HAS_IRIDESCENCE_THICKNESS_MAP
layout(binding = UNIT_IRIDESCENCE_THICKNESS_MAP) uniform sampler2D u_iridescence_thickness_map;
#endif
#ifdef HAS_ANISOTROPY_MAP
layout(binding = UNIT_ANISOTROPY_MAP) uniform sampler2D u_anisotropy_map;
#endif
#ifdef HAS_TRANSMISSION_MAP
layout(binding = UNIT_TRANSMISSION_MAP) uniform sampler2D u_transmission_map;
#endif
#ifdef HAS_THICKNESS_MAP
layout(binding = UNIT_THICKNESS_MAP) uniform sampler2D u_thickness_map;
#endif

// The maps in the order of the material's fields: the index of a map's place among the constants.
const int MAP = 0, METALLIC_ROUGHNESS_MAP = 1, NORMAL_MAP = 2, OCCLUSION_MAP = 3, EMISSIVE_MAP = 4, SPECULAR_MAP = 5,
          SPECULAR_COLOR_MAP = 6, CLEARCOAT_MAP = 7, CLEARCOAT_ROUGHNESS_MAP = 8, CLEARCOAT_NORMAL_MAP = 9,
          SHEEN_COLOR_MAP = 10, SHEEN_ROUGHNESS_MAP = 11, IRIDESCENCE_MAP = 12, IRIDESCENCE_THICKNESS_MAP = 13,
          ANISOTROPY_MAP = 14, TRANSMISSION_MAP = 15, THICKNESS_MAP = 16;

// Where a map is looked up: KHR_texture_transform, with v upwards.
vec2 place_of(int map, Surface surface) {
#ifdef PLACED
    vec4 row_u = material[FIRST_PLACE + 2 * map];
    vec4 row_v = material[FIRST_PLACE + 2 * map + 1];
#ifdef USES_UV1
    vec2 uv = row_u.w == 0.0 ? surface.uv : surface.uv1;
#else
    vec2 uv = surface.uv;
#endif
    return vec2(dot(row_u.xy, uv) + row_u.z, dot(row_v.xy, uv) + row_v.z);
#else
    return surface.uv;
#endif
}

// A texel of a map at the place that the map has.
#define looked_up(unit, map) texture(unit, place_of(map, surface))

// The base colour (glTF 2.0, section 3.9.2). The renderer multiplies alpha by that of the colour, except with
// ALPHA_MASK.
vec4 base_color(Surface surface) {
    vec4 color = vec4(COLOR.rgb, 1.0) * surface.color;
#ifdef HAS_MAP
    color *= looked_up(u_map, MAP);
#endif
    return color;
}
