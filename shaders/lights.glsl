// Lights that have a direction; ambient ones are summed up in u_ambient.
const int MAX_LIGHTS = 256;

struct Light {
    vec4 position;  // xyz: where it is (w = 1), or the direction towards it (w = 0); world
    vec4 color;     // rgb: linear colour times intensity; a: decay
};

layout(std140, binding = 1) uniform Lights {
    vec4 u_ambient;  // rgb: 1, the model's own ambient term, plus the ambient lights
    ivec4 u_counts;  // x: number of lights
    Light u_lights[MAX_LIGHTS];
};

#ifndef LIGHT_COUNT
#define LIGHT_COUNT u_counts.x
#endif

// Distance falloff: distance^-decay.
float light_falloff(Light light, float distance_squared) {
#ifdef LIGHT_DECAY
    return light.position.w == 0.0 ? 1.0 : pow(distance_squared, -0.5 * light.color.a);
#else
    return 1.0;
#endif
}
