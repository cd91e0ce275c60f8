"""P6: the shape of one image gives its layout; reflection in model space is compared with numpy and world space."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import model_space_reflection as example
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close, assert_identical
from tests.gl.world import inner_smooth
from tests.programs.oracle import (
    Look,
    looked_up,
    mesh,
    moved,
    near_enough,
    photographs,
    ry,
    scaled,
)
from tests.reference.cube_faces import unit_texel_directions

SIZE = (96, 48)
EYE = (0, 0.8, 4)
#: A rotation times one scale for all axes keeps angles, mirrored or not; other matrices do not.
EVEN = [(1, 1, 1), (1.3, 1.3, 1.3), (-0.9, 0.9, 0.9)]
UNEVEN = [(2, 1, 1), (0.8, 1.1, 0.5)]
#: Largest angle between the document's direction and the right one for diag(2, 1, 1): 2 atan((4 - 1) / (2 * 2)).
WORST = np.degrees(2 * np.arctan(3 / 4))

stretches = pytest.mark.parametrize("stretch", EVEN + UNEVEN, ids=str)


def ball():
    return cc.Mesh.icosphere(0.75, subdivisions=2)


def directions_as_colors(size=64):
    """Faces whose colours are their directions, so that a mirror's colour gives the direction of the reflected ray."""
    return unit_texel_directions(size).astype(np.float32) / 2 + 0.5


def documents_reflection(view, matrix, position, normal):
    """What the document's lines compute: from position and unit normal in model space, directions in world space."""
    eye = np.linalg.inv(view @ matrix) @ (0, 0, 0, 1)
    eye_direction = normalised(position - eye[:3])
    return shading.reflect(eye_direction, normal) @ matrix[:3, :3].T


def per_fragment(made, hits):
    """What the document's lines look up in each pixel of the left shape; NaN elsewhere."""
    found, rows = np.full((*hits.id.shape, 3), np.nan), hits.id == made.program.model.id
    matrix = made.matrices[0]
    # This gives the mesh's own normal again: the transpose undoes the inverse transpose.
    normal = normalised(hits.normal[rows] @ matrix[:3, :3])
    found[rows] = documents_reflection(made.look.view, matrix, hits.local[rows], normal)
    return found


def reflected_at_vertices(made):
    """The shapes' copies for numpy; the left one has its reflected directions as colours, to be interpolated."""
    copies = made.copies()
    copies[0].colors = documents_reflection(
        made.look.view,
        made.matrices[0],
        np.asarray(copies[0].positions, float),
        np.asarray(copies[0].normals, float),
    )
    return copies


class Scene:
    """The program with a mesh, and its copies for numpy."""

    def __init__(self, stretch, frame, shape=None, images=None, **options):
        self.images = photographs() if images is None else images
        image = cc.CubeMap(self.images).to_layout("cross")
        self.frame, self.shape = frame, shape
        self.program = example.build(image, stretch, mesh=shape, **options, document=True)
        self.look = Look(EYE, (0, 0, 0), 28, 0.1, 1000, SIZE)
        self.matrices = [moved(x, 0, 0) @ ry(4 * frame) @ scaled(*stretch) for x in (-0.95, 0.95)]

    def draw(self, renderer):
        return example.draw(self.program, renderer, self.frame, size=SIZE, format="rgba32f")

    def copies(self):
        nodes = self.program.model, self.program.world
        size = ("teapot", 1.5) if self.shape is None else None
        return [mesh(node, matrix, size) for node, matrix in zip(nodes, self.matrices, strict=True)]


@pytest.mark.parametrize("frame", [0, 17])
@stretches
def test_per_fragment(renderer, stretch, frame):
    made = Scene(stretch, frame, ball())
    color = made.draw(renderer)[..., :3]
    hits = made.look.hits(made.copies())
    on_model, on_world = (hits.id == node.id for node in (made.program.model, made.program.world))
    want = looked_up(made.images, per_fragment(made, hits))
    assert_close(color, want, "mirror", mask=on_model & inner_smooth(hits), least=0.03)
    # The shape on the right reflects like the teapot of P4, for any matrix.
    want = looked_up(made.images, shading.reflect(made.look.directions(), hits.normal))
    assert_close(color, want, "mirror", mask=on_world & inner_smooth(hits), least=0.03)


@pytest.mark.parametrize("frame", [0, 17])
@stretches
def test_per_vertex(renderer, stretch, frame):
    """Directions are reflected at twelve vertices and then interpolated; far-apart vertices make the effect visible."""
    made = Scene(stretch, frame, cc.Mesh.icosphere(0.75, subdivisions=0), per_vertex=True)
    color = made.draw(renderer)[..., :3]
    hits = made.look.hits(reflected_at_vertices(made))
    on_model = (hits.id == made.program.model.id) & inner_smooth(hits)
    want = looked_up(made.images, hits.color[..., :3])
    assert_close(color, want, "mirror", mask=on_model, least=0.03)
    # Reflection in each fragment gives another picture.
    other = looked_up(made.images, per_fragment(made, hits))
    assert np.abs(color - other)[on_model].mean() > 0.01


