"""docs/howto/from_*.md: cubecam's programs, and that every name of cubecam in the tables exists.

What the other libraries' programs give is compared by tests/interop/test_coming_from.py.
"""

import re

import numpy as np
import pytest

import cubecam as cc
from tests.documents import text_of

NAMES = [
    "docs/howto/from_three_js.md",
    "docs/howto/from_moderngl.md",
    "docs/howto/from_pygfx.md",
    "docs/howto/from_pyvista.md",
    "docs/howto/from_py360convert.md",
    "docs/howto/from_unity.md",
]


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_program_runs(name, pages):
    pages(name)


@pytest.mark.slow
def test_three_js(pages):
    _, scope = pages("docs/howto/from_three_js.md")
    faces = scope["cube"].faces
    assert faces.shape == (6, 64, 64, 4)
    reds = (faces[..., 0] == 1) & (faces[..., 1] == 0)
    assert reds[cc.Face.POS_X, 28:36, 28:36].all()
    assert reds.sum() == reds[cc.Face.POS_X].sum()


@pytest.mark.slow
def test_moderngl(pages):
    _, scope = pages("docs/howto/from_moderngl.md")
    np.testing.assert_allclose(scope["pixel"], scope["ours"], rtol=1e-3)


@pytest.mark.slow
def test_py360convert(pages):
    _, scope = pages("docs/howto/from_py360convert.md")
    assert scope["dice"].shape == (384, 512, 3)
    assert scope["back"].shape == (256, 512, 3)
    front = scope["dice"][128:256, 128:256]  # below U, right of L
    np.testing.assert_array_equal(front, scope["cube"].to_convention("inside")[cc.Face.NEG_Z])


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES[2:4])
def test_the_sky_looks_the_right_way(name, pages):
    """The middle of the picture is what the panorama has in its middle."""
    _, scope = pages(name)
    shown = scope["ours"]
    height, width = shown.shape[:2]
    middle = shown[height // 2 - 2 : height // 2 + 2, width // 2 - 2 : width // 2 + 2]
    want = cc.to_screen(scope["cube"].sample([[(0, 0, -1)]]))[0, 0]
    assert np.abs(middle.mean(axis=(0, 1)) - want).max() < 12


@pytest.mark.slow
def test_unity(pages):
    folder, scope = pages("docs/howto/from_unity.md")
    assert scope["panorama"].shape == (512, 1024, 4)
    assert {path.name for path in (folder / "unity").iterdir()} == {"environment.exr", "README.txt"}


def classes():
    return [value for name in dir(cc) if isinstance(value := getattr(cc, name), type)]


@pytest.mark.parametrize("name", NAMES)
def test_every_name_of_cubecam_in_the_table_exists(name):
    rows = re.findall(r"^\| .+ \| (.+) \|$", text_of(name), re.MULTILINE)
    named = {path for row in rows for path in re.findall(r"\bcc\.(\w+(?:\.\w+)?)", row)}
    assert named
    for path in named:
        value = cc
        for part in path.split("."):
            value = getattr(value, part)
    members = {member for one in classes() for member in dir(one)}
    calls = {
        call
        for row in rows
        for call in re.findall(
            r"`(?:renderer|cube|node|mesh|scene|frame|camera|viewer|material)\.(\w+)", row
        )
    }
    assert calls <= members, calls - members
