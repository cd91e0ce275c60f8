// Lights that have a direction; ambient ones are in the material's own term already. Those with a shadow come first.
const int MAX_LIGHTS = 256;

struct Light {
    vec4 position;  // xyz: where it is, from u_origin (w = 1), or the direction towards it (w = 0); world
    vec4 color;     // rgb: linear colour times intensity; a: decay
    vec4 cone;      // spot lights: xyz: the way they point, stretched; w: see cone_share. Others: all 0, but w of 1
};

// Declared where it is read. Of a known number of lights no more than these: a driver may copy the block for each draw.
#ifdef VERTEX_STAGE
#define LIGHTS_READ FLAT_LIGHT_COUNT
#elif defined(LIGHT_COUNT)
#define LIGHTS_READ (LIGHT_COUNT > FLAT_LIGHT_COUNT ? LIGHT_COUNT : 0)
#else
#define LIGHTS_READ MAX_LIGHTS
#endif
#if defined(VERTEX_STAGE) || !defined(LIGHT_COUNT) || LIGHT_COUNT > FLAT_LIGHT_COUNT
layout(std140, binding = 1) uniform Lights {
    ivec4 u_counts;  // x: number of lights
    vec4 u_ambient;  // rgb: the scene's ambient lights
    Light u_lights[LIGHTS_READ];
};
#endif

// How much of a spot light goes a way (unit length, from the light): 0 outside its cone, 1 where the penumbra ends.
float cone_share(vec4 cone, vec3 way) {
    float t = clamp(dot(cone.xyz, way) + cone.w, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}
