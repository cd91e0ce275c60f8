"""cc.brdf and the table of the shaders: against integrals over all lights, in numpy, from glTF's formulas."""

import numpy as np
import pytest

import cubecam as cc
from cubecam import _core
from tests.reference import lighting

TABLE = _core._brdf_table()
SIZE = 64
NODES = np.arange(SIZE) / (SIZE - 1)

#: Rows and columns in which the integrands are hardest, and some between them.
ROWS = (1, 2, 5, 8, 20, 41, 63)
COLUMNS = (0, 1, 2, 4, 9, 30, 62, 63)


def test_shape():
    assert TABLE.shape == (SIZE, SIZE, 4)
    assert TABLE.dtype == np.float32
    assert np.isfinite(TABLE).all()
    assert (TABLE[..., 3] == 0).all()


@pytest.mark.parametrize("row", ROWS)
def test_furnace(row):
    for column in COLUMNS:
        cosine = max(NODES[column], 1e-4)
        expected = lighting.scale_and_bias(cosine, NODES[row])
        assert TABLE[row, column, :2] == pytest.approx(expected, abs=1e-3), (row, column)


@pytest.mark.parametrize("row", [row for row in ROWS if NODES[row] ** 2 > 1e-3])
def test_sheen(row):
    """The fit reflects more than arrives where the view grazes; the table has 1 there."""
    for column in COLUMNS:
        cosine = max(NODES[column], 1e-4)
        expected = min(lighting.sheen_albedo(cosine, NODES[row]), 1)
        assert TABLE[row, column, 2] == pytest.approx(expected, abs=1.5e-3), (row, column)


def test_a_mirror_is_exact():
    """Roughness 0 leaves Schlick's formula."""
    grazing = (1 - NODES) ** 5
    assert TABLE[0, :, 0] == pytest.approx(1 - grazing, abs=1e-6)
    assert TABLE[0, :, 1] == pytest.approx(grazing, abs=1e-6)
    assert (TABLE[0, :, 2] == 0).all()


def test_no_more_is_reflected_than_arrives():
    total = TABLE[..., 0] + TABLE[..., 1]
    assert total.max() <= 1 + 1e-5
    assert TABLE.min() >= 0


def test_lookups_are_bilinear():
    generator = np.random.default_rng(5)
    n_v, roughness = generator.random((2, 200))
    x, y = n_v * (SIZE - 1), roughness * (SIZE - 1)
    column, row = x.astype(int), y.astype(int)
    s, t = (x - column)[:, None], (y - row)[:, None]
    table = TABLE[..., :2].astype(float)
    above = table[row, column] * (1 - s) + table[row, column + 1] * s
    below = table[row + 1, column] * (1 - s) + table[row + 1, column + 1] * s
    assert cc.brdf(n_v, roughness) == pytest.approx(above * (1 - t) + below * t, abs=1e-5)


def test_nodes_are_found():
    n_v, roughness = np.meshgrid(NODES, NODES)
    assert cc.brdf(n_v, roughness) == pytest.approx(TABLE[..., :2], abs=1e-6)


def test_shapes_and_types():
    assert cc.brdf(0.5, 0.5).shape == (2,)
    assert cc.brdf(np.zeros((4, 1)), np.zeros(3)).shape == (4, 3, 2)
    assert cc.brdf([1], 0).dtype == np.float32
    assert cc.brdf(np.zeros((0, 2)), 0).shape == (0, 2, 2)


def test_numbers_beyond_0_to_1_are_clamped():
    assert np.array_equal(cc.brdf([-1, 2], [2, -1]), cc.brdf([0, 1], [1, 0]))


def test_bad_arguments():
    with pytest.raises(ValueError, match="n_dot_v: expected finite numbers, got nan"):
        cc.brdf(np.nan, 0)
    with pytest.raises(ValueError, match="roughness: expected finite numbers, got inf"):
        cc.brdf(0, np.inf)
    with pytest.raises(ValueError, match="roughness: expected a shape that can be broadcast"):
        cc.brdf(np.zeros(2), np.zeros(3))
    with pytest.raises(TypeError, match="n_dot_v: expected real numbers"):
        cc.brdf("steep", 0)
