// What a surface sees between several probes: the sum of what each of them shows, by the place from which a ray starts. The
// functions of environment.glsl are there for each of the environments, with its number behind their names; here are those
// that materials call. docs/adr/0030-several-probes.md, python/cubecam/truth/shading/influence.py.

// Where a probe counts (cpp/cubecam/render/resources/environment.hpp).
struct Influence {
    vec4 to_box[3];    // rows of the matrix to the space in which the box is from -1 to 1, from relative to u_origin
    vec4 from_box[3];  // xyz: rows of its inverse, without the place; [0].w: 1 / blend distance; [1].w: 1: an ellipsoid
};
layout(std140, binding = 12) uniform Influences {
    Influence u_influences[4];
};

// From 1 in the box, or in the ellipsoid in it, to 0 at the blend distance: 1 - 3 t^2 + 2 t^3 of the distance over it. The
// distance is that from the nearest point of the box, and from the surface of the ellipsoid along the line to its middle.
float influence_at(Influence influence, vec3 from_origin) {
    vec4 from = vec4(from_origin, 1.0);
    vec3 at = vec3(dot(influence.to_box[0], from), dot(influence.to_box[1], from), dot(influence.to_box[2], from));
    vec3 inside = influence.from_box[1].w > 0.0 ? at / max(length(at), 1.0) : clamp(at, -1.0, 1.0);
    vec3 outside = at - inside;
    vec3 way = vec3(dot(influence.from_box[0].xyz, outside), dot(influence.from_box[1].xyz, outside),
                    dot(influence.from_box[2].xyz, outside));
    return 1.0 - smoothstep(0.0, 1.0, length(way) * influence.from_box[0].w);
}

// How much each environment counts at a place; the sum is 1. What the influences leave is that of the last environment, the
// scene's own; where they are more than 1 together, each is divided by their sum.
struct EnvironmentWeights {
    float of[ENVIRONMENT_SOURCES];
};
EnvironmentWeights environment_weights(vec3 from_origin) {
    EnvironmentWeights weights;
    float sum = 0.0;
    for (int i = 0; i < ENVIRONMENT_PROBES; ++i) {
        weights.of[i] = influence_at(u_influences[i], from_origin);
        sum += weights.of[i];
    }
    for (int i = 0; i < ENVIRONMENT_PROBES; ++i) weights.of[i] /= max(sum, 1.0);
#if ENVIRONMENT_SOURCES > ENVIRONMENT_PROBES
    weights.of[ENVIRONMENT_PROBES] = 1.0 - min(sum, 1.0);
#endif
    return weights;
}

#if ENVIRONMENT_SOURCES == 2
#define BLENDED(w, a, b, c, d, e) (w.of[0] * a + w.of[1] * b)
#elif ENVIRONMENT_SOURCES == 3
#define BLENDED(w, a, b, c, d, e) (w.of[0] * a + w.of[1] * b + w.of[2] * c)
#elif ENVIRONMENT_SOURCES == 4
#define BLENDED(w, a, b, c, d, e) (w.of[0] * a + w.of[1] * b + w.of[2] * c + w.of[3] * d)
#else
#define BLENDED(w, a, b, c, d, e) (w.of[0] * a + w.of[1] * b + w.of[2] * c + w.of[3] * d + w.of[4] * e)
#endif

vec3 environment_from(vec3 from_origin, vec3 way) {
    EnvironmentWeights w = environment_weights(from_origin);
    return BLENDED(w, environment_from_0(from_origin, way), environment_from_1(from_origin, way),
                   environment_from_2(from_origin, way), environment_from_3(from_origin, way),
                   environment_from_4(from_origin, way));
}

vec3 environment(vec3 direction_world) {
    look_from_surface(direction_world, 0.0);
    return or_screen(environment_from(v_position, direction_world));
}

#ifdef USES_ENVIRONMENT_MIPS
float environment_size() { return environment_size_0(); }

// Levels count in the first environment: another's has as wide texels at another level.
#define LEVEL(size) (lod + log2(size / environment_size_0()))
vec3 environment_mip(vec3 way, float lod) {
    vec3 from = v_position;
    EnvironmentWeights w = environment_weights(from);
    look_from_surface(way, exp2(lod) / environment_size_0());
    return or_screen(BLENDED(w, environment_mip_from_0(from, way, lod),
                             environment_mip_from_1(from, way, LEVEL(environment_size_1())),
                             environment_mip_from_2(from, way, LEVEL(environment_size_2())),
                             environment_mip_from_3(from, way, LEVEL(environment_size_3())),
                             environment_mip_from_4(from, way, LEVEL(environment_size_4()))));
}
#endif

#ifdef USES_FILTERED_ENVIRONMENT
vec3 brdf_terms(float n_dot_v, float roughness) { return brdf_terms_0(n_dot_v, roughness); }

vec3 environment_irradiance(vec3 normal) {
    EnvironmentWeights w = environment_weights(v_position);
    vec3 light = BLENDED(w, environment_around_0(normal), environment_around_1(normal), environment_around_2(normal),
                         environment_around_3(normal), environment_around_4(normal));
    return or_probe_grid(light, normal);
}

vec3 environment_filtered_from(vec3 from, vec3 way, float roughness) {
    EnvironmentWeights w = environment_weights(from);
    return BLENDED(w, environment_filtered_from_0(from, way, roughness), environment_filtered_from_1(from, way, roughness),
                   environment_filtered_from_2(from, way, roughness), environment_filtered_from_3(from, way, roughness),
                   environment_filtered_from_4(from, way, roughness));
}

vec3 environment_filtered(vec3 way, float roughness) {
    look_from_surface(way, screen_spread(roughness));
    return or_screen(environment_filtered_from(v_position, way, roughness));
}
#endif

#ifdef USER_SOURCE
vec3 environment_lod(vec3 way, float level) {
    vec3 from = v_position;
    EnvironmentWeights w = environment_weights(from);
    look_from_surface(way, environment_lod_spread_0(level));
    return or_screen(BLENDED(w, environment_lod_from_0(from, way, level), environment_lod_from_1(from, way, level),
                             environment_lod_from_2(from, way, level), environment_lod_from_3(from, way, level),
                             environment_lod_from_4(from, way, level)));
}

// Those of the first probe that reaches the node.
int environment_levels() { return environment_levels_0(); }
bool environment_is_local() { return environment_is_local_0(); }
vec3 environment_position() { return environment_position_0(); }
#endif
