"""The steps over the 12 edges, against directions from the specification's table."""

import numpy as np
import pytest
from matplotlib.colors import to_hex

import cubecam as cc
from cubecam.plot import EDGE_NAMES, inner_steps, seam_ratios, seam_steps
from tests.helpers import faces as each_face
from tests.plot.artists import ydata
from tests.reference.cube_faces import FACE_NAMES, texel_directions
from tests.reference.pattern import direction_pattern

SIZE = 16


def smooth(size=SIZE):
    """(6, N, N, 2): two functions of the direction without a step or a symmetry."""
    x, y, z = np.moveaxis(direction_pattern(size).astype(float), -1, 0)
    return np.stack([np.sin(2 * x + y) + z * y, np.cos(3 * z - x) + 0.3 * y], axis=-1)[
        ..., [0, 1, 0]
    ]


def edges_of(face):
    name = FACE_NAMES[face].upper()
    return {k for k, edge in enumerate(EDGE_NAMES) if name in edge.split("|")}


def neighbours_by_distance(size):
    """For each edge, the pairs of texels of its two faces whose centers, on the cube, are 1/N from the edge each."""
    directions = texel_directions(size)
    pairs = []
    for edge in EDGE_NAMES:
        first, second = (FACE_NAMES.index(name.lower()) for name in edge.split("|"))
        a, b = (directions[face].reshape(-1, 3) for face in (first, second))
        apart = np.linalg.norm(a[:, None] - b[None], axis=-1)
        pairs.append(np.argwhere(apart < 1.5 / size))
    return pairs


def test_the_edges_are_the_twelve_of_a_cube():
    assert len(set(EDGE_NAMES)) == 12
    assert EDGE_NAMES[0] == "+X|+Y"
    assert EDGE_NAMES[-1] == "-Y|-Z"
    for edge in EDGE_NAMES:
        first, second = edge.split("|")
        assert first[1] < second[1]


def test_steps_are_those_of_the_nearest_texels_of_two_faces():
    rng = np.random.default_rng(5)
    values = rng.random((6, SIZE, SIZE))
    steps = seam_steps(values)
    assert steps.shape == (12, SIZE)
    for edge, pairs, got in zip(EDGE_NAMES, neighbours_by_distance(SIZE), steps, strict=True):
        first, second = (FACE_NAMES.index(name.lower()) for name in edge.split("|"))
        assert len(pairs) == SIZE
        expected = np.abs(values[first].ravel()[pairs[:, 0]] - values[second].ravel()[pairs[:, 1]])
        np.testing.assert_allclose(np.sort(got), np.sort(expected), atol=1e-12)


def test_inner_steps_are_the_mean_of_one_step_inwards_on_both_sides():
    """On a function of one face alone the steps are those of rows at its rim."""
    values = np.zeros((6, SIZE, SIZE))
    column = np.arange(SIZE, dtype=float) ** 2
    values[4] = column  # +Z, along s: towards +X the last column, towards -X the first
    steps = dict(zip(EDGE_NAMES, inner_steps(values), strict=True))
    np.testing.assert_allclose(steps["+X|+Z"], (column[-1] - column[-2]) / 2)
    np.testing.assert_allclose(steps["-X|+Z"], (column[1] - column[0]) / 2)
    for edge in ("+Y|+Z", "-Y|+Z", "+X|+Y", "-X|-Z"):
        np.testing.assert_allclose(steps[edge], 0)


@pytest.mark.parametrize("size", [8, 64, 256])
def test_a_smooth_world_has_steps_like_those_inside(size):
    values = smooth(size)
    ratio = seam_ratios(values)
    np.testing.assert_allclose(
        ratio, seam_steps(values).mean(axis=1) / inner_steps(values).mean(axis=1)
    )
    assert ratio.max() < 1.01
    assert ratio.min() > 0.5  # where the functions have their extremes
    assert seam_steps(values).max() < 8 / size


@each_face
@pytest.mark.parametrize("how", ["left_right", "top_bottom", "turned"])
def test_one_flipped_face_has_steps_at_exactly_its_four_edges(face, how):
    values = smooth(32)
    flipped = values.copy()
    flipped[face] = {
        "left_right": values[face][:, ::-1],
        "top_bottom": values[face][::-1],
        "turned": np.rot90(values[face], 2),
    }[how]
    steps = seam_steps(flipped)
    changed = {k for k in range(12) if not np.allclose(steps[k], seam_steps(values)[k])}
    assert changed == edges_of(face)
    assert {k for k in range(12) if seam_ratios(flipped)[k] > 2.5} == edges_of(face)


