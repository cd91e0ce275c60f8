"""Cubemaps of a field in moderngl, as a careful user writes them.

An object is drawn for a face if its bounding sphere touches the face's pyramid, by one draw call; the ground, which is
below all places, is drawn last and for all faces but +Y. The six faces of a cubemap lie one above the other in one
picture, with a viewport each, so that a cubemap is cleared once and each output is read by one call, straight into the
result. Row 0 of GL's picture is row 0 of a face (docs/conventions.md).
"""

from __future__ import annotations

from typing import Any

import glcontext
import moderngl
import numpy as np

from .. import field, scene
from .egl import LIBRARIES
from .moderngl_frame import ONE_NODE, matrix_bytes

FRAGMENT = """
#version 330 core
uniform vec3 eye;
uniform vec3 forward;
uniform vec3 color;
uniform vec4 weights;
uniform vec4 lights[LIGHTS];
in vec3 v_position;
in vec3 v_normal;
layout (location = 0) out vec4 out_color;
OUTPUTS
void main() {
    vec3 n = normalize(v_normal);
    vec3 way = v_position - eye;
    vec3 to_eye = -normalize(way);
    vec3 sum = color * weights.x;
    for (int i = 0; i < LIGHTS; ++i) {
        vec3 to_light = normalize(lights[i].xyz - v_position * lights[i].w);
        float n_dot_l = dot(n, to_light);
        if (n_dot_l <= 0.0) continue;
        float highlight = pow(clamp(dot(reflect(-to_light, n), to_eye), 0.0, 1.0), weights.w);
        sum += (color * weights.y * n_dot_l + weights.z * highlight) / float(LIGHTS);
    }
    out_color = vec4(sum, 1.0);
WRITES
}
"""
# name: its channels in a texture, those that are read, what a fragment writes, and the background
OUTPUTS: dict[str, tuple[int, int, str, float]] = {
    "distance": (1, 1, "length(way)", np.inf),
    "z": (1, 1, "dot(way, forward)", np.inf),
    "normal": (4, 3, "vec4(n, 0.0)", 0.0),
    "position": (4, 3, "vec4(v_position, 0.0)", np.nan),
}


def declared(fragment: str, plan: field.Field) -> str:
    """A fragment shader with the outputs and the number of lights of a field."""
    outputs, writes = "", ""
    for number, name in enumerate(plan.outputs, 1):
        channels, _, value, _ = OUTPUTS[name]
        kind = "float" if channels == 1 else "vec4"
        outputs += f"layout (location = {number}) out {kind} out_{name};\n"
        writes += f"    out_{name} = {value};\n"
    fragment = fragment.replace("OUTPUTS\n", outputs).replace("WRITES\n", writes)
    return fragment.replace("LIGHTS", str(plan.lights))


