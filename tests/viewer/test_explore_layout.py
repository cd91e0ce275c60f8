"""`cc.explore.layout()`: flat it is the layout of "gl", folded up it is the cube itself, copies included."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.explore import LayoutView
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import COLORS, face_pattern

FACE_NAMES = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")
#: Where the faces stand while they lie flat: column and row.
FLAT = {"-X": (0, 1), "+Z": (1, 1), "+X": (2, 1), "-Z": (3, 1), "+Y": (1, 0), "-Y": (1, 2)}
#: The faces and the copies: the name of the face, where it lies flat, the quarter turns of its picture.
COPIES = {
    "copy of +Y beside -X": ("+Y", (0, 0), 1),
    "copy of -Y beside -X": ("-Y", (0, 2), 3),
    "copy of +Y beside +X": ("+Y", (2, 0), 3),
    "copy of -Y beside +X": ("-Y", (2, 2), 1),
    "copy of +Y beside -Z": ("+Y", (3, 0), 2),
    "copy of -Y beside -Z": ("-Y", (3, 2), 2),
}
N = 4


def drawn_nodes(view):
    return {node.name: node for node in view.scene.nodes if node.mesh is not None}


def texel_places(node):
    """The places in the world of the middles of N x N pixels of a node's picture, row 0 on top."""
    middles = (np.arange(N) + 0.5) / N * 2 - 1
    x, y = np.meshgrid(middles, -middles)
    local = np.stack([x, y, np.zeros_like(x), np.ones_like(x)], axis=-1)
    return (local @ np.asarray(node.world_matrix).T)[..., :3]


@pytest.fixture
def view(shared_renderers):
    with LayoutView(renderer=shared_renderers(None)) as made:
        yield made


def test_folded_up_each_texel_lies_in_its_direction(view):
    """Every pixel of a face, and of each copy, lies where OpenGL's table has its texel, seen from the middle."""
    view.fold, view.repeat = 1, "all"
    nodes = drawn_nodes(view)
    directions = texel_directions(N)
    assert set(nodes) == {*FACE_NAMES, *COPIES}
    for name, node in nodes.items():
        face, _, turns = COPIES.get(name, (name, None, 0))
        places = texel_places(node)
        want = np.rot90(directions[FACE_NAMES.index(face)], turns)
        ours = places / np.linalg.norm(places, axis=-1, keepdims=True)
        np.testing.assert_allclose(
            ours, want / np.linalg.norm(want, axis=-1, keepdims=True), atol=1e-6
        )
        assert np.abs(places).max() == pytest.approx(1.7), "the cube is shown larger"


def test_flat_the_faces_lie_as_in_the_cross(view):
    nodes = drawn_nodes(view)
    for name, node in nodes.items():
        column, row = COPIES[name][1] if name in COPIES else FLAT[name]
        x, y, z = np.asarray(node.world_matrix)[:3, 3]
        assert (x, y, z) == pytest.approx((2 * column - 3, 2 - 2 * row, 0))
    shown = [name for name, node in nodes.items() if node.visible]
    assert shown[6:] == ["copy of +Y beside -Z", "copy of -Y beside -Z"]


@pytest.mark.parametrize("fold", [0.0, 0.3, 0.77, 1.0])
def test_neighbours_stay_joined_while_they_fold(view, fold):
    """The edge of each side is the edge of the next one, at any fold."""
    view.fold = fold
    nodes = drawn_nodes(view)

    def corner(name, x, y):
        return (np.asarray(nodes[name].world_matrix) @ (x, y, 0, 1))[:3]

    for left, right in (("-X", "+Z"), ("+Z", "+X"), ("+X", "-Z")):
        for y in (-1, 1):
            np.testing.assert_allclose(corner(left, 1, y), corner(right, -1, y), atol=1e-6)
    for x in (-1, 1):
        np.testing.assert_allclose(corner("+Y", x, -1), corner("+Z", x, 1), atol=1e-6)
        np.testing.assert_allclose(corner("-Y", x, 1), corner("+Z", x, -1), atol=1e-6)
        np.testing.assert_allclose(
            corner("copy of +Y beside -Z", x, -1), corner("-Z", x, 1), atol=1e-6
        )


