"""Code that the marks' moderngl programs share: a context with a framebuffer, and a Phong shader."""

from __future__ import annotations

import glcontext
import moderngl
import numpy as np

from .egl import LIBRARIES

# One node a draw call.
ONE_NODE = """
#version 330 core
uniform mat4 view_projection;
uniform mat4 model;
in vec3 in_position;
in vec3 in_normal;
out vec3 v_position;
out vec3 v_normal;
void main() {
    vec4 world = model * vec4(in_position, 1.0);
    v_position = world.xyz;
    v_normal = mat3(model) * in_normal;
    gl_Position = view_projection * world;
}
"""

# Phong's model as cubecam's PhongMaterial has it, for one point light without decay.
PHONG = """
vec3 phong(vec3 color, vec3 position, vec3 normal) {
    vec3 n = normalize(normal);
    vec3 to_light = normalize(light - position);
    float n_dot_l = max(dot(to_light, n), 0.0);
    vec3 result = color * (weights.x + weights.y * n_dot_l);
    if (n_dot_l > 0.0) {
        vec3 to_eye = normalize(eye - position);
        result += weights.z * pow(clamp(dot(reflect(-to_light, n), to_eye), 0.0, 1.0), weights.w);
    }
    return result;
}
"""
PHONG_UNIFORMS = "uniform vec3 light; uniform vec3 eye; uniform vec4 weights;\n"


class Frame:
    """A context and an RGBA8 framebuffer with depth, whose picture is read into kept memory."""

    def __init__(self, size: tuple[int, int], clear: tuple[float, ...]) -> None:
        backend = glcontext.get_backend_by_name("egl")(
            mode="standalone", glversion=420, **LIBRARIES
        )
        self.ctx = moderngl.create_context(context=backend)
        self.ctx.enable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        depth = self.ctx.depth_renderbuffer(size)
        self._target = self.ctx.framebuffer([self.ctx.texture(size, 4)], depth)
        self._clear = clear
        self._pixels = np.empty((size[1], size[0], 4), np.uint8)

    def begin(self) -> None:
        self._target.use()
        self._target.clear(*self._clear)

    def read(self) -> np.ndarray:
        """(H, W, 4) uint8, row 0 on top."""
        self._target.read_into(self._pixels, components=4)
        return self._pixels[::-1]


def set_uniforms(program: moderngl.Program, **values: object) -> None:
    """Set the uniforms that the program has; a compiler removes those that an unlit program does not use."""
    for name, value in values.items():
        if name in program:
            program[name].value = value


def matrix_bytes(matrix: np.ndarray) -> bytes:
    """The bytes of a matrix given in reading order, in GL's order."""
    return np.ascontiguousarray(matrix.T, np.float32).tobytes()
