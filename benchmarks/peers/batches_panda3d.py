"""Cubemaps of a field in Panda3D: a node for each object, a display region for each face; it culls by itself."""

from __future__ import annotations

from typing import Any

import numpy as np
from panda3d import core

from .. import field, scene
from .batches_moderngl import FRAGMENT, declared, model_matrix

core.load_prc_file_data(
    "", "load-display p3headlessgl\naudio-library-name null\nnotify-level error\nsync-video 0"
)

VERTEX = """
#version 330 core
uniform mat4 p3d_ModelViewProjectionMatrix;
uniform mat4 p3d_ModelMatrix;
in vec3 p3d_Vertex;
in vec3 p3d_Normal;
out vec3 v_position;
out vec3 v_normal;
void main() {
    v_position = (p3d_ModelMatrix * vec4(p3d_Vertex, 1.0)).xyz;
    v_normal = mat3(p3d_ModelMatrix) * p3d_Normal;
    gl_Position = p3d_ModelViewProjectionMatrix * vec4(p3d_Vertex, 1.0);
}
"""


class Nodes:
    """The field in one buffer off the screen; it has colours of one sample alone."""

    def __init__(self, **options: Any) -> None:
        self.plan = plan = field.Field.of(options)
        if plan.outputs or plan.format != "rgba8" or plan.samples > 1:
            raise ValueError(
                "this program reads rgba8 colours of one sample alone,"
                f" got {plan.format}, {plan.outputs}, {plan.samples} samples"
            )
        field.keep_freed_memory()
        n = plan.size
        self.engine = core.GraphicsEngine.get_global_ptr()
        pipe = core.GraphicsPipeSelection.get_global_ptr().make_default_pipe()
        wanted = core.FrameBufferProperties()
        wanted.set_rgba_bits(8, 8, 8, 8)
        wanted.set_depth_bits(24)
        flags = core.GraphicsPipe.BF_refuse_window
        # The context is that of a small buffer of EGL; the faces are a framebuffer object.
        small = core.WindowProperties.size(1, 1)
        host = self.engine.make_output(pipe, "host", 0, core.FrameBufferProperties(), small, flags)
        if host is None:
            raise RuntimeError("Panda3D opened no context")
        self.engine.open_windows()
        faces = core.WindowProperties.size(n, 6 * n)
        self.buffer = self.engine.make_output(
            pipe, "faces", 1, wanted, faces, flags, host.get_gsg(), host
        )
        if self.buffer is None:
            raise RuntimeError("Panda3D opened no buffer off the screen")
        self.texture = core.Texture("faces")
        self.buffer.add_render_texture(self.texture, core.GraphicsOutput.RTM_copy_ram)
        self.buffer.set_clear_color(core.LVecBase4f(*field.CLEAR))
        self.root = core.NodePath("field")
        self._fill()
        self.cameras = [self._camera(face) for face in range(6)]

    def _fill(self) -> None:
        plan = self.plan
        fragment = declared(FRAGMENT, plan).replace(
            "uniform vec3 eye;", "uniform mat4 p3d_ViewMatrixInverse;"
        )
        fragment = fragment.replace("- eye;", "- p3d_ViewMatrixInverse[3].xyz;")
        shader = core.Shader.make(core.Shader.SL_GLSL, VERTEX.lstrip(), fragment.lstrip())
        self.root.set_shader(shader)
        self.root.set_shader_input(
            "weights", core.LVecBase4f(field.KA, field.KD, field.KS, field.SHININESS)
        )
        lights = core.PTA_LVecBase4f(
            [core.LVecBase4f(*light) for light in plan.light_places.tolist()]
        )
        self.root.set_shader_input("lights", lights)
        mesh, ground = _geom(plan.mesh), _geom(plan.ground)
        for number, (place, turn) in enumerate(zip(plan.places, plan.turns, strict=True)):
            node = self._add(mesh, plan.palette[number % plan.colors])
            node.set_mat(core.LMatrix4f(*model_matrix(place, turn).T.ravel().tolist()))
        if plan.nodes:
            self._add(ground, field.GROUND_COLOR)

    def _add(self, geom: core.Geom, color: Any) -> core.NodePath:
        part = core.GeomNode("object")
        part.add_geom(geom)
        node = self.root.attach_new_node(part)
        node.set_shader_input("color", core.LVecBase3f(*map(float, color)))
        return node

    def _camera(self, face: int) -> core.NodePath:
        lens = core.PerspectiveLens()
        lens.set_fov(90, 90)
        lens.set_near_far(field.NEAR, field.FAR)
        camera = self.root.attach_new_node(core.Camera("face", lens))
        region = self.buffer.make_display_region(0, 1, face / 6, (face + 1) / 6)
        region.set_camera(camera)
        return camera

    def prepare(self, index: int) -> None:
        self.positions = self.plan.positions(index)

    def draw(self, index: int) -> dict[str, np.ndarray]:
        """(probes, 6, N, N, 4) uint8: "faces"."""
        n = self.plan.size
        found = self.plan.results(len(self.positions))
        for number, place in enumerate(self.positions):
            for camera, forward, up in zip(
                self.cameras, scene.FACE_FORWARD, scene.FACE_UP, strict=True
            ):
                # A camera looks along its Y axis, with Z upwards; vectors are rows.
                rows = np.eye(4)
                rows[:3, :3] = np.cross(forward, up), forward, up
                rows[3, :3] = place
                camera.set_mat(core.LMatrix4f(*rows.ravel().tolist()))
            self.engine.render_frame()
            pixels = np.frombuffer(self.texture.get_ram_image_as("RGBA"), np.uint8)
            found["faces"][number] = pixels.reshape(6, n, n, 4)
        return found

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """As `draw`."""
        self.prepare(index)
        return self.draw(index)


def _geom(mesh: scene.MeshArrays) -> core.Geom:
    data = core.GeomVertexData("mesh", core.GeomVertexFormat.get_v3n3(), core.Geom.UH_static)
    data.unclean_set_num_rows(len(mesh.positions))
    data.modify_array_handle(0).copy_data_from(mesh.interleaved.tobytes())
    triangles = core.GeomTriangles(core.Geom.UH_static)
    triangles.set_index_type(core.Geom.NT_uint32)
    indices = triangles.modify_vertices()
    indices.unclean_set_num_rows(3 * len(mesh.indices))
    indices.modify_handle().copy_data_from(np.ascontiguousarray(mesh.indices, np.uint32).tobytes())
    geom = core.Geom(data)
    geom.add_primitive(triangles)
    return geom
