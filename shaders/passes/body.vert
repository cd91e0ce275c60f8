// The mesh of a body as a point sees it through a face of a cube and a border of one texel (cpp/cubecam/render/passes/
// body_pass.hpp).
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;

layout(location = 0) uniform int u_face;  // 2 * axis, plus 1 for a negative one
layout(location = 1) uniform float u_edge;  // texels of a face over those with the border
layout(location = 2) uniform vec3 u_body_middle;
layout(location = 3) uniform vec3 u_body_half;

out vec3 v_normal;
invariant v_normal;
invariant gl_Position;

void main() {
    vec3 p = (a_position - u_body_middle) / u_body_half;
    int axis = u_face / 2;
    float s = u_face % 2 == 0 ? 1.0 : -1.0;
    // The axes of faces: cpp/cubecam/math/cube_face.hpp.
    vec3 at = axis == 0 ? vec3(-s * p.z, -p.y, s * p.x)
                        : axis == 1 ? vec3(p.x, s * p.z, s * p.y) : vec3(s * p.x, -p.y, s * p.z);
    // A constant z is a reversed depth: near planes are at 1e-4.
    gl_Position = vec4(u_edge * at.xy, 1e-4, at.z);
    v_normal = u_body_half * a_normal;
}
