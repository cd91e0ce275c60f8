"""Program P14 written for moderngl.

moderngl attaches no cube face to a framebuffer. Its users make the framebuffer with a 2D texture and put
the cube's face in its place by one raw GL call, once (moderngl issue #570), outside of the measured frames.
With `layered=True` the whole cube is attached and one instanced draw writes the six faces (gl_Layer from
the vertex shader). It is the fastest way for a user who adds four raw GL calls to moderngl.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any, TypeAlias

import glcontext
import moderngl
import numpy as np

from .. import scene, shaders
from .egl import LIBRARIES

Buffers: TypeAlias = tuple[moderngl.Buffer, moderngl.Buffer]  # vertices and indices

GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT = 0x8D40, 0x8CE0, 0x8D00
GL_TEXTURE_CUBE_MAP_POSITIVE_X, GL_TEXTURE_CUBE_MAP = 0x8515, 0x8513
GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT = 0x81A6, 0x1902, 0x1405

HEADER = "#version 420 core\n" + shaders.BLOCKS.format(
    binding0=", binding = 0", binding1=", binding = 1"
)
LAYERED_BLOCKS = HEADER.replace("mat4 u_view_projection;", "mat4 u_view_projections[6];")
LAYERED_VERTEX = LAYERED_BLOCKS.replace(
    "core\n", "core\n#extension GL_ARB_shader_viewport_layer_array : require\n"
) + shaders.VERTEX.replace("u_view_projection *", "u_view_projections[gl_InstanceID] *").replace(
    "void main() {", "void main() {\n    gl_Layer = gl_InstanceID;"
)


class Program:
    """The scene of P14 in one moderngl context."""

    def __init__(self, actor: scene.MeshArrays, layered: bool = False, cull: bool = False) -> None:
        backend = glcontext.get_backend_by_name("egl")(
            mode="standalone", glversion=420, **LIBRARIES
        )
        self._address = backend.load_opengl_function
        self.ctx = ctx = moderngl.create_context(context=backend)
        ctx.enable(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self.layered, self.cull = layered, cull

        phong = ctx.program(
            vertex_shader=HEADER + shaders.VERTEX, fragment_shader=HEADER + shaders.PHONG
        )
        mirror = ctx.program(
            vertex_shader=HEADER + shaders.VERTEX, fragment_shader=HEADER + shaders.MIRROR
        )
        meshes = [
            self._buffers(m)
            for m in (scene.ground_mesh(), actor, scene.sphere_mesh(scene.BALL_RADIUS))
        ]
        ground, body, ball = (
            self._vertex_array(phong if i < 2 else mirror, m) for i, m in enumerate(meshes)
        )
        colors = (scene.GROUND_COLOR, *scene.ACTOR_COLORS)
        self.blocks = [ctx.buffer(shaders.object_block((0, 0, 0), c)) for c in colors]
        self.blocks[0].write(shaders.object_block(scene.GROUND_POSITION, scene.GROUND_COLOR))
        self.objects = list(zip((ground, body, body), self.blocks, strict=True))
        self.ball = ball
        self.ball_block = ctx.buffer(shaders.object_block((0, 0, 0), scene.BALL_COLOR))
        self.actor_radius = float(np.linalg.norm(actor.positions, axis=1).max())

        size = (scene.FACE_SIZE, scene.FACE_SIZE)
        self.cube = ctx.texture_cube(size, 4)
        self.cube.filter = (moderngl.LINEAR, moderngl.LINEAR)
        views = scene.face_view_projections()
        if layered:
            fragment = LAYERED_BLOCKS + shaders.PHONG
            program = ctx.program(vertex_shader=LAYERED_VERTEX, fragment_shader=fragment)
            arrays = [self._vertex_array(program, m) for m in meshes[:2]]
            self.layered_objects = list(
                zip((arrays[0], arrays[1], arrays[1]), self.blocks, strict=True)
            )
            matrices = np.stack([v.T for v in views]).astype(np.float32).tobytes()
            self.views_block = ctx.buffer(matrices + np.array([0, 0, 0, 1], np.float32).tobytes())
            self.faces_target = self._layered_framebuffer(size)
        else:
            depth = ctx.depth_renderbuffer(size)
            self.faces = [
                (
                    self._face_framebuffer(i, size, depth),
                    ctx.buffer(shaders.view_block(v, (0, 0, 0))),
                )
                for i, v in enumerate(views)
            ]
        self.main_block = ctx.buffer(shaders.view_block(scene.main_view_projection(), scene.EYE))
        color = ctx.texture(scene.FRAME_SIZE, 4)
        self.main_target = ctx.framebuffer([color], ctx.depth_renderbuffer(scene.FRAME_SIZE))

    def _buffers(self, mesh: scene.MeshArrays) -> Buffers:
        return self.ctx.buffer(mesh.interleaved.tobytes()), self.ctx.buffer(mesh.indices.tobytes())

    def _vertex_array(self, program: moderngl.Program, buffers: Buffers) -> moderngl.VertexArray:
        vertices, indices = buffers
        return self.ctx.vertex_array(
            program, [(vertices, "3f 3f", "in_position", "in_normal")], indices
        )

    def _raw(self, name: str, *types: Any) -> Callable[..., None]:
        return ctypes.CFUNCTYPE(None, *types)(self._address(name))

    def _face_framebuffer(
        self, face: int, size: tuple[int, int], depth: moderngl.Renderbuffer
    ) -> moderngl.Framebuffer:
        framebuffer = self.ctx.framebuffer([self.ctx.texture(size, 4)], depth)
        framebuffer.use()
        attach = self._raw("glFramebufferTexture2D", *[ctypes.c_uint] * 4, ctypes.c_int)
        target = GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
        attach(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, target, self.cube.glo, 0)
        return framebuffer

    def _layered_framebuffer(self, size: tuple[int, int]) -> moderngl.Framebuffer:
        framebuffer = self.ctx.framebuffer([self.ctx.texture(size, 4)])
        depth = self.ctx.depth_texture_cube(size)
        depth.use(0)
        image = self._raw("glTexImage2D", *[ctypes.c_int] * 8, ctypes.c_void_p)
        for face in range(6):
            target = GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
            image(
                target, 0, GL_DEPTH_COMPONENT24, *size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, None
            )
        framebuffer.use()
        attach = self._raw("glFramebufferTexture", *[ctypes.c_uint] * 3, ctypes.c_int)
        attach(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, self.cube.glo, 0)
        attach(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth.glo, 0)
        # moderngl masks depth writes of a framebuffer that it made without a depth attachment.
        framebuffer.depth_mask = True
        self._depth = depth
        return framebuffer

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
        if self.layered:
            self.faces_target.use()
            self.faces_target.clear(*scene.CLEAR)
            self.views_block.bind_to_uniform_block(0)
            for array, block in self.layered_objects:
                block.bind_to_uniform_block(1)
                array.render(instances=6)
            return
        for face, (target, view) in enumerate(self.faces):
            target.use()
            target.clear(*scene.CLEAR)
            view.bind_to_uniform_block(0)
            for index, (array, block) in enumerate(self.objects):
                if self._seen(face, index):
                    block.bind_to_uniform_block(1)
                    array.render()

    def draw_main(self) -> None:
        self.main_target.use()
        self.main_target.clear(*scene.CLEAR)
        self.main_block.bind_to_uniform_block(0)
        for array, block in self.objects:
            block.bind_to_uniform_block(1)
            array.render()
        self.cube.use(0)
        self.ball_block.bind_to_uniform_block(1)
        self.ball.render()

    def read(self) -> np.ndarray:
        """(512, 512, 4) uint8, row 0 on top."""
        pixels = np.empty((scene.FRAME_SIZE[1], scene.FRAME_SIZE[0], 4), np.uint8)
        self.main_target.read_into(pixels, components=4)
        return pixels[::-1]

    def frame(self, index: int) -> np.ndarray:
        self.move(index)
        self.draw_faces()
        self.draw_main()
        return self.read()

    def finish(self) -> None:
        self.ctx.finish()

    def versions(self) -> dict[str, str]:
        return {"moderngl": moderngl.__version__, "gl": self.ctx.info["GL_VERSION"]}
