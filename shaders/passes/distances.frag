// Makes the texture of distances of a captured cube (cpp/cubecam/render/passes/distance_pass.hpp) in three steps: 1 / z of each
// texel from the depth buffers; the greatest number of each block of texels; that of the blocks around each block.
#include "include/cube_place.glsl"

layout(location = 0) uniform int u_size;  // texels along an edge of a face
layout(location = 0) out vec2 o_nearness;

#if defined(FACES)
layout(location = 1) uniform vec2 u_range;  // 1 / near, 1 / far
layout(binding = 0) uniform samplerCube u_nearest;
#ifdef LAYERS
layout(binding = 1) uniform samplerCube u_farthest_depth;
#endif

// 1 / z from a depth, which is 1 at the near plane and 0 at the far one (docs/adr/0001).
float nearness(float depth) { return depth * (u_range.x - u_range.y) + u_range.y; }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 face = pixel / (u_size + 2);
    // Texels of the border lie beyond the face.
    vec2 on = (vec2(pixel - face * (u_size + 2)) - 0.5) / float(u_size);
    vec3 direction = cube_direction(vec4(face, on));
    // There a texel belongs to another face, and its depth counts along that face's axis.
    float turned = max(max(abs(direction.x), abs(direction.y)), abs(direction.z));
    float depth = textureLod(u_nearest, direction, 0.0).r;
    o_nearness = vec2(depth > 0.0 ? turned * nearness(depth) : 0.0, 0.0);
#ifdef LAYERS
    depth = textureLod(u_farthest_depth, direction, 0.0).r;
    o_nearness.y = depth < 1.0 ? turned * nearness(depth) : 0.0;
#endif
}

#elif defined(NEAREST_OF_BLOCK)
layout(binding = 0) uniform sampler2D u_distances;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 face = pixel / DISTANCE_BLOCKS;
    ivec2 block = pixel - face * DISTANCE_BLOCKS;
    // A bilinear lookup in the block also sees the texels beside the block.
    ivec2 first = block * u_size / DISTANCE_BLOCKS;
    ivec2 last = (block * u_size + u_size - 1) / DISTANCE_BLOCKS + 2;
    float greatest = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            greatest = max(greatest, texelFetch(u_distances, face * (u_size + 2) + ivec2(x, y), 0).r);
        }
    }
    o_nearness = vec2(greatest, 0.0);
}

#else
layout(binding = 0) uniform sampler2D u_blocks;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy) - ivec2(0, 2 * (u_size + 2));
    ivec2 face = pixel / DISTANCE_BLOCKS;
    vec2 middle = vec2(pixel - face * DISTANCE_BLOCKS) + 0.5;
    float greatest = 0.0;
    // Beyond an edge the blocks of the next face lie a little askew, so that one step is not a whole block.
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            vec2 on = (middle + 0.625 * vec2(x, y)) / float(DISTANCE_BLOCKS);
            ivec2 block = cube_block(cube_place(cube_direction(vec4(face, on))));
            greatest = max(greatest, texelFetch(u_blocks, block, 0).r);
        }
    }
    o_nearness = vec2(greatest, 0.0);
}
#endif
