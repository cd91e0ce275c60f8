"""P5: frames before, between and after the arrivals; a face of another size is refused, and both sizes are named."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import arriving_faces as example
from cubecam.truth import shading
from tests.compare import assert_close, assert_identical
from tests.gl.world import inner
from tests.programs.oracle import Look, box, looked_up, photographs, rx, ry

SIZE = (64, 64)
ORDER = (4, 1, 0, 5, 3, 2)


def bytes_of(images):
    return np.rint(np.clip(images, 0, 1) * 255).astype(np.uint8)


@pytest.mark.parametrize("frame", [0, 1, 3, 5, 6, 30, 45, 46, 48, 51, 80])
def test_frames(renderer, frame):
    """The camera has near 1 and far 2000 and stands at (0, 0, 2); from frame 45 on the skybox is drawn."""
    images = bytes_of(photographs(32))
    program = example.build(images, size=32, document=True)
    color = example.draw(program, renderer, frame, size=SIZE, format="rgba32f")[..., :3]
    faces = np.full_like(images, 102)
    for face in ORDER[: frame % 45]:
        faces[face] = images[face]
    assert_identical(program.cubemap.faces, faces)
    shape = box(program.cube, 1, rx(1.6 * frame) @ ry(2.8 * frame))
    look = Look((0, 0, 2), (0, 0, 0), 60, 1, 2000, SIZE)
    hits = look.hits([shape])
    incident = look.directions()
    directions = np.where(hits.hit[..., None], shading.reflect(incident, hits.normal), incident)
    want = looked_up(faces, directions)
    if frame < 45:
        want[~hits.hit] = 0
    assert hits.hit.sum() > 500
    assert_close(color, want, "unorm8_filter", mask=inner(hits))


def test_it_is_usable_at_once_and_of_one_color(renderer):
    program = example.build(document=True)
    picture = example.draw(program, renderer, 45, size=SIZE)
    assert (picture[..., :3] == 102).all()
    assert program.cubemap.size == 512
    assert program.cubemap.mipmaps


def test_photographs_may_leave_again(renderer):
    program = example.build(bytes_of(photographs(16)), size=16, document=True)
    first = example.draw(program, renderer, 2, size=SIZE)
    example.draw(program, renderer, 6, size=SIZE)
    assert_identical(example.draw(program, renderer, 2, size=SIZE), first)


def test_mipmaps_are_made_anew(renderer):
    """With LINEAR_MIPMAP_LINEAR, noise seen small is near its mean, also on a face that has just arrived."""
    noise = np.random.default_rng(5).integers(0, 256, (6, 512, 512, 3), np.uint8)
    program = example.build(noise, document=True)
    size = (12, 12)
    picture = example.draw(program, renderer, 45 + 6, size=size, format="rgba32f")[..., :3]
    assert np.abs(picture - 0.5).max() < 0.2
    plain = cc.CubeMap(noise)  # LINEAR alone takes single texels
    program.scene.environment = program.scene.background = plain
    linear = renderer.render(program.scene, program.camera, size, format="rgba32f").color[..., :3]
    assert np.abs(linear - 0.5).max() > 0.3


@pytest.mark.parametrize("shape", [(32, 16, 3), (16, 16, 3)])
def test_what_is_not_square_or_not_equal_is_refused_with_both_sizes(renderer, shape):
    images = list(bytes_of(photographs(32)))
    images[ORDER[3]] = np.zeros(shape, np.uint8)
    program = example.build(images, size=32, document=True)
    for frame in range(4):
        example.draw(program, renderer, frame, size=(8, 8))
    with pytest.raises(ValueError, match="32") as caught:
        example.draw(program, renderer, 4, size=(8, 8))
    for number in (*shape[:2], 32):
        assert str(number) in str(caught.value)
    assert (program.cubemap.faces[ORDER[3]] == 102).all()
    assert_identical(program.cubemap.faces[ORDER[2]], images[ORDER[2]])
    # Six faces given at once raise the error, too, and its message names both shapes.
    with pytest.raises(ValueError, match="six of one shape") as caught:
        cc.CubeMap(images)
    assert str(shape[1]) in str(caught.value)
    assert "32" in str(caught.value)
