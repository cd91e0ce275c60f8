layout(binding = 1) uniform samplerCube u_cube;

#ifdef ENVIRONMENT_BLOCK
// cpp/cubecam/render/resources/environment.hpp
layout(std140, binding = 5) uniform Environment {
    vec4 u_environment_position;  // xyz: position of the capture, relative to u_origin; w: 1. All 0: infinitely far away
    ivec4 u_environment_levels;   // x: how many levels; 0: there is no environment
    vec4 u_environment_turn[3];   // xyz: rows of the matrix from the world to the cube; [0].w: intensity
    vec4 u_environment_texel;     // xy: width and height of a texel of u_filtered
    vec4 u_environment_places[16];  // of the levels in u_filtered, [0]: of the irradiance; see environment_place()
    vec4 u_environment_planar;      // of a planar mirror: xyz: its normal, w: how far from it rays are looked up
};
#elif defined(USER_SOURCE)
const vec4 u_environment_position = vec4(0.0);
const ivec4 u_environment_levels = ivec4(0);
#endif

// The scene's own environment may be turned and brighter or darker than its cube.
#ifdef ENVIRONMENT_TURNED
vec3 environment_in_cube(vec3 direction_world) {
    return vec3(dot(u_environment_turn[0].xyz, direction_world), dot(u_environment_turn[1].xyz, direction_world),
                dot(u_environment_turn[2].xyz, direction_world));
}
vec3 environment_scaled(vec3 light) { return u_environment_turn[0].w * light; }
#else
#define environment_in_cube(direction_world) direction_world
#define environment_scaled(light) light
#endif

#include "include/planar_mirror.glsl"

// The light from a world direction (from the surface outwards, of any length). It needs no sign flip, since faces are
// in GL's layout.
vec3 environment(vec3 direction_world) {
    vec3 light = environment_scaled(texture(u_cube, environment_in_cube(direction_world)).rgb);
    return or_planar_mirror(light, direction_world, 0.0, 0.0);
}

#ifdef USES_ENVIRONMENT_MIPS
// The same environment with levels that are averages of boxes of texels.
layout(binding = 4) uniform samplerCube u_box_mipmaps;

vec3 environment_mip(vec3 direction_world, float lod) {
    vec3 light = environment_scaled(textureLod(u_box_mipmaps, environment_in_cube(direction_world), lod).rgb);
    // Half the width of a texel of this level, in the middle of a face whose half is 1 wide.
    return or_planar_mirror(light, direction_world, exp2(lod) / float(textureSize(u_box_mipmaps, 0).x), 0.0);
}

// Texels along an edge of level 0.
float environment_size() { return float(textureSize(u_box_mipmaps, 0).x); }
#endif

#ifdef USES_FILTERED_ENVIRONMENT
layout(binding = 3) uniform sampler2D u_brdf_table;

// Integrals of reflection models under uniform light (cpp/cubecam/lighting/brdf_table.hpp): scale and bias of F0 of the
// GGX lobe, and the albedo of the sheen lobe, for which `roughness` is the roughness of sheen.
vec3 brdf_terms(float n_dot_v, float roughness) {
    float size = float(textureSize(u_brdf_table, 0).x);
    return textureLod(u_brdf_table, (vec2(n_dot_v, roughness) * (size - 1.0) + 0.5) / size, 0.0).xyz;
}

#ifdef ENVIRONMENT_FILTERED
layout(binding = 2) uniform sampler2D u_filtered;

// The face that a direction meets: xy: its column and row among the faces of a level (x, y, z; positive, negative);
// zw: the place on the face, from 0 to 1.
vec4 environment_face(vec3 direction) {
    vec3 size = abs(direction);
    bool x = size.x >= size.y && size.x >= size.z;
    bool y = !x && size.y >= size.z;
    float along = x ? direction.x : y ? direction.y : direction.z;
    float s = along >= 0.0 ? 1.0 : -1.0;
    vec2 place = x ? vec2(-s * direction.z, -direction.y)
                   : y ? vec2(direction.x, s * direction.z) : vec2(s * direction.x, -direction.y);
    return vec4(x ? 0.0 : y ? 1.0 : 2.0, 0.5 - 0.5 * s, 0.5 + 0.5 * place / max(abs(along), 1e-30));
}

// A bilinear lookup in one level. `place` is the level's element of u_environment_places: xy: the first texel of its
// first face, z: texels along an edge; faces have a border of one texel.
vec3 environment_place(vec4 place, vec4 on) {
    vec2 at = place.xy + on.xy * (place.z + 2.0) + on.zw * place.z;
    return textureLod(u_filtered, at * u_environment_texel.xy, 0.0).rgb;
}

// The level of a roughness; a whole number where it is the roughness of a level.
float environment_level_of(float roughness) {
#ifdef ENVIRONMENT_UNEVEN
    float level = 0.0;
    for (int k = 1; k < u_environment_levels.x; ++k) {
        float before = u_environment_places[k - 1].w;
        level += clamp((roughness - before) / (u_environment_places[k].w - before), 0.0, 1.0);
    }
    return level;
#else
    return clamp(roughness, 0.0, 1.0) * float(u_environment_levels.x - 1);
#endif
}

// The filtered radiance round a direction at a level, between two levels linearly; level 0 is the cube itself.
vec3 environment_level(vec3 direction_world, float level) {
    vec3 direction = environment_in_cube(direction_world);
    int lower = clamp(int(level), 0, max(u_environment_levels.x - 2, 0));
    vec4 on = environment_face(direction);
    // Every fragment makes all lookups: the level of a mipmapped lookup depends on the neighbour fragments.
    vec3 sharp = texture(u_cube, direction).rgb;
    vec3 low = environment_place(u_environment_places[lower], on);
    vec3 high = environment_place(u_environment_places[lower + 1], on);
    return environment_scaled(mix(lower == 0 ? sharp : low, high, clamp(level - float(lower), 0.0, 1.0)));
}

// The radiance round a direction, filtered by the lobe of GGX for a roughness from 0 (the cube itself) to 1.
vec3 environment_filtered(vec3 direction_world, float roughness) {
    vec3 light = environment_level(direction_world, environment_level_of(roughness));
    return or_planar_mirror(light, direction_world, planar_mirror_spread(roughness), 0.0);
}

// The mean of the radiance around a direction, weighted by the cosine: irradiance / pi.
vec3 environment_irradiance(vec3 normal_world) {
    vec3 normal = environment_in_cube(normal_world);
    return environment_scaled(environment_place(u_environment_places[0], environment_face(normal)));
}
#else
// Without filtered levels the mipmaps replace them, or the cube itself if it has none.
vec3 environment_filtered(vec3 direction_world, float roughness) {
    float level = clamp(roughness, 0.0, 1.0) * float(max(u_environment_levels.x - 1, 0));
    vec3 light = environment_scaled(textureLod(u_cube, environment_in_cube(direction_world), level).rgb);
    return or_planar_mirror(light, direction_world, planar_mirror_spread(roughness), 0.0);
}

// Planar mirrors show no irradiance, so that this is that of the scene's environment.
vec3 environment_irradiance(vec3 normal_world) {
    float level = float(max(u_environment_levels.x - 1, 0));
    return environment_scaled(textureLod(u_cube, environment_in_cube(normal_world), level).rgb);
}
#endif
#endif
