"""A few small pictures of whole scenes against committed ones, on llvmpipe alone: one version draws the same pixels
everywhere, and another version a few other ones.

They show whether a change of one thing changes another, which no formula covers. After an intended change,
write the pictures anew and look at them:  pytest tests/images --regenerate-references
"""

from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.images.pictures import PICTURES

FOLDER = Path(__file__).parent
#: The version whose llvmpipe drew the references.
MESA = "Mesa 22.3.6"


@pytest.mark.parametrize("name", PICTURES)
def test_picture(name, shared_renderers, request):
    renderer = shared_renderers(None)
    got = PICTURES[name](renderer)
    path = FOLDER / f"{name}.png"
    if request.config.getoption("--regenerate-references"):
        cc.save_image(path, got)
        pytest.fail(
            f"{path.name} was written anew: look at it, then run without --regenerate-references"
        )
    assert path.exists(), f"{path.name} is missing: run with --regenerate-references"
    same = renderer.info.version.endswith(MESA)
    rule = "reference_image" if same else "reference_image_of_another_mesa"
    assert_close(got.astype(int), cc.load_image(path).astype(int), rule, name=name)


def test_pictures_are_not_empty():
    for name in PICTURES:
        assert cc.load_image(FOLDER / f"{name}.png")[..., :3].std() > 20, name


def test_no_picture_is_left_over():
    assert {path.stem for path in FOLDER.glob("*.png")} == set(PICTURES)


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in FOLDER.glob("*.png")) < 200_000


def test_pictures_differ():
    pictures = [cc.load_image(FOLDER / f"{name}.png") for name in PICTURES]
    assert len({picture.tobytes() for picture in pictures}) == len(pictures)
    assert all(picture.dtype == np.uint8 for picture in pictures)
