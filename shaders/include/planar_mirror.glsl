// What a planar mirror shows: a picture of the same view, mirrored at the mirror's plane
// (cpp/cubecam/render/graph/planar_mirror_picture.hpp, docs/adr/0027). A point of the mirror lies at the same place in
// both, so that a smooth flat surface shows the picture's own pixel.
#ifdef PLANAR_MIRROR
#ifdef PLANAR_MIRROR_CUBE
layout(binding = 0) uniform samplerCube u_planar_mirror;
#else
layout(binding = 0) uniform sampler2DArray u_planar_mirror;
#endif

// The light from a world direction (from the surface outwards). Directions that go through the mirror's plane see
// `light`, since the picture does not know what lies behind the mirror. `spread` is the tangent of half the angle from
// which a rough surface gathers light; `level` is added to the level that follows from it.
//
// Other directions than that of the flat mirror are taken to end at the distance w from the surface: they are looked up
// where the mirror image of that end appears. That is exact for things at this distance, and for all directions of a
// flat mirror.
vec3 or_planar_mirror(vec3 light, vec3 direction_world, float spread, float level) {
    vec3 normal = u_environment_planar.xyz;
    vec3 direction = direction_world * inversesqrt(max(dot(direction_world, direction_world), 1e-36));
    vec3 incident = v_eye.w == 0.0 ? normalize(v_position - v_eye.xyz) : v_eye.xyz;
    float height = dot(direction, normal);
    bool through = height * dot(incident, normal) >= 0.0;
    vec3 unmirrored = direction - 2.0 * height * normal;
    float way = u_environment_planar.w;
    vec3 straight = v_position + way * incident;
    vec3 bent = v_position + way * unmirrored;
    vec2 size = vec2(textureSize(u_planar_mirror, 0).xy);
#ifdef PLANAR_MIRROR_CUBE
    // A face is two wide at the distance 1.
    level += log2(1.0 + spread * way / length(straight - v_eye.xyz) * size.x);
    vec3 seen = textureLod(u_planar_mirror, bent - v_eye.xyz, level).rgb;
#else
    float w_straight = dot(v_clip_rows[2], vec4(straight, 1.0));
    float w_bent = dot(v_clip_rows[2], vec4(bent, 1.0));
    // Beside the eye there is no picture.
    through = through || !(w_bent > 0.05 * w_straight);
    vec2 at_straight = vec2(dot(v_clip_rows[0], vec4(straight, 1.0)), dot(v_clip_rows[1], vec4(straight, 1.0)));
    vec2 at_bent = vec2(dot(v_clip_rows[0], vec4(bent, 1.0)), dot(v_clip_rows[1], vec4(bent, 1.0)));
    vec2 shift = 0.5 * size * (at_bent / w_bent - at_straight / w_straight);
    level += log2(1.0 + spread * way * length(v_clip_rows[1].xyz) / w_straight * size.y);
    // Rounding must not bend the rays of a flat mirror.
    bool own_pixel = dot(shift, shift) < 1.0 / 256.0 && level == 0.0;
    vec2 place = (floor(gl_FragCoord.xy) + 0.5 + (through ? vec2(0.0) : shift)) / size;
    vec3 seen = own_pixel ? texelFetch(u_planar_mirror, ivec3(gl_FragCoord.xy, v_layer), 0).rgb
                          : textureLod(u_planar_mirror, vec3(place, v_layer), level).rgb;
#endif
    return through ? light : seen;
}

// For a roughness: facets of GGX lie within this tangent's angle of the normal for half of all directions, and what they
// reflect turns by twice that angle (B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR
// 2007, equation 35).
float planar_mirror_spread(float roughness) {
    float alpha = roughness * roughness;
    return 2.0 * alpha / max(1.0 - alpha * alpha, 0.1);
}
#else
#define or_planar_mirror(light, direction_world, spread, level) light
#endif
