layout(binding = 1) uniform samplerCube u_cube;

// What comes from a world direction (from the surface outwards, any length). No sign flip: faces are in GL's layout.
vec3 environment(vec3 direction_world) { return texture(u_cube, direction_world).rgb; }
