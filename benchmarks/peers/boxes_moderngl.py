"""Ten thousand moving boxes in moderngl: one instanced draw of all, or a draw for each."""

from __future__ import annotations

import moderngl
import numpy as np

from .. import boxes, scene
from .moderngl_frame import ONE_NODE, PHONG, PHONG_UNIFORMS, Frame, matrix_bytes, set_uniforms

INSTANCED = """
#version 330 core
uniform mat4 view_projection;
uniform vec3 palette[{colors}];
in vec3 in_position;
in vec3 in_normal;
in mat4 in_model;
in int in_material;
out vec3 v_position;
out vec3 v_normal;
flat out vec3 v_color;
void main() {{
    vec4 world = in_model * vec4(in_position, 1.0);
    v_position = world.xyz;
    v_normal = mat3(in_model) * in_normal;
    v_color = palette[in_material];
    gl_Position = view_projection * world;
}}
"""

FRAGMENT = """
#version 330 core
in vec3 v_position;
in vec3 v_normal;
{color}
layout (location = 0) out vec4 out_color;
"""
LIT = PHONG + "void main() { out_color = vec4(phong(color, v_position, v_normal), 1.0); }"
UNLIT = "void main() { out_color = vec4(color, 1.0); }"
BY_INSTANCE = "flat in vec3 v_color;\n#define color v_color"
BY_UNIFORM = "uniform vec3 color;"


def _fragment(color: str, lit: bool) -> str:
    head = FRAGMENT.format(color=color).lstrip()
    return head + (PHONG_UNIFORMS + LIT if lit else UNLIT)


class _Boxes:
    def __init__(self, count: int, colors: int) -> None:
        self.boxes = boxes.Boxes(count, colors)
        self.frame = Frame(boxes.FRAME_SIZE, boxes.CLEAR)
        positions, normals, triangles = boxes.box_arrays()
        self.vertices = self.frame.ctx.buffer(np.hstack([positions, normals]).tobytes())
        self.triangles = self.frame.ctx.buffer(triangles.astype(np.uint16).tobytes())
        # Matrices are stored as in GL, columns first, so the last row of each is the position.
        self.models = np.zeros((count, 4, 4), np.float32)
        self.models[:, :3, :3] = np.swapaxes(self.boxes.rotations(), 1, 2)
        self.models[:, 3, 3] = 1

    def _program(self, vertex: str, fragment: str) -> moderngl.Program:
        program = self.frame.ctx.program(vertex_shader=vertex.lstrip(), fragment_shader=fragment)
        aspect = boxes.FRAME_SIZE[0] / boxes.FRAME_SIZE[1]
        projection = scene.perspective(boxes.FOV, aspect, boxes.NEAR, boxes.FAR)
        view = scene.look_at(boxes.EYE, np.negative(boxes.EYE), (0, 1, 0))
        program["view_projection"].write(matrix_bytes(projection @ view))
        weights = (boxes.KA, boxes.KD, boxes.KS, boxes.SHININESS)
        set_uniforms(program, light=boxes.LIGHT, eye=boxes.EYE, weights=weights)
        return program

    def prepare(self, index: int) -> None:
        self.positions = self.boxes.positions(index)

    def move(self, index: int) -> None:
        self.models[:, 3, :3] = self.positions


class Instanced(_Boxes):
    """One draw call; each instance has a matrix and the number of a material."""

    def __init__(self, count: int, colors: int, lit: bool = True) -> None:
        super().__init__(count, colors)
        program = self._program(INSTANCED.format(colors=colors), _fragment(BY_INSTANCE, lit))
        program["palette"].write(self.boxes.palette.astype(np.float32).tobytes())
        self.instances = self.frame.ctx.buffer(self.models)
        materials = self.frame.ctx.buffer(self.boxes.material.astype(np.int32).tobytes())
        content = [
            (self.vertices, "3f 3f" if lit else "3f 12x", "in_position", "in_normal")[: 4 if lit else 3],
            (self.instances, "16f/i", "in_model"),
            (materials, "1i/i", "in_material"),
        ]  # fmt: skip
        self.array = self.frame.ctx.vertex_array(
            program, content, self.triangles, index_element_size=2
        )

    def move(self, index: int) -> None:
        super().move(index)
        self.instances.write(self.models)

    def draw(self, index: int) -> np.ndarray:
        self.frame.begin()
        self.array.render(instances=self.boxes.count)
        return self.frame.read()


class Loop(_Boxes):
    """One draw call for each box, before which the box's matrix and colour are set."""

    def __init__(self, count: int, colors: int, lit: bool = True) -> None:
        super().__init__(count, colors)
        program = self._program(ONE_NODE, _fragment(BY_UNIFORM, lit))
        content = (self.vertices, "3f 3f" if lit else "3f 12x", "in_position", "in_normal")
        self.array = self.frame.ctx.vertex_array(
            program, [content[: 4 if lit else 3]], self.triangles, index_element_size=2
        )
        self.model, self.color = program["model"], program["color"]
        self.colors = [tuple(color) for color in self.boxes.palette[self.boxes.material].tolist()]

    def draw(self, index: int) -> np.ndarray:
        self.frame.begin()
        model, color, render = self.model, self.color, self.array.render
        for matrix, own in zip(self.models, self.colors, strict=True):
            model.write(matrix)
            color.value = own
            render()
        return self.frame.read()
