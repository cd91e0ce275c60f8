"""The GLSL of program P14 that the peers share: the shaders that document 000 prints, in modern GLSL.

Block 0 holds the data of a view, block 1 those of an object; both are std140.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from . import scene

BLOCKS = """
layout (std140{binding0}) uniform View {{ mat4 u_view_projection; vec4 u_eye; }};
layout (std140{binding1}) uniform Object {{ mat4 u_model; mat4 u_normal; vec4 u_color; }};
"""

VERTEX = """
layout (location = 0) in vec3 in_position;
layout (location = 1) in vec3 in_normal;
out vec3 v_position;
out vec3 v_normal;
void main() {
    vec4 world = u_model * vec4(in_position, 1.0);
    v_position = world.xyz;
    v_normal = mat3(u_normal) * in_normal;
    gl_Position = u_view_projection * world;
}
"""

PHONG = f"""
in vec3 v_position;
in vec3 v_normal;
layout (location = 0) out vec4 out_color;
void main() {{
    vec3 normal = normalize(v_normal);
    vec3 light_dir = normalize(vec3{scene.LIGHT} - v_position);
    float n_dot_l = max(dot(light_dir, normal), 0.0);
    vec3 color = u_color.rgb * ({scene.KA} + {scene.KD} * n_dot_l);
    if (n_dot_l > 0.0) {{
        vec3 reflected = reflect(-light_dir, normal);
        vec3 view_dir = normalize(u_eye.xyz - v_position);
        color += {scene.KS} * pow(clamp(dot(reflected, view_dir), 0.0, 1.0), {scene.SHININESS});
    }}
    out_color = vec4(color, 1.0);
}}
"""

MIRROR = f"""
in vec3 v_position;
in vec3 v_normal;
layout (location = 0) out vec4 out_color;
uniform samplerCube u_environment;
void main() {{
    vec3 incident = normalize(v_position - u_eye.xyz);
    vec3 direction = reflect(incident, normalize(v_normal));
    vec3 env = texture(u_environment, direction).rgb;
    out_color = vec4({scene.ENV_WEIGHT} * env + {scene.COLOR_WEIGHT} * u_color.rgb, 1.0);
}}
"""


def view_block(view_projection: np.ndarray, eye: Sequence[float]) -> bytes:
    """The bytes of block View."""
    return np.vstack([view_projection.T, [[*eye, 1]]]).astype(np.float32).tobytes()


def object_block(position: Sequence[float], color: Sequence[float]) -> bytes:
    """The bytes of block Object for an object that is moved but not turned, so its mesh's normals stay valid."""
    return (
        np.vstack([scene.translation(position).T, np.eye(4), [[*color, 1]]])
        .astype(np.float32)
        .tobytes()
    )
