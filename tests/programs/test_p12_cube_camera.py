"""P12: the capture against ray casting of the moving cubes; the mirror shows the capture, without itself."""

import numpy as np
import pytest

from cubecam.examples import cube_camera as example
from tests.compare import assert_close
from tests.gl.world import inner_smooth
from tests.programs.oracle import Look, box, lit, looked_up, mesh, near_enough, photographs
from tests.reference import raycast, shading
from tests.reference.cube_faces import texel_directions
from tests.reference.raycast import interior

SIZE, FACE = (64, 64), 40


def copies(program):
    shapes = [
        box(node, edge, np.asarray(node.world_matrix))
        for node, (_, edge, *_) in zip(program.cubes, example.CUBES, strict=True)
    ]
    colors = {
        node.id: color for node, (color, *_) in zip(program.cubes, example.CUBES, strict=True)
    }
    return shapes, colors


@pytest.mark.slow
@pytest.mark.parametrize("reflector", ["sphere", "teapot"])
@pytest.mark.parametrize("frame", [0, 31, 62])
def test_capture_and_mirror(renderer, frame, reflector):
    images = photographs()
    program = example.build(images, reflector, probe_size=FACE, probe_format="rgba32f")
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
    probe = example.build(photographs(8)).probe
    assert (probe.size, probe.near, probe.far, probe.format) == (512, 1, 100, "rgba8")
    assert probe.position.tolist() == [0, 0, 0]


def test_the_cubes_move_and_the_probe_follows(renderer):
    program = example.build(photographs(8), probe_size=16)
    held = []
    for frame in (0, 10, 0):
        example.draw(program, renderer, frame, size=(16, 16))
        held.append(renderer.read_probe(program.probe).faces)
    assert (held[0] != held[1]).any()
    np.testing.assert_array_equal(held[0], held[2])


def test_other_reflectors_are_refused():
    with pytest.raises(ValueError, match='expected "sphere" or "teapot", got \'cone\''):
        example.build(photographs(8), "cone")  # type: ignore[arg-type]
