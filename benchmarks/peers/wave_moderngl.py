"""The waving sheet in moderngl: two buffers that are written again for each frame."""

from __future__ import annotations

import numpy as np

from .. import scene, wave
from .moderngl_frame import PHONG, PHONG_UNIFORMS, Frame, matrix_bytes, set_uniforms

VERTEX = """
#version 330 core
uniform mat4 view_projection;
in vec3 in_position;
in vec3 in_normal;
out vec3 v_position;
out vec3 v_normal;
void main() {
    v_position = in_position;
    v_normal = in_normal;
    gl_Position = view_projection * vec4(in_position, 1.0);
}
"""

FRAGMENT = f"""
#version 330 core
in vec3 v_position;
in vec3 v_normal;
layout (location = 0) out vec4 out_color;
uniform vec3 color;
{PHONG_UNIFORMS}
{PHONG}
void main() {{ out_color = vec4(phong(color, v_position, v_normal), 1.0); }}
"""


class Wave:
    """One vertex array with two streams."""

    def __init__(self) -> None:
        self.frame = Frame(wave.FRAME_SIZE, wave.CLEAR)
        ctx = self.frame.ctx
        program = ctx.program(vertex_shader=VERTEX.lstrip(), fragment_shader=FRAGMENT.lstrip())
        projection = scene.perspective(wave.FOV, 1.0, wave.NEAR, wave.FAR)
        view = scene.look_at(wave.EYE, np.negative(wave.EYE), (0, 1, 0))
        program["view_projection"].write(matrix_bytes(projection @ view))
        weights = (wave.KA, wave.KD, wave.KS, wave.SHININESS)
        set_uniforms(program, light=wave.LIGHT, eye=wave.EYE, weights=weights, color=wave.COLOR)
        positions, normals = wave.arrays(0)
        self.positions_buffer = ctx.buffer(positions, dynamic=True)
        self.normals_buffer = ctx.buffer(normals, dynamic=True)
        content = [
            (self.positions_buffer, "3f", "in_position"),
            (self.normals_buffer, "3f", "in_normal"),
        ]
        self.array = ctx.vertex_array(program, content, ctx.buffer(wave.triangles()))

    def prepare(self, index: int) -> None:
        self.positions, self.normals = wave.arrays(index)

    def move(self, index: int) -> None:
        self.positions_buffer.write(self.positions)
        self.normals_buffer.write(self.normals)

    def draw(self, index: int) -> np.ndarray:
        self.frame.begin()
        self.array.render()
        return self.frame.read()