@pytest.mark.parametrize("per_vertex", [False, True])
@pytest.mark.parametrize("stretch", [(1, 1, 1), (2, 1, 1)], ids=str)
def test_the_teapot(renderer, stretch, per_vertex):
    made = Scene(stretch, 20, per_vertex=per_vertex)
    color = made.draw(renderer)[..., :3]
    hits = made.look.hits(reflected_at_vertices(made))
    found = hits.color[..., :3] if per_vertex else per_fragment(made, hits)
    mask = (hits.id == made.program.model.id) & inner_smooth(hits)
    # The normals of a teapot change much from one pixel to the next.
    near_enough(color, looked_up(made.images, found), mask, 2e-3, 6e-3, "teapot")


def both_in_one_place(renderer, stretch, images, frame=17):
    """What the document's material and a mirror show from the same place, (H, W, 3) each."""
    made = Scene(stretch, frame, ball(), images)
    program = made.program
    program.world.position = program.model.position
    pictures = []
    for shown, hidden in ((program.model, program.world), (program.world, program.model)):
        shown.visible, hidden.visible = True, False
        pictures.append(made.draw(renderer)[..., :3])
    hits = made.look.hits(made.copies()[:1])
    return pictures, hits.hit & inner_smooth(hits)


@pytest.mark.parametrize("stretch", EVEN, ids=str)
def test_a_rotation_and_one_scale_make_no_difference(renderer, stretch):
    (model, world), mask = both_in_one_place(renderer, stretch, photographs())
    assert_close(model, world, "shaded", mask=mask, least=0.03)


@pytest.mark.parametrize("stretch", UNEVEN, ids=str)
def test_other_scales_make_one(renderer, stretch):
    (model, world), mask = both_in_one_place(renderer, stretch, photographs())
    assert np.abs(model - world)[mask].mean() > 0.03


@pytest.mark.parametrize(("stretch", "least", "most"), [((1, 1, 1), 0, 0.2), ((2, 1, 1), 70, 74)])
def test_by_how_many_degrees(renderer, stretch, least, most):
    """The colours of the cubemap are directions, so the pictures give the directions that were looked up."""
    (model, world), mask = both_in_one_place(renderer, stretch, directions_as_colors(), frame=19)
    one, two = (normalised(picture[mask] * 2 - 1) for picture in (model, world))
    degrees = np.degrees(np.arccos(np.clip((one * two).sum(-1), -1, 1)))
    assert least <= degrees.max() <= most


def test_no_pair_of_directions_is_worse():
    rng = np.random.default_rng(3)
    incident, normal = normalised(rng.normal(size=(2, 400_000, 3)))
    facing = (incident * normal).sum(-1) < 0
    incident, normal = incident[facing], normal[facing]
    matrix = np.diag([2.0, 1, 1])
    own_incident = incident @ np.linalg.inv(matrix).T
    own_normal = normalised(normal @ matrix)
    bent = normalised(shading.reflect(own_incident, own_normal) @ matrix.T)
    right = shading.reflect(incident, normal)
    degrees = np.degrees(np.arccos(np.clip((bent * right).sum(-1), -1, 1)))
    assert WORST - 0.5 < degrees.max() < WORST + 1e-6


@pytest.mark.parametrize(
    ("stretch", "least", "most"), [((3, 3, 3), 0, 1e-4), ((2, 1, 1), 70, 73.8)]
)
def test_the_vertices_say_the_same(renderer, stretch, least, most):
    program = example.build(np.zeros((24, 32, 3), np.uint8), stretch, document=True)
    example.draw(program, renderer, 20, size=(8, 8))
    degrees = example.degrees_apart(program.camera, program.model)
    assert len(degrees) > 300
    assert least <= degrees.max() <= most


def test_the_eye_in_model_space(renderer):
    """Transformed back into world space, this eye is the camera's position."""
    made = Scene((0.8, 1.1, 0.5), 9, ball())
    made.draw(renderer)
    eye = example.eye_in_model_space(made.program.camera, made.program.model)
    np.testing.assert_allclose((made.matrices[0] @ [*eye, 1])[:3], EYE, atol=1e-9)
    np.testing.assert_allclose(made.program.material.uniforms["camPosModel"], eye, rtol=1e-6)


@pytest.mark.parametrize("layout", ["cross", "vertical_cross", "row", "column"])
@pytest.mark.parametrize("kind", ["array", "file"])
def test_the_shape_tells_the_layout(renderer, tmp_path, layout, kind):
    images = np.rint(np.clip(photographs(16), 0, 1) * 255).astype(np.uint8)
    image = cc.CubeMap(images).to_layout(layout)
    if kind == "file":
        cc.save_image(tmp_path / "cm.png", image)
        image = tmp_path / "cm.png"
    program = example.build(image, document=True)
    assert program.scene.environment is not None
    assert_identical(program.scene.environment.faces, images)
    assert program.material.textures["textureCubeMap"] is program.scene.environment


def test_another_shape_is_refused():
    with pytest.raises(ValueError, match=r"20.*24|24.*20"):
        example.build(np.zeros((24, 20, 3), np.uint8), document=True)


def test_the_skybox_is_optional(renderer):
    images = photographs()
    for skybox in (False, True):
        made = Scene((1, 1, 1), 0, ball(), images, skybox=skybox)
        color = made.draw(renderer)
        hits = made.look.hits(made.copies())
        sky = (
            looked_up(images, made.look.directions()) if skybox else np.zeros((SIZE[1], SIZE[0], 3))
        )
        assert_close(color[..., :3], sky, "mirror", mask=~hits.hit & inner_smooth(hits))
