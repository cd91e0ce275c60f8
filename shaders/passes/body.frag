// 1 / z and the normal of what body.vert draws.
in vec3 v_normal;
layout(location = 0) out vec2 o_nearness;  // the state of the pass chooses a channel
layout(location = 1) out vec4 o_normal;

void main() {
    float size = dot(v_normal, v_normal);
    o_nearness = gl_FragCoord.ww;
    o_normal = vec4(size > 0.0 ? v_normal * inversesqrt(size) : vec3(0.0), 1.0);
}
