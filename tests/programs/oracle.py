"""Helpers of the programs' tests: the documents' matrices, the hits of a view, the Phong model of document 000."""

import numpy as np

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.gl.world import inner_smooth, triangles_of
from tests.reference import raycast
from tests.reference import transforms as ref
from tests.reference.raycast import Box, Quad
from tests.reference.sampling import sample_faces

GREY = (0.4, 0.4, 0.4)
#: The colour of the mirror in P14 and P17.
GOLD = np.array([0.95, 0.85, 0.4])
LAMP = shading.Point((5, 5, 5))


def rx(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1.0]])


def ry(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1.0]])


def scaled(*factors):
    return np.diag([*np.broadcast_to(factors, 3), 1.0])


def turned(axis, degrees):
    return ref.rotation(ref.axis_angle(axis, degrees))


def moved(*offset):
    return ref.translation(offset)


def box(node, size, matrix, double_sided=False):
    """The oracle's counterpart of a node that is a box, placed by a matrix of the document."""
    return Box(node.id, matrix, double_sided, size=size)


def quad(node, edge, matrix):
    return Quad(node.id, matrix, width=edge, depth=edge)


def mesh(node, matrix, size=None):
    """The oracle's counterpart of a node made of triangles: its own mesh, or the mesh of a file at a size."""
    shape = triangles_of(node.mesh if size is None else model(*size))
    shape.id, shape.matrix = node.id, matrix
    return shape


def model(name, size):
    return cc.load_mesh(cc.sample_data(f"{name}.obj"), size=size)


class Look:
    """A view made from the numbers of a document: its rays, and what these rays hit."""

    def __init__(self, eye, target, fov, near, far, size):
        self.eye, self.size, self.near, self.far = np.asarray(eye, float), size, near, far
        self.view = ref.look_at(eye, target)
        self.projection = ref.perspective(fov, size[0] / size[1], near, far)

    def hits(self, shapes):
        return raycast.cast_frame(
            shapes, self.view, self.projection, self.size, self.near, self.far
        )

    def directions(self):
        return normalised(ref.pixel_rays(self.view, self.projection, self.size)[1])


def lit(hits, colors, eye, background=GREY, **weights):
    """The Phong model of document 000 for every pixel.

    `colors` maps an id to a colour; `background` is a colour or a picture, shown where nothing is hit.
    """
    found = np.broadcast_to(np.asarray(background, float), (*hits.id.shape, 3)).copy()
    for number, color in colors.items():
        rows = hits.id == number
        found[rows] = shading.phong(
            hits.position[rows], hits.normal[rows], eye, color, [LAMP], **weights
        )
    return found


def looked_up(cube, directions):
    """A seamless lookup in a cube; the directions may be NaN where a pixel shows the background."""
    return sample_faces(cube, np.where(np.isfinite(directions), directions, 1.0))


def unbroken(hits, jump=0.15):
    """True where every silhouette is at least a pixel away, also where a shape hides a part of itself.

    At such a silhouette the distance t jumps from one pixel to the next.
    """
    t = np.where(hits.hit, hits.t, 1e3)
    padded = np.pad(t, [(0, 0)] * (t.ndim - 2) + [(1, 1)] * 2, mode="edge")
    height, width = t.shape[-2:]
    near = np.ones(t.shape, bool)
    for row in range(3):
        for column in range(3):
            shifted = padded[..., row : row + height, column : column + width]
            near &= np.abs(shifted - t) < jump * np.minimum(shifted, t)
    return near & inner_smooth(hits)


def near_enough(got, want, mask, mean, tenth, name):
    """Compare pictures that contain edges: the mean difference is below `mean`, nine pixels of ten below `tenth`."""
    assert mask.sum() > 30, f"{name}: {mask.sum()} pixels to compare, more than 30 are needed"
    difference = np.abs(np.asarray(got, float) - want)[mask]
    assert difference.mean() < mean, (
        f"{name}: mean difference {difference.mean():g}, allowed {mean:g}"
    )
    worst = np.quantile(difference, 0.9)
    assert worst < tenth, f"{name}: a tenth differ by {worst:g} and more, allowed {tenth:g}"


def photographs(size=64):
    """Six smooth pictures, all different: their colours depend on the direction and on the face."""
    from tests.gl.world import smooth_environment

    faces = smooth_environment(size)
    ramp = np.linspace(0, 1, size, dtype=np.float32)
    for face in range(6):
        # Each face gets a slant of its own, which a flip or a turn changes.
        faces[face, ..., face % 3] += 0.1 * (1 + face) * ramp[None, :] * (0.3 + ramp[:, None])
    return faces


def stage(program, frame):
    """The ground and the actors, which move counter-clockwise round +Y, 0.1 radian a frame, at radius 2.5."""
    ground = program.scene.nodes[0]
    shapes = [quad(ground, 10, moved(-1, -2, 4))]
    colors = {ground.id: (0.4, 0.4, 1.0)}
    kinds = (("bunny", (0.4, 1, 0.4)), ("teapot", (1, 0.4, 0.4)))
    for index, (actor, (name, color)) in enumerate(zip(program.actors, kinds, strict=True)):
        degrees = np.degrees(0.1 * frame) + 180 * index
        shapes.append(mesh(actor, ry(degrees) @ moved(2.5, -0.5, 0), (name, 1.2)))
        colors[actor.id] = color
    return shapes, colors


def predicted(events):
    """The place and the direction that the document's own lines give: they sum up two angles and move a place."""
    angle_x = angle_y = 0.0
    place = np.zeros(3)
    first = np.array([0, 0, 1.0])
    for event in events:
        if event == "w":
            place = place + 0.1 * (rx(angle_y) @ ry(angle_x))[:3, :3] @ first
        elif event == "s":
            place = place - 0.1 * (rx(angle_y) @ ry(angle_x))[:3, :3] @ first
        else:
            angle_x, angle_y = angle_x + event[0], angle_y + event[1]
    return place, (rx(angle_y) @ ry(angle_x))[:3, :3] @ first
