// Makes the texture in which reflections on the screen are followed (cpp/cubecam/render/passes/screen_depth_pass.hpp): with PIXELS
// the depth and the node id of each pixel; with FIRST the nearest and the farthest depth of cells of 2 pixels; else of larger
// cells, from those of half the size.
layout(location = 0) uniform int u_layer;
layout(location = 0) out vec2 o_depths;

#ifdef PIXELS
layout(binding = 0) uniform sampler2DArray u_depth;
layout(binding = 1) uniform isampler2DArray u_ids;

void main() {
    // Beyond the picture its border goes on.
    ivec3 pixel = ivec3(min(ivec2(gl_FragCoord.xy), textureSize(u_depth, 0).xy - 1), u_layer);
    o_depths = vec2(texelFetch(u_depth, pixel, 0).r, float(texelFetch(u_ids, pixel, 0).r));
}
#else
layout(binding = 0) uniform sampler2DArray u_depths;  // its base is the level before

void main() {
    ivec2 last = textureSize(u_depths, 0).xy - 1;
    ivec2 cell = 2 * ivec2(gl_FragCoord.xy);
    vec2 range = vec2(0.0, 1.0);
#ifdef FIRST
    // A bilinear lookup in a cell also sees the texels beside the cell.
    for (int y = -1; y <= 2; ++y) {
        for (int x = -1; x <= 2; ++x) {
            float depth = texelFetch(u_depths, ivec3(clamp(cell + ivec2(x, y), ivec2(0), last), u_layer), 0).r;
            range = vec2(max(range.x, depth), min(range.y, depth));
        }
    }
#else
    for (int i = 0; i < 4; ++i) {
        vec2 part = texelFetch(u_depths, ivec3(min(cell + ivec2(i & 1, i >> 1), last), u_layer), 0).rg;
        range = vec2(max(range.x, part.x), min(range.y, part.y));
    }
#endif
    o_depths = range;
}
#endif
