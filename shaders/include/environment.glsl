// One environment. For several, a program has this text once for each, with numbers behind its names
// (cpp/cubecam/render/passes/environment_text.hpp), and include/environment_blend.glsl.
#include "include/cube_place.glsl"
#include "include/crossing.glsl"
#include "include/screen.glsl"

layout(binding = 1) uniform samplerCube u_cube;

#ifdef ENVIRONMENT_BLOCK
// cpp/cubecam/render/resources/environment.hpp
layout(std140, binding = 5) uniform Environment {
    vec4 u_environment_position;  // xyz: position of the capture, relative to u_origin; w: 1. All 0: infinitely far away
    ivec4 u_environment_levels;   // x: how many levels; 0: there is no environment
    vec4 u_environment_turn[3];   // xyz: rows of the matrix from the world to the cube; [0].w: intensity
    vec4 u_environment_texel;     // xy: width and height of a texel of u_filtered
    vec4 u_environment_proxy[3];  // rows of the matrix to the proxy, whose box is from -1 to 1, from relative to u_origin
    vec4 u_environment_distances;  // xy: width and height of a texel of u_distances, z: texels along an edge of a face
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

#if defined(ENVIRONMENT_BOX) || defined(ENVIRONMENT_SPHERE) || defined(ENVIRONMENT_FETCHES)
#define ENVIRONMENT_NEAR
#endif

// What a ray from a point of the scene meets, as the place of the capture sees it.
struct EnvironmentHit {
    vec3 direction;  // in which it is seen from there, of any length
    float spread;    // how many times as far it is from the point as from there
    bool farthest;   // it is in the layer of the farthest surfaces
};
#ifdef ENVIRONMENT_NEAR
#include "include/parallax.glsl"
#else
// The environment is infinitely far away, or as good as that.
EnvironmentHit environment_met(vec3 from_origin, vec3 direction_world) {
    return EnvironmentHit(environment_in_cube(direction_world), 1.0, false);
}
#endif

// The light from a world direction (from the surface outwards, of any length) at a point. It needs no sign flip, since
// faces are in GL's layout.
vec3 environment_from(vec3 from_origin, vec3 direction_world) {
    EnvironmentHit hit = environment_met(from_origin, direction_world);
    vec3 light = texture(u_cube, hit.direction).rgb;
#ifdef ENVIRONMENT_LAYERS
    if (hit.farthest) light = textureLod(u_farthest, hit.direction, 0.0).rgb;
#endif
    return environment_scaled(light);
}

#include "include/planar_mirror.glsl"
#include "include/probe_grid.glsl"

// The same at the surface, which may be a planar mirror; what the frame shows counts first.
vec3 environment(vec3 direction_world) {
    look_from_surface(direction_world, 0.0);
    return or_screen(or_planar_mirror(environment_from(v_position, direction_world), direction_world, 0.0, 0.0));
}

#ifdef USES_ENVIRONMENT_MIPS
// The same environment with levels that are averages of boxes of texels.
layout(binding = 4) uniform samplerCube u_box_mipmaps;

vec3 environment_mip_from(vec3 from_origin, vec3 direction_world, float lod) {
    EnvironmentHit hit = environment_met(from_origin, direction_world);
    float level = lod + log2(max(hit.spread, 1e-30));
    vec3 light = textureLod(u_box_mipmaps, hit.direction, level).rgb;
#ifdef ENVIRONMENT_LAYERS
    if (hit.farthest) light = textureLod(u_farthest, hit.direction, level).rgb;
#endif
    return environment_scaled(light);
}

// Texels along an edge of level 0.
float environment_size() { return float(textureSize(u_box_mipmaps, 0).x); }

vec3 environment_mip(vec3 direction_world, float lod) {
    // Half the width of a texel of this level, in the middle of a face whose half is 1 wide.
    float spread = exp2(lod) / environment_size();
    look_from_surface(direction_world, spread);
    vec3 light = environment_mip_from(v_position, direction_world, lod);
    return or_screen(or_planar_mirror(light, direction_world, spread, 0.0));
}
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

// The filtered radiance round a direction of the cube at a level, between two levels linearly; level 0 is the cube
// itself.
vec3 environment_seen(vec3 direction, float level) {
    int lower = clamp(int(level), 0, max(u_environment_levels.x - 2, 0));
    vec4 on = cube_place(direction);
    // Every fragment makes all lookups: the level of a mipmapped lookup depends on the neighbour fragments.
    vec3 sharp = texture(u_cube, direction).rgb;
    vec3 low = environment_place(u_environment_places[lower], on);
    vec3 high = environment_place(u_environment_places[lower + 1], on);
    return mix(lower == 0 ? sharp : low, high, clamp(level - float(lower), 0.0, 1.0));
}

// The mean of the radiance around a direction, weighted by the cosine: irradiance / pi.
// A planar mirror shows no irradiance, so that this is that of the scene's environment.
vec3 environment_around(vec3 normal_world) {
    vec3 normal = environment_in_cube(normal_world);
    return environment_scaled(environment_place(u_environment_places[0], cube_place(normal)));
}
#else
// Without filtered levels the mipmaps replace them, or the cube itself if it has none.
float environment_level_of(float roughness) {
    return clamp(roughness, 0.0, 1.0) * float(max(u_environment_levels.x - 1, 0));
}

vec3 environment_seen(vec3 direction, float level) { return textureLod(u_cube, direction, level).rgb; }

vec3 environment_around(vec3 normal_world) {
    return environment_scaled(environment_seen(environment_in_cube(normal_world), environment_level_of(1.0)));
}
#endif

// The same, or that of the scene's grid of probes.
vec3 environment_irradiance(vec3 normal_world) { return or_probe_grid(environment_around(normal_world), normal_world); }

// The radiance that comes to a point round a direction, filtered by the lobe of GGX for a roughness from 0 (the cube
// itself) to 1.
vec3 environment_filtered_from(vec3 from_origin, vec3 direction_world, float roughness) {
    EnvironmentHit hit = environment_met(from_origin, direction_world);
    float seen = roughness;
#ifdef ENVIRONMENT_NEAR
    seen = roughness_from_there(roughness, hit.spread);
#endif
    vec3 light = environment_seen(hit.direction, environment_level_of(seen));
#ifdef ENVIRONMENT_LAYERS
    if (hit.farthest) {
        // A wide lobe sees what hides and what is hidden: the nearest surfaces have both. A sharp one sees one of them.
        vec3 hidden = textureLod(u_farthest, hit.direction, farthest_level(seen)).rgb;
        light = mix(hidden, light, min(seen / 0.3, 1.0));
    }
#endif
    return environment_scaled(light);
}

// The same at the surface, which may be a planar mirror.
vec3 environment_filtered(vec3 direction_world, float roughness) {
    look_from_surface(direction_world, screen_spread(roughness));
    vec3 light = environment_filtered_from(v_position, direction_world, roughness);
    return or_screen(or_planar_mirror(light, direction_world, planar_mirror_spread(roughness), 0.0));
}
#endif

#ifdef USER_SOURCE
// The environment at a chosen level of detail; 0 is the finest. The levels of a filtered environment are those of its
// roughnesses.
vec3 environment_lod_from(vec3 from_origin, vec3 direction_world, float level) {
    EnvironmentHit hit = environment_met(from_origin, direction_world);
#ifdef ENVIRONMENT_FILTERED
    return environment_scaled(environment_seen(hit.direction, level));
#else
    return environment_scaled(textureLod(u_cube, hit.direction, level).rgb);
#endif
}

// How wide what a level shows is: half of it over its distance.
float environment_lod_spread(float level) {
#ifdef ENVIRONMENT_FILTERED
    return screen_spread(level / float(max(u_environment_levels.x - 1, 1)));
#else
    return level <= 0.0 ? 0.0 : exp2(level) / float(textureSize(u_cube, 0).x);
#endif
}

vec3 environment_lod(vec3 direction_world, float level) {
    look_from_surface(direction_world, environment_lod_spread(level));
    vec3 light = environment_lod_from(v_position, direction_world, level);
    return or_screen(or_planar_mirror(light, direction_world, 0.0, level));
}

// The number of levels of the environment: 1 without mipmaps or filtered levels, 0 without an environment.
int environment_levels() { return u_environment_levels.x; }

// Whether a probe captured the environment in this world. Otherwise it is a photograph, which is infinitely far away.
bool environment_is_local() { return u_environment_position.w != 0.0; }

// The world position where the environment was captured; for a photograph the world's origin.
vec3 environment_position() {
    return environment_is_local() ? u_environment_position.xyz + u_origin.xyz : vec3(0.0);
}
#endif