class Culled:
    """The field in one moderngl context; `at_once`: how many cubemaps are read by one call, one above the other."""

    def __init__(self, at_once: int = 1, **options: Any) -> None:
        self.plan = plan = field.Field.of(options)
        self.at_once = min(at_once, plan.probes)
        field.keep_freed_memory()
        backend = glcontext.get_backend_by_name("egl")(
            mode="standalone", glversion=420, **LIBRARIES
        )
        self.ctx = ctx = moderngl.create_context(context=backend)
        ctx.enable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self.program = program = ctx.program(
            vertex_shader=ONE_NODE.lstrip(),
            fragment_shader=declared(FRAGMENT, plan).lstrip(),
        )
        program["weights"].value = (field.KA, field.KD, field.KS, field.SHININESS)
        program["lights"].write(plan.light_places.astype(np.float32).tobytes())
        self.model, self.color = program["model"], program["color"]
        self.view_projection, self.eye = program["view_projection"], program["eye"]
        self.forward = program.get("forward", None)
        self.mesh, self.ground = (self._array(mesh) for mesh in (plan.mesh, plan.ground))
        self.unmoved = np.eye(4, dtype=np.float32).tobytes()
        self.models = [
            matrix_bytes(model_matrix(place, turn))
            for place, turn in zip(plan.places, plan.turns, strict=True)
        ]
        self.colors = [tuple(plan.palette[i % plan.colors].tolist()) for i in range(plan.nodes)]
        self.projection = scene.perspective(90, 1, field.NEAR, field.FAR)
        self.turned = [
            self.projection @ scene.look_at((0, 0, 0), forward, up)
            for forward, up in zip(scene.FACE_FORWARD, scene.FACE_UP, strict=True)
        ]
        self._targets()

    def _array(self, mesh: scene.MeshArrays) -> moderngl.VertexArray:
        vertices = self.ctx.buffer(mesh.interleaved.tobytes())
        triangles = self.ctx.buffer(mesh.indices.tobytes())
        content = [(vertices, "3f 3f", "in_position", "in_normal")]
        return self.ctx.vertex_array(self.program, content, triangles)

    def _targets(self) -> None:
        plan, ctx = self.plan, self.ctx
        n, samples = plan.size, plan.samples if plan.samples > 1 else 0
        size = (n, 6 * n * self.at_once)
        self.dtype = "f1" if plan.format == "rgba8" else "f4"
        kinds = [(4, self.dtype)] + [(OUTPUTS[name][0], "f4") for name in plan.outputs]
        textures = [ctx.texture(size, many, samples=samples, dtype=kind) for many, kind in kinds]
        depth = ctx.depth_renderbuffer(size, samples=samples)
        self.target = ctx.framebuffer(textures, depth)
        # Each has a background of its own; the depth is cleared with the colours.
        self.clears = [(ctx.framebuffer([textures[0]], depth), field.CLEAR)]
        for name, texture in zip(plan.outputs, textures[1:], strict=True):
            self.clears.append((ctx.framebuffer([texture]), (OUTPUTS[name][3],) * 4))
        self.resolved = ctx.simple_framebuffer(size, 4, dtype=self.dtype) if samples else None

    def prepare(self, index: int) -> None:
        self.positions = self.plan.positions(index)

    def draw(self, index: int) -> dict[str, np.ndarray]:
        """(probes, 6, N, N, ...) arrays: "faces" and the outputs."""
        plan, n, count = self.plan, self.plan.size, len(self.positions)
        found = plan.results(count)
        seen = plan.seen(self.positions)
        for number, place in enumerate(self.positions):
            row = number % self.at_once
            if row == 0:
                for target, background in self.clears:
                    target.clear(*background)
                self.target.use()
            self.eye.value = tuple(place.tolist())
            away = np.eye(4)
            away[:3, 3] = -place
            for face, turned in enumerate(self.turned):
                self.target.viewport = (0, (6 * row + face) * n, n, n)
                self.view_projection.write(matrix_bytes(turned @ away))
                if self.forward is not None:
                    self.forward.value = scene.FACE_FORWARD[face]
                for node in seen[number][face]:
                    self.model.write(self.models[node])
                    self.color.value = self.colors[node]
                    self.mesh.render()
                if face != 2 and plan.nodes:
                    self.model.write(self.unmoved)
                    self.color.value = field.GROUND_COLOR
                    self.ground.render()
            if row + 1 == self.at_once or number + 1 == count:
                self._read(found, number - row, number + 1)
        return found

    def _read(self, found: dict[str, np.ndarray], first: int, end: int) -> None:
        target = self.target
        if self.resolved is not None:
            self.ctx.copy_framebuffer(self.resolved, target)
            target = self.resolved
        height = 6 * self.plan.size * (end - first)
        for attachment, (name, array) in enumerate(found.items()):
            target.read_into(
                array[first:end].data,
                viewport=(0, 0, self.plan.size, height),
                components=4 if name == "faces" else OUTPUTS[name][1],
                attachment=attachment,
                dtype=self.dtype if name == "faces" else "f4",
                alignment=1,
            )

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """As `draw`."""
        self.prepare(index)
        return self.draw(index)


def model_matrix(place: np.ndarray, turn: float) -> np.ndarray:
    """(4, 4): a turn about the Y axis, then a move."""
    matrix = np.eye(4)
    cos, sin = np.cos(turn), np.sin(turn)
    matrix[:3, :3] = [[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]]
    matrix[:3, 3] = place
    return matrix
