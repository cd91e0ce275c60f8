"""Cubemaps of a field in ZenGL, culled by hand as in moderngl: a pipeline for each object, made once."""

from __future__ import annotations

from typing import Any

import glcontext
import numpy as np
import zengl

from .. import field, scene
from .batches_moderngl import FRAGMENT, OUTPUTS, declared, model_matrix
from .egl import LIBRARIES
from .moderngl_frame import ONE_NODE, matrix_bytes

VIEW = """
layout (std140) uniform View { mat4 view_projection; vec4 eye_place; vec4 face_way; };
#define eye eye_place.xyz
#define forward face_way.xyz
"""


class Culled:
    """The field in one ZenGL context."""

    def __init__(self, **options: Any) -> None:
        self.plan = plan = field.Field.of(options)
        field.keep_freed_memory()
        backend = glcontext.get_backend_by_name("egl")(
            mode="standalone", glversion=330, **LIBRARIES
        )
        zengl.init(backend)
        self.ctx = ctx = zengl.context()
        n, samples = plan.size, plan.samples
        size = (n, 6 * n)
        self.colors = "rgba8unorm" if plan.format == "rgba8" else "rgba32float"
        self.images = [ctx.image(size, self.colors, samples=samples)]
        self.images[0].clear_value = field.CLEAR
        for name in plan.outputs:
            channels, _, _, background = OUTPUTS[name]
            kind = "r32float" if channels == 1 else "rgba32float"
            image = ctx.image(size, kind, samples=samples)
            image.clear_value = background if channels == 1 else (background,) * 4
            self.images.append(image)
        self.depth = ctx.image(size, "depth24plus", samples=samples)
        self.depth.clear_value = 1.0
        self.resolved = ctx.image(size, self.colors) if samples > 1 else None
        self.view = ctx.buffer(size=96, uniform=True)
        self.lights = ctx.buffer(plan.light_places.astype(np.float32), uniform=True)
        projection = scene.perspective(90, 1, field.NEAR, field.FAR)
        self.turned = [
            projection @ scene.look_at((0, 0, 0), forward, up)
            for forward, up in zip(scene.FACE_FORWARD, scene.FACE_UP, strict=True)
        ]
        mesh, ground = self._buffers(plan.mesh), self._buffers(plan.ground)
        self.nodes = [
            self._pipeline(mesh, model_matrix(place, turn), plan.palette[i % plan.colors])
            for i, (place, turn) in enumerate(zip(plan.places, plan.turns, strict=True))
        ]
        self.ground = self._pipeline(ground, np.eye(4), field.GROUND_COLOR)

    def _buffers(self, mesh: scene.MeshArrays) -> tuple[zengl.Buffer, zengl.Buffer, int]:
        vertices = self.ctx.buffer(mesh.interleaved)
        return vertices, self.ctx.buffer(mesh.indices, index=True), mesh.indices.size

    def _pipeline(self, buffers: Any, model: np.ndarray, color: Any) -> zengl.Pipeline:
        vertices, indices, count = buffers
        plan = self.plan
        vertex = ONE_NODE.replace("uniform mat4 view_projection;\n", VIEW).lstrip()
        weights = ", ".join(map(str, (field.KA, field.KD, field.KS, field.SHININESS)))
        fragment = declared(FRAGMENT, plan).replace("uniform vec3 eye;\n", VIEW)
        fragment = fragment.replace("uniform vec3 forward;\n", "")
        fragment = fragment.replace(
            "uniform vec4 weights;", f"const vec4 weights = vec4({weights});"
        )
        many = f"uniform vec4 lights[{plan.lights}];"
        block = f"layout (std140) uniform Lights {{ vec4 lights[{plan.lights}]; }};"
        fragment = fragment.replace(many, block)
        return self.ctx.pipeline(
            vertex_shader=vertex,
            fragment_shader=fragment.lstrip(),
            layout=[{"name": "View", "binding": 0}, {"name": "Lights", "binding": 1}],
            resources=[
                {"type": "uniform_buffer", "binding": 0, "buffer": self.view},
                {"type": "uniform_buffer", "binding": 1, "buffer": self.lights},
            ],
            uniforms={
                "model": model.T.ravel().tolist(),  # columns first, as in GL
                "color": np.asarray(color, float).tolist(),
            },
            framebuffer=[*self.images, self.depth],
            vertex_buffers=zengl.bind(vertices, "3f 3f", 0, 1),
            index_buffer=indices,
            vertex_count=count,
            topology="triangles",
            cull_face="back",
            viewport=(0, 0, plan.size, plan.size),
        )

    def prepare(self, index: int) -> None:
        self.positions = self.plan.positions(index)

    def draw(self, index: int) -> dict[str, np.ndarray]:
        """(probes, 6, N, N, ...) arrays: "faces" and the outputs."""
        plan, n, count = self.plan, self.plan.size, len(self.positions)
        found = plan.results(count)
        seen = plan.seen(self.positions)
        self.ctx.new_frame()
        for number, place in enumerate(self.positions):
            for image in self.images:
                image.clear()
            self.depth.clear()
            away = np.eye(4)
            away[:3, 3] = -place
            for face, turned in enumerate(self.turned):
                tail = np.array([*place, 0, *scene.FACE_FORWARD[face], 0], np.float32)
                self.view.write(matrix_bytes(turned @ away) + tail.tobytes())
                viewport = (0, face * n, n, n)
                for node in seen[number][face]:
                    self.nodes[node].viewport = viewport
                    self.nodes[node].render()
                if face != 2 and plan.nodes:
                    self.ground.viewport = viewport
                    self.ground.render()
            self._read(found, number)
        self.ctx.end_frame()
        return found

    def _read(self, found: dict[str, np.ndarray], number: int) -> None:
        n = self.plan.size
        for image, (name, array) in zip(self.images, found.items(), strict=True):
            if self.resolved is not None:
                image.blit(self.resolved)
                image = self.resolved
            if name == "faces" or array.ndim == 4:
                image.read(into=array[number])
            else:  # ZenGL reads all four channels of a texture
                four = np.empty((6, n, n, 4), np.float32)
                image.read(into=four)
                array[number] = four[..., : array.shape[-1]]

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """As `draw`."""
        self.prepare(index)
        return self.draw(index)
