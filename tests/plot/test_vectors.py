"""vectors, arrows and face_axes: colours, directions and places in numbers."""

import re

import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.colors import to_rgba
from matplotlib.quiver import Quiver

import cubecam as cc
from tests.helpers import conventions
from tests.helpers import faces as each_face
from tests.plot.artists import array_of, legend_of
from tests.reference import cube_faces
from tests.reference.pattern import direction_pattern

SIZE = 20


def quiver_of(ax):
    (quiver,) = (artist for artist in ax.collections if isinstance(artist, Quiver))
    return quiver


@conventions
def test_colours_are_half_plus_half_of_the_unit_vector(convention):
    directions = direction_pattern(SIZE)
    ax = cc.plot.vectors(7 * directions, convention=convention)
    shown = np.asarray(array_of(ax.get_images()[0]))
    expected = cube_faces.to_layout(0.5 + 0.5 * directions, "cross", convention)
    covered = shown[..., 3] == 1
    assert covered.sum() == 6 * SIZE**2
    np.testing.assert_allclose(shown[covered][:, :3], expected[covered], atol=1e-6)


def test_vectors_without_a_direction_are_grey():
    field = np.ones((2, 3, 3))
    field[0, 0] = 0
    field[1, 2] = np.nan
    shown = np.asarray(array_of(cc.plot.vectors(field).get_images()[0]))
    for place in ((0, 0), (1, 2)):
        np.testing.assert_allclose(shown[place], 0.82)
    np.testing.assert_allclose(shown[0, 1], 0.5 + 0.5 / np.sqrt(3))


@conventions
@each_face
def test_arrows_point_where_the_texels_lie_that_the_vector_points_to(convention, face):
    """Each vector leads from the middle of its face towards the texel's own place, so arrows must lead outwards."""
    directions = cube_faces.texel_directions(SIZE)
    away = directions - np.array(cube_faces.FORWARD)[:, None, None]
    ax = cc.plot.vectors(away, convention=convention, every=4)
    arrows = quiver_of(ax)
    cell = cube_faces.to_layout(
        np.arange(6)[:, None, None] * np.ones((6, 1, 1)), "cross", convention
    )
    covered = cube_faces.to_layout(np.ones((6, 1, 1)), "cross", convention)
    ((row, column),) = np.argwhere((cell == face) & (covered > 0))
    here = (column == arrows.X // SIZE) & (row == arrows.Y // SIZE)
    assert here.sum() == 25
    middle = np.array([column + 0.5, row + 0.5]) * SIZE - 0.5
    outwards = np.stack([arrows.X[here], arrows.Y[here]], axis=-1) - middle
    drawn = np.stack([arrows.U[here], arrows.V[here]], axis=-1)
    np.testing.assert_allclose(
        drawn, outwards / np.linalg.norm(outwards, axis=-1, keepdims=True), atol=1e-9
    )


def test_arrows_of_a_picture_follow_its_camera():
    camera = cc.PerspectiveCamera(
        position=(5, 0, 0), target=(0, 0, 0)
    )  # looks along -X: right is -Z
    field = np.zeros((40, 40, 3))
    field[:20] = (0, 0, -2)
    field[20:] = (0, 3, 0)
    arrows = quiver_of(cc.plot.vectors(field, camera=camera, every=10))
    upper = arrows.Y < 20
    np.testing.assert_allclose(arrows.U[upper], 1)
    np.testing.assert_allclose(arrows.V[upper], 0, atol=1e-12)
    np.testing.assert_allclose(arrows.U[~upper], 0, atol=1e-12)
    np.testing.assert_allclose(arrows.V[~upper], -1)  # rows grow downwards
    assert not cc.plot.vectors(field).collections[:]
    assert not cc.plot.vectors(field, camera=camera, every=0).collections[:]


def test_outputs_of_a_capture_and_of_a_frame(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1), cc.PhongMaterial(double_sided=True))
    cube = renderer.capture(scene, size=16, outputs=("normal", "position"))
    for output in ("normal", "position"):
        ax = cc.plot.vectors(cube, output=output)
        shown = np.asarray(array_of(ax.get_images()[0]))
        values = cube.outputs[output].astype(float)
        values /= np.linalg.norm(values, axis=-1, keepdims=True)
        expected = cube_faces.to_layout(0.5 + 0.5 * values, "cross", "inside")
        np.testing.assert_allclose(shown[shown[..., 3] == 1][:, :3], expected[shown[..., 3] == 1])
    camera = cc.PerspectiveCamera(position=(0, 0, 4), target=(0, 0, 0))
    frame = renderer.render(scene, camera, (24, 16), outputs=("normal",))
    ax = cc.plot.vectors(frame, camera=camera)
    assert array_of(ax.get_images()[0]).shape == (16, 24, 3)
    with pytest.raises(
        ValueError, match=re.escape("output: expected one of normal (what outputs=")
    ):
        cc.plot.vectors(frame, output="position")
    bare = renderer.capture(scene, size=4)
    with pytest.raises(ValueError, match=re.escape("draw it with outputs=('normal',)")):
        cc.plot.vectors(bare)


def test_arrows_need_names():
    with pytest.raises(TypeError, match="vectors: expected a dict of names to vectors, got list"):
        cc.plot.arrows([0, 0, 0], [[0, 1, 0]])  # type: ignore[arg-type]


