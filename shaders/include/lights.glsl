// Lights that have a direction; the term of the material already contains the ambient ones. Lights with a shadow come
// first.
const int MAX_LIGHTS = 256;

struct Light {
    // xyz: its position, from u_origin, or the direction towards it (w = 0); world. w of a light with a position: 1, or
    // -1 / range if it has a range.
    vec4 position;
    vec4 color;     // rgb: linear colour times intensity; a: decay
    vec4 cone;      // spot lights: xyz: scaled direction in which they point; w: see cone_share. Others: 0, 0, 0, 1
};

// The block is declared if the stage reads it. A known number of lights limits its length, since a driver may copy the
// block for each draw. Both stages declare the same block, or they do not link.
#ifdef LIGHT_COUNT
#define LIGHTS_READ LIGHT_COUNT
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

// 1 for a light with a position, 0 for a directional one. Without any range, w is that number.
float is_at_place(vec4 position) {
#if defined(LIGHT_RANGE) || defined(USER_SOURCE)
    return abs(sign(position.w));
#else
    return position.w;
#endif
}

// The share of a light that its range leaves (KHR_lights_punctual): max(min(1 - (distance / range)^4, 1), 0).
float range_share(vec4 position, float distance_squared) {
    float share = distance_squared * position.w * position.w;
    return position.w < 0.0 ? max(1.0 - share * share, 0.0) : 1.0;
}

// The share of a spot light in a direction (unit length, from the light): 0 outside its cone, 1 where the penumbra
// ends; between them the square that KHR_lights_punctual recommends.
float cone_share(vec4 cone, vec3 way) {
    float t = clamp(dot(cone.xyz, way) + cone.w, 0.0, 1.0);
    return t * t;
}
