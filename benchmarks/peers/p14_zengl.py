"""Program P14 written for ZenGL: one pipeline for each object and view, made once."""

from __future__ import annotations

import ctypes
from typing import Any, TypeAlias

import glcontext
import numpy as np
import zengl

from .. import scene, shaders
from .egl import LIBRARIES

Buffers: TypeAlias = tuple[zengl.Buffer, zengl.Buffer, int]  # vertices, indices and their number

HEADER = "#version 330 core\n" + shaders.BLOCKS.format(binding0="", binding1="")
LAYOUT = [{"name": "View", "binding": 0}, {"name": "Object", "binding": 1}]


class Program:
    """The scene of P14 in one ZenGL context."""

    def __init__(self, actor: scene.MeshArrays, cull: bool = False) -> None:
        backend = glcontext.get_backend_by_name("egl")(
            mode="standalone", glversion=330, **LIBRARIES
        )
        self._finish = ctypes.CFUNCTYPE(None)(backend.load_opengl_function("glFinish"))
        zengl.init(backend)
        self.ctx = ctx = zengl.context()
        self.cull = cull
        size = (scene.FACE_SIZE, scene.FACE_SIZE)
        self.cube = ctx.image(size, "rgba8unorm", cubemap=True)
        self.cube.clear_value = scene.CLEAR
        self.depth = ctx.image(size, "depth24plus")
        self.depth.clear_value = 1.0
        self.color = ctx.image(scene.FRAME_SIZE, "rgba8unorm")
        self.color.clear_value = scene.CLEAR
        self.main_depth = ctx.image(scene.FRAME_SIZE, "depth24plus")
        self.main_depth.clear_value = 1.0

        meshes = [
            self._buffers(m)
            for m in (scene.ground_mesh(), actor, scene.sphere_mesh(scene.BALL_RADIUS))
        ]
        ground, body, ball = meshes
        self.blocks = [
            self._block(shaders.object_block((0, 0, 0), c))
            for c in (scene.GROUND_COLOR, *scene.ACTOR_COLORS)
        ]
        self.blocks[0].write(shaders.object_block(scene.GROUND_POSITION, scene.GROUND_COLOR))
        objects = list(zip((ground, body, body), self.blocks, strict=True))
        self.actor_radius = float(np.linalg.norm(actor.positions, axis=1).max())

        self.face_images = [self.cube.face(i) for i in range(6)]
        views = [
            self._block(shaders.view_block(v, (0, 0, 0))) for v in scene.face_view_projections()
        ]
        self.face_pipelines = [
            [
                self._pipeline(mesh, shaders.PHONG, (image, self.depth), view, block)
                for mesh, block in objects
            ]
            for image, view in zip(self.face_images, views, strict=True)
        ]
        view = self._block(shaders.view_block(scene.main_view_projection(), scene.EYE))
        target = (self.color, self.main_depth)
        self.main_pipelines = [
            self._pipeline(mesh, shaders.PHONG, target, view, block) for mesh, block in objects
        ]
        block = self._block(shaders.object_block((0, 0, 0), scene.BALL_COLOR))
        self.main_pipelines.append(
            self._pipeline(ball, shaders.MIRROR, target, view, block, self.cube)
        )

    def _buffers(self, mesh: scene.MeshArrays) -> Buffers:
        vertices = self.ctx.buffer(mesh.interleaved)
        return vertices, self.ctx.buffer(mesh.indices, index=True), mesh.indices.size

    def _block(self, data: bytes) -> zengl.Buffer:
        return self.ctx.buffer(data, uniform=True)

    def _pipeline(
        self,
        mesh: Buffers,
        fragment: str,
        target: tuple[Any, Any],
        view: zengl.Buffer,
        block: zengl.Buffer,
        environment: zengl.Image | None = None,
    ) -> zengl.Pipeline:
        vertices, indices, count = mesh
        layout = list(LAYOUT)
        resources = [
            {"type": "uniform_buffer", "binding": 0, "buffer": view},
            {"type": "uniform_buffer", "binding": 1, "buffer": block},
        ]
        if environment is not None:
            layout.append({"name": "u_environment", "binding": 0})
            resources.append({"type": "sampler", "binding": 0, "image": environment})
        return self.ctx.pipeline(
            vertex_shader=HEADER + shaders.VERTEX,
            fragment_shader=HEADER + fragment,
            layout=layout,
            resources=resources,
            framebuffer=list(target),
            vertex_buffers=zengl.bind(vertices, "3f 3f", 0, 1),
            index_buffer=indices,
            vertex_count=count,
            topology="triangles",
            cull_face="back",
        )

    def _seen(self, face: int, index: int) -> bool:
        """Whether an object's sphere touches the pyramid of a face."""
        if not self.cull:
            return True
        if index == 0:
            return face != 2
        axis, sign = face // 2, 1 - 2 * (face % 2)
        position = self.positions[index - 1]
        ahead = sign * position[axis]
        reach = self.actor_radius * np.sqrt(2)
        return all(abs(position[other]) - ahead <= reach for other in range(3) if other != axis)

    def move(self, frame: int) -> None:
        self.positions = scene.actor_positions(frame)
        for block, position, color in zip(
            self.blocks[1:], self.positions, scene.ACTOR_COLORS, strict=True
        ):
            block.write(shaders.object_block(position, color))

    def draw_faces(self) -> None:
        for face, (image, pipelines) in enumerate(
            zip(self.face_images, self.face_pipelines, strict=True)
        ):
            image.clear()
            self.depth.clear()
            for index, pipeline in enumerate(pipelines):
                if self._seen(face, index):
                    pipeline.render()

    def draw_main(self) -> None:
        self.color.clear()
        self.main_depth.clear()
        for pipeline in self.main_pipelines:
            pipeline.render()

    def read(self) -> np.ndarray:
        """(512, 512, 4) uint8, row 0 on top."""
        pixels = np.empty((scene.FRAME_SIZE[1], scene.FRAME_SIZE[0], 4), np.uint8)
        self.color.read(into=pixels)
        return pixels[::-1]

    def frame(self, index: int) -> np.ndarray:
        self.ctx.new_frame()
        self.move(index)
        self.draw_faces()
        self.draw_main()
        pixels = self.read()
        self.ctx.end_frame()
        return pixels

    def finish(self) -> None:
        self._finish()

    def versions(self) -> dict[str, str]:
        return {"zengl": zengl._zengl.__version__, "gl": self.ctx.info["version"]}