def test_the_picture_shows_the_faces_of_the_cube(shared_renderers):
    """Flat, the middle of each face has the colour of the pattern's face; folded, only three faces can be seen."""
    pattern = face_pattern(32, 3)
    with LayoutView(pattern, repeat=None, renderer=shared_renderers(None)) as view:
        picture = view.draw((400, 300))
        for index, name in enumerate(FACE_NAMES):
            x, y, _ = np.asarray(drawn_nodes(view)[name].world_matrix)[:3, 3]
            scale = 300 / (2 * 13 * np.tan(np.radians(16)))
            here = picture[round(150 - y * scale), round(200 + x * scale), :3].astype(int)
            assert np.abs(COLORS - here).sum(axis=1).argmin() == index, name
            picked = view.pick(200 + x * scale, 150 - y * scale, size=(400, 300))
            assert picked is not None
            assert picked.node.name == name
        view.fold = 1
        folded = view.draw((400, 300))
        assert (folded != picture).any(-1).mean() > 0.1
        middle = folded[150, 200, :3].astype(int)
        assert np.abs(COLORS - middle).sum(axis=1).argmin() == FACE_NAMES.index("+Z")


def test_from_inside_a_face_is_mirrored(shared_renderers):
    """The lesson of document 004: what is stored is the view from outside."""
    pattern = face_pattern(32, 3)
    with LayoutView(pattern, fold=1, renderer=shared_renderers(None)) as view:
        view.camera.target, view.camera.position = (0, 0, 1), (0, 0, 0)
        assert isinstance(view.camera, cc.PerspectiveCamera)
        view.camera.fov = 90
        inside = view.draw((64, 64))[..., :3].astype(int)
        view.camera.position, view.camera.target = (0, 0, 3.4), (0, 0, 0)
        outside = view.draw((64, 64))[..., :3].astype(int)
    # The frames of both show the whole face +Z: the camera is 1.7 away from it.
    apart = [np.abs(inside - one)[16:48, 4:60].mean() for one in (outside[:, ::-1], outside)]
    assert apart[0] < 0.3 * apart[1]


def test_keys_fold_and_change_the_copies(view):
    def animation():
        assert view._animation is not None
        return view._animation

    view._answer({"event_type": "key_down", "key": "f"})
    animation()(0.75)
    assert view.fold == pytest.approx(0.5)
    animation()(2.0)
    assert view.fold == 1
    assert view._animation is None
    copies = [node for name, node in drawn_nodes(view).items() if name in COPIES]
    assert not any(node.visible for node in copies), "folded up, the faces themselves are there"
    view._answer({"event_type": "key_down", "key": "f"})
    animation()(2.0)
    assert view.fold == 0
    seen = []
    for _ in range(3):
        view._answer({"event_type": "key_down", "key": "c"})
        seen.append((view.repeat, sum(node.visible for node in copies)))
    assert seen == [("all", 6), (None, 0), ("-Z", 2)]
    assert "fold, unfold" in view.help
    first = view.panel()[0]
    assert [control.name for control in first.controls] == ["fold", "repeat"]
    first.controls[1].set("none")
    assert view.repeat is None


def test_names_are_written_on_the_faces(view):
    """Black on white; those of copies in grey. The words of a copy are turned as its face is."""
    nodes = drawn_nodes(view)
    upright = np.asarray(nodes["+Y"].material.map.pixels)
    ours = np.asarray(nodes["copy of +Y beside -Z"].material.map.pixels)
    # Half covered by black 20, or by grey 150.
    inked = np.rot90(ours, 2).max(-1) < 202
    np.testing.assert_array_equal(inked[8:-8, 8:-8], (upright.max(-1) < 137)[8:-8, 8:-8])
    assert upright.min() < 40
    assert ours.min() > 100


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"fold": 2}, ValueError, "fold: expected 0 to 1, got 2"),
        ({"repeat": "+Y"}, ValueError, "repeat: expected"),
        ({"flat": True}, TypeError, "flat"),
        ({"cube": np.zeros((6, 4, 4))}, ValueError, r"cube: expected colours \(6, N, N, C\)"),
    ],
)
def test_wrong_options(options, error, message):
    with pytest.raises(error, match=message):
        LayoutView(**options)


def test_the_function_shows_the_view():
    with cc.explore.layout(where="offscreen", fold=0.5, repeat="all", size=(80, 60)) as view:
        assert view.draw().shape == (60, 80, 4)
        assert (view.fold, view.repeat) == (0.5, "all")
    assert view.closed
