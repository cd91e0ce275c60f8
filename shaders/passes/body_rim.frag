// Closes a body that its middle sees from outside (cpp/cubecam/render/passes/body_pass.hpp): the first texel beyond a
// silhouette, where there is nothing, gets the middle between both sides of its neighbours. Between it and the last texel of
// the body a lookup then finds a body that becomes thinner, and not one that reaches far away, since 1 / z becomes 0.
layout(binding = 0) uniform sampler2D u_nearness;
layout(location = 0) out vec2 o_nearness;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 face = pixel / (BODY_SIZE + 2);
    vec2 own = texelFetch(u_nearness, pixel, 0).xy;
    vec2 sum = vec2(0.0);  // of the neighbours: 1 / z, and how many they are
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = pixel + ivec2(x, y);
            if (at.x < 0 || at.y < 0 || at / (BODY_SIZE + 2) != face) continue;
            vec2 nearness = texelFetch(u_nearness, at, 0).xy;
            if (min(nearness.x, nearness.y) > 0.0) sum += vec2(0.5 * (nearness.x + nearness.y), 1.0);
        }
    }
    o_nearness = max(own.x, own.y) > 0.0 || sum.y == 0.0 ? own : vec2(sum.x / sum.y);
}
