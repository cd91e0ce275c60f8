"""P12: the capture against ray casting of the moving cubes; the mirror shows the capture, without itself."""

import numpy as np
import pytest

from cubecam.examples import cube_camera as example
from cubecam.truth import shading
from tests.compare import assert_close
from tests.gl.world import inner_smooth
from tests.programs.oracle import Look, box, lit, looked_up, mesh, near_enough, photographs
from tests.reference import raycast
from tests.reference.cube_faces import texel_directions
from tests.reference.raycast import interior

SIZE, FACE = (64, 64), 40


def copies(program):
    shapes = [
        box(node, one.edge, np.asarray(node.world_matrix))
        for node, one in zip(program.cubes, program.stage.boxes, strict=True)
    ]
    colors = {
        node.id: one.color for node, one in zip(program.cubes, program.stage.boxes, strict=True)
    }
    return shapes, colors


@pytest.mark.slow
@pytest.mark.parametrize("reflector", ["sphere", "teapot"])
@pytest.mark.parametrize("frame", [0, 31, 62])
def test_capture_and_mirror(renderer, frame, reflector):
    images = photographs()
    program = example.build(
        images, reflector, probe_size=FACE, probe_format="rgba32f", document=True
    )
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
    shapes, colors = copies(program)
    # The capture: 90 degrees, near 1, far 100, from the origin, without the mirror itself.
    seen = raycast.cast_cube(shapes, (0, 0, 0), FACE, 1, 100)
    sky = looked_up(images, texel_directions(FACE))
    held = renderer.read_probe(program.probe).faces
    assert len(np.unique(seen.id)) >= 5
    want = lit(seen, colors, np.zeros(3), sky, ka=0.4)
    assert_close(held[..., :3], want, "phong", mask=interior(seen.id, seen.part))
    look = Look((0, 2, 12), (0, 0, 0), 50, 1, 100, SIZE)
    mirror = mesh(program.reflector, np.eye(4))
    hits = look.hits([*shapes, mirror])
    want = lit(hits, colors, look.eye, looked_up(images, look.directions()), ka=0.4)
    on_mirror = hits.id == program.reflector.id
    bounced = shading.reflect(look.directions(), hits.normal)
    want[on_mirror] = looked_up(held, bounced[on_mirror])[:, :3]
    mask = inner_smooth(hits) & interior(hits.id, np.where(on_mirror, 0, hits.part))
    assert_close(color, want, "phong", mask=mask & ~on_mirror)
    near_enough(color, want, mask & on_mirror, 2e-3, 6e-3, "mirror")


def test_numbers_of_the_document():
    probe = example.build(photographs(8), document=True).probe
    assert probe.depth_format == "depth_component16"
    assert (probe.size, probe.near, probe.far, probe.format) == (512, 1, 100, "rgba8")
    assert probe.position.tolist() == [0, 0, 0]


def test_the_cubes_move_and_the_probe_follows(renderer):
    program = example.build(photographs(8), probe_size=16, document=True)
    held = []
    for frame in (0, 10, 0):
        example.draw(program, renderer, frame, size=(16, 16))
        held.append(renderer.read_probe(program.probe).faces)
    assert (held[0] != held[1]).any()
    np.testing.assert_array_equal(held[0], held[2])


def test_other_reflectors_are_refused():
    with pytest.raises(ValueError, match='expected "sphere" or "teapot", got \'cone\''):
        example.build(photographs(8), "cone")  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_depth_of_16_bits_is_enough_and_counts(renderer):
    """Near 1, far 100: the document's depth and one of 32 bits show the same cubes; a coarser one would not."""
    program = example.build(photographs(8), probe_size=64, document=True)
    held = []
    for depth in ("depth_component16", "depth_component32f"):
        program.probe.depth_format = depth
        example.draw(program, renderer, 31, size=(16, 16))
        held.append(renderer.read_probe(program.probe).faces)
    assert (held[0] == held[1]).all(-1).mean() > 0.999
    program.probe.depth_format = None  # the cubes are then drawn over each other in any order
    example.draw(program, renderer, 31, size=(16, 16))
    assert (renderer.read_probe(program.probe).faces != held[0]).any()


@pytest.mark.parametrize("frame", [0, 15, 60])
@pytest.mark.parametrize("reflector", ["sphere", "teapot"])
def test_the_still_shows_ball_and_cubes_and_burns_nothing(renderer, reflector, frame):
    program = example.build(reflector=reflector)
    size = (128, 128)
    color = example.draw(program, renderer, frame, size, format="rgba32f")[..., :3]
    assert (color > 1.0001).any(-1).mean() == 0, "nothing is clipped in 8 bits"
    assert (color > 0.99).all(-1).mean() < 0.001, "and nothing is white"
    ids = renderer.render(program.scene, program.camera, size, outputs=("id",)).id
    ball = ids == program.reflector.id
    assert ball.mean() > (0.14 if reflector == "sphere" else 0.08)
    for cube in program.cubes:
        cube.visible = False
    bare = example.draw(program, renderer, frame, size, format="rgba32f")[..., :3]
    shown = ball & (np.abs(color - bare).max(-1) > 0.05)
    assert shown.sum() > 0.05 * ball.sum(), "a twentieth of the mirror are cubes"


def test_a_cube_behind_the_viewer_shows_in_the_ball(renderer):
    """The large cube stands behind the camera in the still: only the ball shows it."""
    program = example.build()
    size = (128, 128)
    with_it = example.draw(program, renderer, example.STILL, size)
    ids = renderer.render(program.scene, program.camera, size, outputs=("id",)).id
    large = max(program.cubes, key=lambda node: node.position[2] ** 2)
    assert large.position[2] < program.camera.position[2]
    assert (ids != large.id).all()
    large.visible = False
    without = example.draw(program, renderer, example.STILL, size)
    changed = (with_it != without).any(-1)
    assert changed.mean() > 0.002
    assert (ids[changed] == program.reflector.id).all()
