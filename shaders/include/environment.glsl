layout(binding = 1) uniform samplerCube u_cube;

// The light from a world direction (from the surface outwards, of any length). It needs no sign flip, since faces are
// in GL's layout.
vec3 environment(vec3 direction_world) { return texture(u_cube, direction_world).rgb; }
