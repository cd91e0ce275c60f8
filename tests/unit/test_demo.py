"""The demo's scene, its cross with the names of the faces, and the pictures that its command writes."""

import numpy as np
import pytest

import cubecam as cc
from cubecam import demo
from cubecam.pictures import cube_picture

#: Cells of the cross of convention "inside", docs/conventions.md: column, row.
CELLS = {"-X": (0, 1), "-Z": (1, 1), "+X": (2, 1), "+Z": (3, 1), "+Y": (1, 0), "-Y": (1, 2)}
GREY = cc.CubeMap(np.full((6, 2, 2, 3), 0.2, np.float32))


def lettering(cube):
    """Where the names are drawn: a mask for each cell, by column and row."""
    changed = (demo.named_cross(cube) != cube_picture(cube)).any(axis=2)
    n = cube.size
    return {
        (column, row): changed[row * n : (row + 1) * n, column * n : (column + 1) * n]
        for column in range(4)
        for row in range(3)
    }


@pytest.mark.parametrize("size", [64, 256])
def test_the_names_are_in_the_corners_of_the_faces(size):
    cube = cc.CubeMap(np.full((6, size, size, 3), 0.2, np.float32))
    drawn = lettering(cube)
    assert {cell for cell, mask in drawn.items() if mask.any()} == set(CELLS.values())
    for cell in CELLS.values():
        rows, columns = np.nonzero(drawn[cell])
        assert rows.max() < size // 4
        assert columns.max() < size // 3
        assert np.ptp(rows) >= size // 20  # readable


def test_each_face_has_its_own_name():
    """A name's first sign is the same on all faces of that sign, and the letter is that of the axis."""
    cube = cc.CubeMap(np.full((6, 256, 256, 3), 0.2, np.float32))
    drawn = lettering(cube)
    masks = {name: drawn[cell] for name, cell in CELLS.items()}
    letters = {name: right_half(mask) for name, mask in masks.items()}
    for axis in "XYZ":
        same = [letters[sign + axis] for sign in "+-"]
        assert mismatch(*same) == 0
        for other in "XYZ".replace(axis, ""):
            assert mismatch(letters["+" + axis], letters["+" + other]) > 50
    for axis in "XYZ":
        # A plus has a vertical bar and a minus has none.
        assert masks["+" + axis].sum() > masks["-" + axis].sum() + 20


def right_half(mask):
    """The letter of a name: what is drawn in the right part, cut out."""
    rows, columns = np.nonzero(mask)
    letter = mask[:, columns.max() - 16 : columns.max() + 1]
    return letter[rows.min() : rows.min() + 40]


def mismatch(one, other):
    return int((one != other).sum())


def test_the_names_lie_over_a_picture_that_stays():
    cube = cc.load_environment(cc.sample_data("sunrise.exr"), size=64)
    named, plain = demo.named_cross(cube), cube_picture(cube)
    assert (named == plain).all(axis=2).mean() > 0.97
    assert np.array_equal(named[..., 3], plain[..., 3])  # empty cells stay transparent


@pytest.mark.parametrize("angle", [0, 90, 200])
def test_bunny_and_teapot_stand_on_the_terrace_that_the_ball_touches(angle):
    built = demo.build_scene(environment=GREY, probe_size=16)
    built.turn(angle)
    (terrace,) = [
        node for node in built.scene.nodes if node not in (built.ball, built.bunny, built.teapot)
    ]
    assert terrace.mesh is not None
    floor = terrace.position[1] + terrace.mesh.bounds[1][1]
    for node in (built.ball, built.bunny, built.teapot):
        assert node.mesh is not None
        assert node.position[1] + node.mesh.bounds[0][1] == pytest.approx(floor, abs=1e-6)
    bunny, teapot = built.bunny.position, built.teapot.position
    np.testing.assert_allclose(bunny[[0, 2]], -teapot[[0, 2]], atol=1e-6)
    radius = np.hypot(bunny[0], bunny[2])
    for node in (built.bunny, built.teapot):
        assert node.mesh is not None
        assert radius - np.ptp(node.mesh.positions, axis=0)[[0, 2]].max() / 2 > 0.75


def test_run_writes_pictures_of_one_size_and_a_turn_at_25_frames_a_second(tmp_path):
    from PIL import Image

    steps = demo.run(tmp_path, frames=3, size=96, device="software")
    written = {step.path.name for step in steps if step.path}
    assert written == {path.name for path in tmp_path.iterdir()}
    assert cc.load_image(tmp_path / "frame.png").shape[:2] == (72, 96)
    assert cc.load_image(tmp_path / "cross.png").shape == (3 * 48, 4 * 48, 4)
    assert cc.load_image(tmp_path / "panorama.exr").shape[:2] == (96, 192)
    with Image.open(tmp_path / "turn.png") as turn:
        assert (turn.n_frames, turn.size) == (3, (48, 36))
        assert turn.info["duration"] == pytest.approx(40)


def test_the_frame_is_neither_dark_nor_clipped():
    built = demo.build_scene(probe_size=64)
    with cc.Renderer(device="software") as renderer:
        picture = cc.to_screen(demo._frame(renderer, built, 256))[..., :3]
    assert 0.25 < picture.mean() / 255 < 0.75
    assert (picture < 12).mean() < 0.10
    assert (picture > 250).mean() < 0.12
