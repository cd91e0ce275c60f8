"""CubeMap.sh and from_sh: against tables, analytic lights and the addition theorem."""

import numpy as np
import pytest
from numpy.polynomial import legendre

import cubecam as cc
from tests.cubes import noise, photograph, random_directions, rms
from tests.reference import lighting
from tests.reference.cube_faces import unit_texel_directions

AXIS = np.array([2, -1, 2]) / 3


def basis_at_texels(order, size=3):
    """(6, size, size, (order + 1)^2): the basis functions, one cube for each."""
    units = np.eye((order + 1) ** 2)
    return np.concatenate(
        [cc.CubeMap.from_sh(unit[:, None], size=size).faces for unit in units], axis=-1
    )


def test_the_basis_is_that_of_the_paper():
    expected = lighting.sh_basis(unit_texel_directions(3))
    assert basis_at_texels(2) == pytest.approx(expected, abs=1e-6)


def test_higher_orders_satisfy_the_addition_theorem():
    """The sum over m of Y(l, m)(a) Y(l, m)(b) is (2 l + 1) / (4 pi) P_l(a.b)."""
    values = basis_at_texels(9, size=2).reshape(24, -1)
    directions = unit_texel_directions(2).reshape(24, 3)
    cosines = directions @ directions.T
    for order in range(10):
        rows = values[:, order**2 : (order + 1) ** 2]
        polynomial = legendre.legval(cosines, np.eye(10)[order])
        assert rows @ rows.T == pytest.approx((2 * order + 1) / (4 * np.pi) * polynomial, abs=1e-5)


def test_projection_of_a_photograph():
    cube = photograph("studio", 32)
    assert cube.sh() == pytest.approx(lighting.project(cube.faces), rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("order", range(5))
def test_analytic_lights(order):
    """Radiance P_l(n.a) has the coefficients 4 pi / (2 l + 1) Y(l, m)(a), and no others (Funk and Hecke)."""
    size = 96
    cosine = unit_texel_directions(size) @ AXIS
    faces = legendre.legval(cosine, np.eye(6)[order])[..., None].astype(np.float32)
    got = cc.CubeMap(faces).sh(5)[:, 0]
    expected = np.zeros(36)
    if order <= 2:
        rows = lighting.sh_basis(AXIS)[order**2 : (order + 1) ** 2]
        expected[order**2 : (order + 1) ** 2] = 4 * np.pi / (2 * order + 1) * rows
        assert got == pytest.approx(expected, abs=1e-3)
    else:
        power = np.square(got[order**2 : (order + 1) ** 2]).sum()
        assert power == pytest.approx(4 * np.pi / (2 * order + 1), rel=1e-3)
        rest = np.delete(got, np.s_[order**2 : (order + 1) ** 2])
        assert np.abs(rest).max() < 1e-3


def test_a_constant_is_exact():
    """The solid angles of the texels add up to 4 pi."""
    got = cc.CubeMap(np.ones((6, 5, 5, 1), np.float32)).sh(0)
    assert got[0, 0] == pytest.approx(np.sqrt(4 * np.pi), rel=1e-6)


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_from_sh_and_back(channels):
    coefficients = np.random.default_rng(3).normal(size=(16, channels))
    cube = cc.CubeMap.from_sh(coefficients, size=64)
    assert (cube.size, cube.channels, cube.dtype.name) == (64, channels, "float32")
    assert cube.sh(3) == pytest.approx(coefficients, abs=3e-3)


def test_values_of_from_sh():
    coefficients = np.random.default_rng(4).normal(size=(9, 3))
    expected = lighting.sh_basis(unit_texel_directions(7)) @ coefficients
    assert cc.CubeMap.from_sh(coefficients, size=7).faces == pytest.approx(expected, abs=1e-5)


def test_nine_coefficients_hold_the_irradiance():
    """Factors 1, 2/3 and 1/4 of the orders (Ramamoorthi and Hanrahan 2001); 2 % of a forest are missing."""
    cube = photograph("forest", 64)
    factors = np.repeat([1, 2 / 3, 1 / 4], [1, 3, 5])[:, None]
    directions = random_directions(300)
    exact = lighting.irradiance(cube.faces, directions)
    got = lighting.sh_basis(directions) @ (cube.sh() * factors)
    assert rms(got - exact) < 0.03 * rms(exact)


def test_bytes_count_as_shares_of_1():
    cube = noise(8, 3, "uint8")
    same = cc.CubeMap((cube.faces / np.float32(255)).astype(np.float32))
    assert cube.sh() == pytest.approx(same.sh(), abs=1e-6)
    assert cube.sh().dtype == np.float64


@pytest.mark.parametrize("order", [-1, 65])
def test_orders_outside_the_limits(order):
    with pytest.raises(ValueError, match=f"order: expected an int from 0 to 64, got {order}"):
        noise(2, 1).sh(order)


@pytest.mark.parametrize(
    ("coefficients", "error", "text"),
    [
        (np.zeros((5, 3)), ValueError, "coefficients: expected 1, 4, 9, 16, .* rows, got 5"),
        (np.zeros((0, 3)), ValueError, "rows, got 0"),
        (np.zeros((9, 2)), ValueError, "coefficients: expected 1, 3 or 4 columns, got 2"),
        (np.zeros(9), ValueError, r"coefficients: expected shape \(K, C\), got \(9,\)"),
        (np.full((1, 1), np.nan), ValueError, "coefficients"),
        ("many", TypeError, "coefficients"),
    ],
)
def test_bad_coefficients(coefficients, error, text):
    with pytest.raises(error, match=text):
        cc.CubeMap.from_sh(coefficients)
    with pytest.raises(ValueError, match="size: expected 1 to"):
        cc.CubeMap.from_sh(np.zeros((1, 1)), size=0)