def test_a_cubemap_and_its_numbers_agree_and_uint8_counts_as_a_share_of_255():
    faces = np.random.default_rng(2).integers(0, 256, (6, 8, 8, 3), np.uint8)
    expected = seam_steps(faces / 255.0)
    np.testing.assert_allclose(seam_steps(cc.CubeMap(faces)), expected)
    np.testing.assert_allclose(seam_steps(faces), expected)
    assert 0.2 < expected.mean() < 1


def test_infinite_and_missing_numbers():
    distance = np.ones((6, 4, 4), np.float32)
    distance[2] = np.inf
    distance[4] = np.inf
    distance[0, 0, 0] = np.nan
    steps = dict(zip(EDGE_NAMES, seam_steps(distance), strict=True))
    assert (steps["+Y|+Z"] == 0).all()
    assert np.isinf(steps["-X|+Y"]).all()
    assert np.isnan(steps["+X|+Z"]).sum() == 1
    ax = cc.plot.seams(distance)
    assert ax.get_title().startswith("no seam")
    assert cc.plot.seams(np.full((6, 4, 4), np.nan)).get_title() == "no step is finite"


def test_a_captured_scene_has_no_seams(renderer):
    scene = cc.Scene(background=cc.load_environment(cc.sample_data("studio.exr")))
    assert isinstance(scene.background, cc.CubeMap)
    scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color="orange"), position=(1, 0.3, 1))
    cube = renderer.capture(scene, size=scene.background.size)
    assert seam_ratios(cube).max() < 1.3


def test_the_plot_shows_means_and_names_the_bad_edges():
    values = smooth(32)
    values[3] = values[3][::-1]
    ax = cc.plot.seams(values)
    names = [label.get_text() for label in ax.get_xticklabels()]
    assert names == list(EDGE_NAMES)
    bad = sorted(edges_of(3))
    listed = ", ".join(EDGE_NAMES[k] for k in bad)
    assert ax.get_title() == f"4 of 12 edges with a seam: {listed}"
    marks = {line.get_label(): line for line in ax.get_lines()}
    over, high = marks["over the edge"], marks["over the edge, above 2.5x"]
    expected = seam_steps(values).mean(axis=1)
    shown = np.where(np.isnan(ydata(over)), ydata(high), ydata(over))
    np.testing.assert_allclose(shown, expected)
    assert np.flatnonzero(np.isfinite(ydata(high))).tolist() == bad
    assert to_hex(high.get_color()) != to_hex(over.get_color())
    np.testing.assert_allclose(
        ydata(marks["beside the edge, inside the faces"]), inner_steps(values).mean(axis=1)
    )
    labels = [text.get_text() for text in ax.texts]
    assert [label[-1] for label in labels] == ["x"] * 12
    np.testing.assert_allclose([float(x[:-1]) for x in labels], seam_ratios(values), rtol=0.05)
    assert ax.get_yscale() == "log"


def test_ratios_of_steps_that_are_zero_or_not_finite():
    values = np.zeros((6, 4, 4))
    values[2] = 1
    values[5, :, 0] = np.nan
    ratio = dict(zip(EDGE_NAMES, seam_ratios(values), strict=True))
    assert ratio["+X|+Z"] == 1
    assert ratio["+X|+Y"] == np.inf
    assert np.isnan(ratio["+X|-Z"])  # the first column of -Z lies at +X
    assert ratio["-X|-Z"] == 1


def test_a_cube_of_one_colour_has_no_seam_and_no_logarithm():
    ax = cc.plot.seams(np.full((6, 4, 4, 3), 0.5))
    assert ax.get_yscale() == "linear"
    assert {text.get_text() for text in ax.texts} == {"1x"}


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: seam_steps(np.zeros((5, 4, 4))), r"expected a CubeMap or an array \(6, N, N\)"),
        (lambda: seam_steps(np.zeros((6, 4, 5, 3))), r"got shape \(6, 4, 5, 3\)"),
        (lambda: inner_steps(np.zeros((6, 1, 1))), "at least 2 x 2 texels, got 1 x 1"),
        (lambda: cc.plot.seams(np.zeros((6, 4, 4)), scale="cubic"), "scale: expected"),  # type: ignore[arg-type]
    ],
)
def test_wrong_input(call, message):
    with pytest.raises(ValueError, match=message):
        call()