def test_given_axes_have_y_up_unless_they_were_turned():
    from mpl_toolkits.mplot3d.axes3d import Axes3D

    _, axes = plt.subplots(1, 2, subplot_kw={"projection": "3d"})
    fresh, turned = axes
    assert isinstance(fresh, Axes3D)
    assert isinstance(turned, Axes3D)
    own = cc.plot.face_axes()
    turned.view_init(elev=10, azim=20)
    before = turned.get_proj()[:3, :3]
    for ax in axes:
        cc.plot.face_axes(ax=ax)
    np.testing.assert_allclose((fresh.elev, fresh.azim), (own.elev, own.azim))
    np.testing.assert_allclose(
        fresh.get_proj()[1, :3] / fresh.get_proj()[1, 1],
        own.get_proj()[1, :3] / own.get_proj()[1, 1],
    )
    assert (turned.elev, turned.azim) == (10, 20)
    assert np.argmax(np.abs(before[1])) == np.argmax(np.abs(turned.get_proj()[1, :3])) == 2


def test_the_legend_names_the_six_axes():
    ax = cc.plot.vectors(direction_pattern(4))
    names = [text.get_text() for text in legend_of(ax).get_texts()]
    assert names == ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]
    for name, patch in zip(names, legend_of(ax).get_patches(), strict=True):
        axis = cube_faces.FORWARD[names.index(name)]
        np.testing.assert_allclose(to_rgba(patch.get_facecolor())[:3], 0.5 + 0.5 * axis)
    assert cc.plot.vectors(direction_pattern(4), legend=False).get_legend() is None


def segments(collection):
    """The shafts of a 3D quiver: (number, 2, 3), begin and end. matplotlib keeps them before the heads, end first."""
    lines = np.array(collection._segments3d)
    return lines[: len(lines) // 3, ::-1]


def test_arrows_in_space_begin_at_their_origins_or_end_there():
    origins = np.array([[1.0, 0, 0], [0, 1, 0]])
    incident = np.array([-1.0, 0.5, 0])
    normals = origins.copy()
    ax = cc.plot.arrows(
        origins, {"incident": incident, "normal": normals}, towards=["incident"], length=0.5
    )
    first, second = (segments(collection) for collection in ax.collections)
    np.testing.assert_allclose(first[:, 0], origins - 0.5 * incident)
    np.testing.assert_allclose(first[:, 1], origins)
    np.testing.assert_allclose(second[:, 0], origins)
    np.testing.assert_allclose(second[:, 1], 1.5 * origins)
    assert [text.get_text() for text in legend_of(ax).get_texts()] == ["incident", "normal"]


def test_space_is_right_handed_with_y_up():
    ax = cc.plot.face_axes()
    ax.figure.canvas.draw()
    corners = np.eye(4)[:, :3] * [[1], [1], [1], [0]]
    from mpl_toolkits.mplot3d import proj3d

    x, y, _ = proj3d.proj_transform(*corners.T, ax.get_proj())
    screen = np.stack([x, y], axis=-1)[:3] - np.array([x, y])[:, 3]
    assert screen[1, 1] > 0.02
    assert abs(screen[1, 0]) < 0.01
    # Seen from a point where all three axes come towards the viewer, X, Y, Z turn counter-clockwise.
    turn = np.cross(np.append(screen[0], 0), np.append(screen[1], 0))[2]
    assert turn > 0


def test_face_axes_are_the_table():
    gap = 0.5
    ax = cc.plot.face_axes(gap=gap)
    arrows = [c for c in ax.collections if hasattr(c, "_segments3d")]
    assert len(arrows) == 18
    for face in range(6):
        s_axis, t_axis, view = cube_faces.TABLE[face]
        s, t, looks = (segments(collection)[0] for collection in arrows[3 * face : 3 * face + 3])
        for drawn, axis in ((s, s_axis), (t, t_axis), (looks, view)):
            along = drawn[1] - drawn[0]
            np.testing.assert_allclose(along / np.linalg.norm(along), axis, atol=1e-12)
        corner = cube_faces.face_uv_to_direction(face, 0.05, 0.05) + gap * view
        np.testing.assert_allclose(s[0], corner)
        np.testing.assert_allclose(t[0], corner)
        np.testing.assert_allclose(looks[0], 0)
    texts = {text.get_text(): np.array(text.get_position_3d()) for text in ax.texts}
    for face, name in enumerate(cube_faces.FACE_NAMES):
        assert texts[name.upper()] @ cube_faces.FORWARD[face] == pytest.approx(1 + gap)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: cc.plot.vectors(np.zeros((4, 4))), "expected vectors (6, N, N, 3) or (H, W, 3)"),
        (lambda: cc.plot.vectors(np.zeros((4, 4, 4))), "got an array of shape (4, 4, 4)"),
        (lambda: cc.plot.vectors(np.zeros((4, 4, 3)), every=-1), "every: expected a number"),
        (lambda: cc.plot.arrows([0, 0], {}), "origins: expected shape (..., 3), got (2,)"),
        (
            lambda: cc.plot.arrows(np.zeros((0, 3)), {"n": [0, 0, 1]}),
            "at least one point, got none",
        ),
        (lambda: cc.plot.arrows([0, 0, 0], {"n": [1, 2]}), "n: expected shape (..., 3), got (2,)"),
        (
            lambda: cc.plot.arrows(np.zeros((2, 3)), {"n": np.zeros((3, 3))}),
            "n: expected vectors for origins (2, 3), got shape (3, 3)",
        ),
        (
            lambda: cc.plot.arrows([0, 0, 0], {"n": [0, 0, 1]}, towards=["i"]),
            "towards: expected names of vectors, got 'i'",
        ),
        (lambda: cc.plot.face_axes(gap=-1), "gap: expected a number from 0, got -1"),
        (lambda: cc.plot.face_axes(ax=plt.gca()), 'ax: expected axes of projection="3d"'),
    ],
)
def test_wrong_input(call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call()
