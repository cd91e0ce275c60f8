// The scene behind a transmissive surface: a picture of the same view without such surfaces, with mip levels
// (cpp/cubecam/render/graph/behind_picture.hpp). A material whose kind says shows_behind() can call scene_behind().
#ifdef SHOWS_BEHIND
#ifdef BEHIND_CUBE
layout(binding = 5) uniform samplerCube u_behind;
#else
layout(binding = 5) uniform sampler2DArray u_behind;
#endif

// The light that comes from `direction_world` (from the surface outwards) and leaves the body at a point, relative to
// u_origin. The picture knows only the light towards the eye from where the point appears in it; outside of the picture
// there is the environment. A rough surface looks up the level log2(width) * roughness, the rule of three.js.
vec3 scene_behind(vec3 exit_from_origin, vec3 direction_world, float roughness) {
    float level = log2(float(textureSize(u_behind, 0).x)) * clamp(roughness, 0.0, 1.0);
#ifdef BEHIND_CUBE
    return textureLod(u_behind, exit_from_origin, level).rgb;  // u_origin is the position of the views
#else
    vec4 exit = vec4(exit_from_origin, 1.0);
    float w = dot(v_clip_rows[2], exit);
    vec2 uv = 0.5 + 0.5 * vec2(dot(v_clip_rows[0], exit), dot(v_clip_rows[1], exit)) / w;
    vec3 seen = textureLod(u_behind, vec3(uv, v_layer), level).rgb;
#if defined(USES_FILTERED_ENVIRONMENT)
    vec3 around = environment_filtered(direction_world, roughness);
#elif defined(USES_ENVIRONMENT)
    vec3 around = environment(direction_world);
#else
    vec3 around = vec3(0.0);
#endif
    return w > 0.0 && clamp(uv, 0.0, 1.0) == uv ? seen : around;
#endif
}
#endif
