// Lights that have a direction; ambient ones are in the material's own term already.
const int MAX_LIGHTS = 256;

struct Light {
    vec4 position;  // xyz: where it is, from u_origin (w = 1), or the direction towards it (w = 0); world
    vec4 color;     // rgb: linear colour times intensity; a: decay
};

layout(std140, binding = 1) uniform Lights {
    ivec4 u_counts;   // x: number of lights
    vec4 u_ambient;   // rgb: 1, the models' own ambient light, plus the scene's
    Light u_lights[MAX_LIGHTS];
};
