"""P13: faces against ray casting with the document's Phong, and the cube that wears them in the main view."""

import numpy as np
import pytest

from cubecam.examples import cubemap_on_a_cube as example
from tests.compare import assert_close
from tests.gl.world import inner
from tests.programs.oracle import (
    GREY,
    Look,
    box,
    lit,
    looked_up,
    mesh,
    moved,
    near_enough,
    quad,
    rx,
    ry,
    scaled,
    turned,
    unbroken,
)
from tests.programs.staged import gaze, like_the_background
from tests.reference import raycast
from tests.reference.raycast import interior

SIZE, FACE = (64, 64), 40


def hall(program):
    """The colours and places of ground, ceiling and actors, by the document's numbers."""
    ground, ceiling, bunny, teapot = program.scene.nodes[:4]
    shapes = [
        quad(ground, 10, moved(-1, -2, 4)),
        quad(ceiling, 10, moved(-1, 3, 4) @ rx(180)),
        mesh(bunny, moved(-2, -0.5, 2), ("bunny", 1.2)),
        mesh(teapot, moved(2.5, -0.5, 1.5), ("teapot", 1.2)),
    ]
    paints = ((0.4, 0.4, 1), (0.4, 1, 1), (0.4, 1, 0.4), (1, 0.4, 0.4))
    return shapes, {shape.id: paint for shape, paint in zip(shapes, paints, strict=True)}


@pytest.fixture(scope="module")
def drawn(shared_renderers):
    """A function that gives a drawn frame and what the rays of its faces meet."""
    program = example.build(probe_size=FACE, probe_format="rgba32f", document=True)
    renderer = shared_renderers(None)
    pictures = {
        frame: example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
        for frame in (0, 1, 40, 333)
    }
    shapes, colors = hall(program)
    seen = raycast.cast_cube(shapes, (0, 0, 0), FACE, 1, 100)
    return program, pictures, renderer.read_probe(program.probe).faces, shapes, colors, seen


@pytest.mark.slow
def test_faces(drawn, renderer):
    program, _, held, _, colors, seen = drawn
    assert set(np.unique(seen.id)) == {0, *colors}
    want = lit(seen, colors, np.zeros(3))  # the eye of a capture is its own position
    mask = unbroken(seen, 0.06)
    assert_close(held[..., :3], want, "phong", mask=mask)
    # The ceiling has one colour everywhere, so only distances show its height.
    cube = renderer.capture(
        program.scene, size=FACE, near=1, far=100, exclude=[program.cube], outputs=("distance",)
    )
    assert_close(cube.distance, seen.distance, "distance", mask=mask)


@pytest.mark.parametrize("frame", [0, 1, 40, 333])
def test_main_view(drawn, frame):
    program, pictures, held, shapes, colors, _ = drawn
    # translate(0, .8, 0) * scale(.8) * rotate(.45 k about (1, 1, 1)); the cube spans -1 to 1.
    matrix = moved(0, 0.8, 0) @ scaled(0.8) @ turned((1, 1, 1), 0.45 * frame)
    cube = box(program.cube, 2, matrix)
    look = Look((0, 1, 5), (0, 0, 0), 70, 1, 100, SIZE)
    hits = look.hits([*shapes, cube])
    want = lit(hits, colors, look.eye)
    on_cube = hits.id == program.cube.id
    want[on_cube] = looked_up(held, hits.local)[on_cube][:, :3]
    others = unbroken(hits, 0.06) & ~on_cube & interior(hits.id)
    assert_close(pictures[frame], want, "phong", mask=others)
    near_enough(pictures[frame], want, inner(hits) & on_cube, 2e-3, 5e-3, "cube")


def test_numbers_of_the_document():
    program = example.build(document=True)
    probe, camera = program.probe, program.camera
    assert (probe.size, probe.near, probe.far, probe.format) == (256, 1, 100, "rgba8")
    assert probe.depth_format == "depth_component16"
    assert (camera.fov, camera.near, camera.far) == (70, 1, 100)
    assert isinstance(program.scene.background, np.ndarray)
    np.testing.assert_allclose(program.scene.background[:3], GREY)


def test_turning_the_cube_draws_no_face_again(renderer):
    """The cube is left out of the cubemap that it shows."""
    program = example.build(probe_size=16, document=True)
    example.draw(program, renderer, 0, size=(16, 16))
    example.draw(program, renderer, 10, size=(16, 16))
    assert renderer.stats.views_drawn == 1


def test_the_staged_cube_is_large_and_unlike_its_background(renderer):
    program = example.build()
    for frame in (program.still, 0, 110):
        example.draw(program, renderer, frame, size=(16, 16))
        ids = renderer.render(program.scene, program.camera, (128, 128), outputs=("id",)).id
        assert (ids == program.cube.id).mean() > 0.12
        assert like_the_background(renderer, program, program.cube) < 0.05
    assert program.still == example.STILL


def test_the_staged_cube_shows_the_figures(renderer):
    """In the still, the cube shows the bunny that stands in front of it."""
    program = example.build()
    example.draw(program, renderer, program.still, size=(16, 16))
    picture = renderer.render(program.scene, program.camera, (256, 256), outputs=("id",))
    on_cube = picture.color[picture.id == program.cube.id][:, :3].astype(int)
    red, green, blue = on_cube.T
    assert ((green > 60) & (green > 2 * red) & (green > 2 * blue)).mean() > 0.03


@pytest.mark.parametrize("document", [False, True])
@pytest.mark.parametrize("angles", [(0, 0), (30, 0), (0, -20), (25, 10)])
def test_view_angles(document, angles):
    """The document turns the view direction by angleY round X after angleX round Y."""
    program = example.build(angles=angles, document=document)
    camera, first = program.camera, example.build(document=document).camera
    want = (rx(angles[1]) @ ry(angles[0]))[:3, :3] @ gaze(first)
    np.testing.assert_allclose(gaze(camera), want, atol=1e-9)
    np.testing.assert_allclose(camera.position, first.position)


def test_a_script_moves_the_visitor():
    program = example.build(script="drag 51.2 0; w 3", document=True)
    ahead = ry(10)[:3, :3] @ (0, -1, -5) / np.sqrt(26)
    np.testing.assert_allclose(program.camera.position, (0, 1, 5) + 0.3 * ahead, atol=1e-9)


def test_the_document_has_no_photographs():
    with pytest.raises(ValueError, match=r"images: expected None with document=True.*got list"):
        example.build(images=[np.zeros((2, 2, 3), np.uint8)] * 6, document=True)


def test_photographs_of_one_s_own_surround_the_staged_scene(renderer):
    magenta = np.full((4, 4, 3), (255, 0, 255), np.uint8)
    program = example.build(images=[magenta] * 6)
    picture = renderer.render(program.scene, program.camera, (64, 64), outputs=("id",))
    assert (picture.id == 0).any()
    np.testing.assert_array_equal(picture.color[picture.id == 0][0, :3], (255, 0, 255))
