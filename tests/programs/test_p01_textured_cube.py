"""P1: every visible pixel shows what a lookup in the direction of its object-space position gives."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import textured_cube
from tests.compare import assert_close, assert_identical
from tests.gl.world import inner
from tests.programs.oracle import GREY, Look, box, looked_up, photographs, rx, ry, scaled
from tests.reference.pattern import face_pattern

SIZE = (64, 64)


@pytest.mark.parametrize("frame", [0, 7, 41, 100])
def test_every_pixel_is_the_lookup_of_its_position(renderer, frame):
    images = photographs()
    program = textured_cube.build(images, document=True)
    color = textured_cube.draw(program, renderer, frame, size=SIZE, format="rgba32f")
    angle = 30 + 3 * frame
    # The document has Rx(angleY) Ry(angleX) scale(2), 60 degrees, near 1, far 15.
    shape = box(program.cube, 2, rx(angle) @ ry(angle) @ scaled(2))
    hits = Look((0, 0, 7), (0, 0, 0), 60, 1, 15, SIZE).hits([shape])
    want = np.where(hits.hit[..., None], looked_up(images, hits.local), GREY)
    assert hits.hit.sum() > 800
    assert_close(color[..., :3], want, "shaded", mask=inner(hits), least=0.6)
    assert (color[..., 3] == 1).all()


@pytest.mark.parametrize("frame", [0, 60])
def test_from_within(renderer, frame):
    """The document asks for this view: the camera at (0, 0, 0.001) is inside, and back faces are drawn."""
    images = photographs()
    program = textured_cube.build(images, eye=(0, 0, 0.001), document=True)
    color = textured_cube.draw(program, renderer, frame, size=SIZE, format="rgba32f")
    angle = 30 + 3 * frame
    shape = box(program.cube, 2, rx(angle) @ ry(angle) @ scaled(2), double_sided=True)
    hits = Look((0, 0, 0.001), (0, 0, 0), 60, 1, 15, SIZE).hits([shape])
    assert hits.hit.all()
    assert_close(color[..., :3], looked_up(images, hits.local), "shaded", mask=inner(hits))


def test_the_photographs_are_six_of_512_by_512(renderer):
    program = textured_cube.build(document=True)
    material = program.cube.material
    assert isinstance(material, cc.BasicMaterial)
    cubemap = material.cubemap
    assert isinstance(cubemap, cc.CubeMap)
    assert (cubemap.size, cubemap.channels) == (512, 3)
    assert cubemap.dtype == np.uint8
    assert not cubemap.mipmaps  # the document's filter is LINEAR
    assert len({face.tobytes() for face in cubemap.faces}) == 6
    camera = program.camera
    assert (camera.fov, camera.near, camera.far) == (60, 1, 15)


def test_images_come_as_arrays_and_as_files(tmp_path):
    pattern = face_pattern(16, channels=3)
    cube = cc.CubeMap(pattern)
    cube.save(tmp_path / "{face}.png", layout="faces")
    named = [tmp_path / f"{face}.png" for face in ("px", "nx", "py", "ny", "pz", "nz")]
    for images in (pattern, list(pattern), named, str(tmp_path / "{face}.png")):
        material = textured_cube.build(images, document=True).cube.material
        assert isinstance(material, cc.BasicMaterial)
        held = material.cubemap
        assert isinstance(held, cc.CubeMap)
        assert_identical(held.faces, pattern)
    with pytest.raises(ValueError, match=r"images: expected six, .*got 5"):
        textured_cube.build(pattern[:5], document=True)
