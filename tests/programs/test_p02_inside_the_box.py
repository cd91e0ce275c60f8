"""P2: a scripted list of drags and keys gives the frames that numpy predicts."""

import numpy as np
import pytest

from cubecam.examples import inside_the_box
from tests.compare import assert_close
from tests.gl.world import inner
from tests.programs.oracle import GREY, Look, box, looked_up, photographs, predicted, scaled

SIZE = (48, 48)
#: Drags (angleX, angleY) and keys; the last ones lead the camera out of the box.
SCRIPT = [
    (25, 0),
    "w",
    "w",
    (0, 30),
    "w",
    (-70, 20),
    "s",
    (110, -35),
    *["w"] * 9,
    (15, 4),
    *["w"] * 25,
]


@pytest.mark.parametrize("script", [SCRIPT, inside_the_box.SCRIPT], ids=["script", "its own"])
def test_frames(renderer, script):
    images = photographs()
    program = inside_the_box.build(images, script=script, document=True)
    shape = box(program.scene.nodes[0], 2, scaled(2), double_sided=True)
    outside = 0
    for frame in sorted({0, 1, 3, 4, 7, 8, len(script) // 2, len(script)}):
        color = inside_the_box.draw(program, renderer, frame, size=SIZE, format="rgba32f")
        place, direction = predicted(script[:frame])
        hits = Look(place, place + direction, 60, 1, 15, SIZE).hits([shape])
        want = np.where(hits.hit[..., None], looked_up(images, hits.local), GREY)
        assert_close(color[..., :3], want, "shaded", mask=inner(hits), name=f"frame {frame}")
        outside += np.abs(place).max() > 2
    assert outside > 0  # the script goes on until the camera has left the box


def test_one_event_a_frame_and_none_before_the_first(renderer):
    program = inside_the_box.build(photographs(8), script=["w", "s"], document=True)
    pictures = [inside_the_box.draw(program, renderer, k, size=(24, 24)) for k in (-1, 0, 1, 2, 3)]
    np.testing.assert_array_equal(pictures[0], pictures[1])
    assert (pictures[1] != pictures[2]).any()
    np.testing.assert_array_equal(pictures[1], pictures[3])  # one step forwards and one step back
    np.testing.assert_array_equal(pictures[3], pictures[4])


def test_straight_up_keeps_the_view_and_moves_on(renderer):
    """Rx(90) (0, 0, 1) is -Y, a direction for which lookAt with +Y up has no answer: the last view stays."""
    program = inside_the_box.build(
        photographs(8), script=[(0, 45), (0, 45), (0, 45), "w"], document=True
    )
    for frame in range(5):
        inside_the_box.draw(program, renderer, frame, size=(8, 8))
    place, direction = predicted(program.script)
    np.testing.assert_allclose(program.camera.position, place, atol=1e-12)
    np.testing.assert_allclose(program.camera.target - place, direction, atol=1e-12)


def test_other_keys_are_refused():
    with pytest.raises(ValueError, match=r'expected "w", "s" or a drag.*jump'):
        inside_the_box.build(photographs(8), script=["jump"], document=True)
