"""A scene built twice: once for the product, once for the oracle."""

from dataclasses import dataclass, field

import numpy as np

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.reference import raycast
from tests.reference import transforms as ref
from tests.reference.cube_faces import FORWARD
from tests.reference.pattern import face_pattern
from tests.reference.raycast import Box, Quad, Sphere, Triangles, interior

OUTPUTS = ("distance", "z", "normal", "position", "id", "label")


@dataclass
class World:
    """`scene` is the product's; `shapes` and `colors` (by node id) are the oracle's."""

    scene: cc.Scene = field(default_factory=cc.Scene)
    shapes: list = field(default_factory=list)
    colors: dict = field(default_factory=dict)

    def add(self, mesh, shape, color=(1, 1, 1), material=None, parent=None, **place):
        """Place a mesh and its oracle counterpart; `place`: position, axis and degrees, scale."""
        matrix = matrix_of(**place)
        double_sided = material.double_sided if material is not None else False
        node = self.scene.add(
            mesh, material or cc.BasicMaterial(color=color), matrix=matrix, parent=parent
        )
        node.label = label_of(node.id)
        shape.id, shape.matrix, shape.double_sided = node.id, matrix, double_sided
        if parent is not None:
            shape.matrix = np.asarray(parent.world_matrix) @ matrix
        self.shapes.append(shape)
        self.colors[node.id] = np.array([*color, 1.0])[:4]
        return node

    def box(self, size, color=(1, 1, 1), **more):
        return self.add(cc.Mesh.box(size), Box(0, size=size), color, **more)

    def plane(self, width, depth, color=(1, 1, 1), **more):
        return self.add(
            cc.Mesh.plane(width, depth), Quad(0, width=width, depth=depth), color, **more
        )

    def sphere(self, radius, color=(1, 1, 1), subdivisions=2, **more):
        """An icosphere: the oracle meets its triangles, with the interpolated normals."""
        return self.mesh(cc.Mesh.icosphere(radius, subdivisions=subdivisions), color, **more)

    def mesh(self, mesh, color=(1, 1, 1), **more):
        return self.add(mesh, triangles_of(mesh), color, **more)

    def without(self, *nodes):
        """The oracle's shapes without those of some nodes."""
        ids = {node.id for node in nodes}
        return [shape for shape in self.shapes if shape.id not in ids]

    def paint(self, hits, background=(0, 0, 0, 0)):
        """Return the unlit colours of the shapes that were hit."""
        color = np.broadcast_to(np.asarray(background, float), (*hits.id.shape, 4)).copy()
        for id_, value in self.colors.items():
            color[hits.id == id_] = value
        return color


def label_of(id_):
    """A label for each id: negative and great ones, some of them shared; 0 for the background."""
    return np.where(id_ == 0, 0, np.where(id_ % 3 == 0, 2**31 - 1, -5 * id_)).astype(np.int32)[()]


def matrix_of(position=(0, 0, 0), axis=(0, 1, 0), degrees=0.0, scale=1.0):
    return ref.trs(position, ref.axis_angle(axis, degrees), scale)


def triangles_of(mesh):
    return Triangles(
        0,
        positions=mesh.positions,
        indices=mesh.indices,
        normals=mesh.normals,
        uvs=mesh.uvs,
        colors=mesh.colors,
    )


def inner(hits):
    """The pixels that are at least a pixel away from silhouettes and creases."""
    return interior(hits.id, hits.part)


def inner_smooth(hits):
    """The pixels at least a pixel away from silhouettes: for smooth shapes, whose facets are no creases."""
    return interior(hits.id) & (~hits.hit | (np.abs(hits.facing) > 0.1))


def room():
    """Asymmetric boxes, a plane and a sphere, some in every direction from near the origin, all unlit."""
    world = World()
    world.plane(9, 7, (0.3, 0.5, 0.2), position=(0.4, -1.6, 0.3))
    world.plane(6, 8, (0.2, 0.3, 0.6), position=(-0.3, 2.2, 0.2), axis=(0, 0, 1), degrees=170)
    world.box((0.7, 1.1, 0.9), (1, 0.2, 0.1), position=(2, 0.3, 0.5), axis=(1, 2, 3), degrees=35)
    world.box(
        (1, 0.5, 0.8), (0.1, 0.9, 0.3), position=(-1.9, -0.4, 0.7), axis=(0, 1, 1), degrees=60
    )
    world.box((0.6, 0.6, 1.4), (0.2, 0.4, 1), position=(0.5, 0.9, -2.1), axis=(1, 0, 1), degrees=20)
    world.sphere(0.6, (0.9, 0.8, 0.1), position=(-0.6, 0.2, 2.2))
    world.box(0.4, (0.9, 0.1, 0.9), position=(0.7, 1.5, 0.6), axis=(2, 1, 0), degrees=50)
    world.box(
        (0.5, 0.3, 0.5), (0.1, 0.9, 0.9), position=(-0.5, -1.3, -0.6), axis=(0, 1, 0), degrees=25
    )
    return world


