// Makes the texture of distances of a cube from its depth buffers (cpp/cubecam/render/passes/distance_pass.hpp).
layout(binding = 0) uniform samplerCube u_nearest;
#ifdef LAYERS
layout(binding = 1) uniform samplerCube u_farthest;
#endif
layout(location = 0) uniform int u_size;    // texels along an edge of a face
layout(location = 1) uniform vec2 u_range;  // 1 / near, 1 / far
layout(location = 0) out vec2 o_nearness;

// The direction of a texel, of length 1 along the face's axis; texels of the border lie beyond the face.
vec3 direction_of(ivec2 texel) {
    ivec2 face = texel / (u_size + 2);
    vec2 place = (vec2(texel - face * (u_size + 2)) - 0.5) * (2.0 / float(u_size)) - 1.0;
    float s = face.y == 0 ? 1.0 : -1.0;
    if (face.x == 0) return vec3(s, -place.y, -s * place.x);
    if (face.x == 1) return vec3(place.x, s, s * place.y);
    return vec3(s * place.x, -place.y, s);
}

// 1 / z from a depth, which is 1 at the near plane and 0 at the far one (docs/adr/0001).
float nearness(float depth) { return depth * (u_range.x - u_range.y) + u_range.y; }

void main() {
    vec3 direction = direction_of(ivec2(gl_FragCoord.xy));
    // A texel of the border belongs to another face, and the depth counts along that face's axis.
    float turned = max(max(abs(direction.x), abs(direction.y)), abs(direction.z));
    float depth = textureLod(u_nearest, direction, 0.0).r;
    o_nearness = vec2(depth > 0.0 ? turned * nearness(depth) : 0.0, 0.0);
#ifdef LAYERS
    depth = textureLod(u_farthest, direction, 0.0).r;
    o_nearness.y = depth < 1.0 ? turned * nearness(depth) : 0.0;
#endif
}
