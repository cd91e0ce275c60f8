#include "include/environment.glsl"

in vec4 v_near;
in vec4 v_far;
layout(location = 0) out vec4 o_color;

void main() {
    // far / far.w - near / near.w without the division by far.w, which a float loses for far / near of 1e8. This also
    // works for parallel views, where every pixel has the same direction.
    vec3 direction = (v_far.xyz * v_near.w - v_near.xyz * v_far.w) * sign(v_near.w);
    o_color = vec4(environment(normalize(direction)), 1.0);
}