def capture_hits(world, position=(0, 0, 0), size=32, near=0.05, far=1000.0, shapes=None):
    return raycast.cast_cube(world.shapes if shapes is None else shapes, position, size, near, far)


@dataclass
class View:
    """A camera of the product and its rays."""

    camera: object
    view: np.ndarray
    projection: np.ndarray
    size: tuple
    near: float
    far: float
    eye: np.ndarray | None

    def hits(self, shapes):
        return raycast.cast_frame(
            shapes, self.view, self.projection, self.size, self.near, self.far
        )

    def directions(self):
        """Unit view directions of the pixels."""
        return normalised(ref.pixel_rays(self.view, self.projection, self.size)[1])


def perspective(position, target, fov=60.0, size=(48, 36), near=0.1, far=100.0, up=(0, 1, 0)):
    camera = cc.PerspectiveCamera(
        fov=fov, position=position, target=target, up=up, near=near, far=far
    )
    projection = ref.perspective(fov, size[0] / size[1], near, far)
    return View(
        camera,
        ref.look_at(position, target, up),
        projection,
        size,
        near,
        far,
        np.asarray(position, float),
    )


def orthographic(position, target, height=4.0, size=(48, 36), near=0.1, far=100.0, up=(0, 1, 0)):
    camera = cc.OrthographicCamera(
        height=height, position=position, target=target, up=up, near=near, far=far
    )
    half, wide = height / 2, height / 2 * size[0] / size[1]
    projection = ref.orthographic(-wide, wide, -half, half, near, far)
    return View(
        camera,
        ref.look_at(position, target, up),
        projection,
        size,
        near,
        far,
        np.asarray(position, float),
    )


def smooth_environment(size=64):
    """A cubemap without sharp edges: wide waves of the direction, different in each channel."""
    from tests.reference.cube_faces import unit_texel_directions

    d = unit_texel_directions(size)
    waves = np.stack(
        [
            0.5 + 0.3 * np.sin(2 * d[..., 0] + d[..., 1]),
            0.5 + 0.3 * np.cos(2 * d[..., 1] - d[..., 2]),
            0.6 + 0.3 * np.sin(1.5 * d[..., 2] + 2 * d[..., 0]),
        ],
        axis=-1,
    )
    return waves.astype(np.float32)


def phong_lights():
    """One light of each kind, for the product and for the oracle."""
    ours = [
        cc.PointLight(position=(3, 4, 2), color=(1, 0.9, 0.8)),
        cc.PointLight(position=(-2, 1, 3), color=(0.2, 0.3, 0.4), intensity=2, decay=1),
        cc.DirectionalLight(direction=(-1, -2, -0.5), color=(0.3, 0.2, 0.1)),
        cc.AmbientLight(color=(0.2, 0.1, 0.3)),
    ]
    theirs = [
        shading.Point((3, 4, 2), (1, 0.9, 0.8)),
        shading.Point((-2, 1, 3), (0.2, 0.3, 0.4), 2, 1),
        shading.Directional((-1, -2, -0.5), (0.3, 0.2, 0.1)),
        shading.Ambient((0.2, 0.1, 0.3)),
    ]
    return ours, theirs


def everything():
    """A scene with every kind of material, light, blending and texture at once."""
    world = room()
    scene = world.scene
    scene.environment = cc.CubeMap(smooth_environment(16), mipmaps=True)
    for light in phong_lights()[0]:
        scene.add(light)
    picture = np.random.default_rng(0).integers(0, 256, (8, 8, 4), dtype=np.uint8)
    materials = [
        cc.PhongMaterial(color=(1, 0.5, 0.2)),
        cc.MirrorMaterial(env_weight=0.8, f0=0.1),
        cc.GlassMaterial(),
        cc.BasicMaterial(color=(0.2, 1, 0.5, 0.4)),
        cc.PhongMaterial(map=picture, double_sided=True),
        cc.BasicMaterial(cubemap=cc.CubeMap(face_pattern(8))),
    ]
    for index, material in enumerate(materials):
        angle = index * np.pi / 3
        place = (1.3 * np.cos(angle), 0.3 * np.sin(2 * angle), 1.3 * np.sin(angle))
        scene.add(cc.Mesh.sphere(0.3, segments=16, rings=8), material, position=place)
    mirror = scene.add(cc.Mesh.icosphere(0.25), cc.MirrorMaterial(), position=(0, 0.8, 0))
    mirror.environment = cc.Probe(position=(0, 0.8, 0), size=16, mipmaps=True)
    return scene


__all__ = [
    "FORWARD",
    "OUTPUTS",
    "Box",
    "Quad",
    "Sphere",
    "Triangles",
    "View",
    "World",
    "capture_hits",
    "everything",
    "inner",
    "inner_smooth",
    "matrix_of",
    "orthographic",
    "perspective",
    "phong_lights",
    "room",
    "smooth_environment",
    "triangles_of",
]
