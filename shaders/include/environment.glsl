layout(binding = 1) uniform samplerCube u_cube;

// The light from a world direction (from the surface outwards, of any length). It needs no sign flip, since faces are
// in GL's layout.
vec3 environment(vec3 direction_world) { return texture(u_cube, direction_world).rgb; }

#ifdef USER_SOURCE
#ifdef USES_ENVIRONMENT
layout(std140, binding = 5) uniform Environment {
    vec4 u_environment_position;  // xyz: position of the capture, relative to u_origin; w: 1. All 0: infinitely far away
    ivec4 u_environment_levels;   // x: how many levels; 0: there is no environment
};
#else
const vec4 u_environment_position = vec4(0.0);
const ivec4 u_environment_levels = ivec4(0);
#endif
#endif
