"""The BSDF of StandardMaterial for paths: values against the sums for lights, densities and samples against values."""

from typing import Any

import numpy as np
import pytest

from cubecam.truth.bsdf.standard import StandardBsdf, evaluate, extinction, pdf, sample
from cubecam.truth.shading import dot, normalised
from cubecam.truth.shading.standard.material import Parameters, Surface
from cubecam.truth.shading.standard.microfacets import mix, schlick
from cubecam.truth.shading.standard.shade import Fresnel, facing, lit_base, lit_coat, scattered
from cubecam.truth.shading.standard.tables import brdf_terms

from .bsdf_cases import ROUGH, UP, all_directions, parameters, random_unit, surface_of, view


def numbers(rng, count):
    return rng.random((count, 3))


def any_parameters(rng, count, **changes):
    """Everything at once, different at each point."""

    def scalars(low=0.0, high=1.0):
        return rng.uniform(low, high, (count, 1))

    def few(*values):
        return rng.choice(values, (count, 1))

    values = {
        "color": rng.random((count, 3)),
        "metallic": scalars(),
        "roughness": few(1 / 32, 0.2, 0.6, 1),
        "ior": scalars(1, 2.5),
        "specular_weight": scalars(),
        "specular_color": rng.random((count, 3)),
        "clearcoat": few(0, 0.5, 1),
        "clearcoat_roughness": few(1 / 32, 0.3),
        "sheen_color": rng.random((count, 3)) * few(0, 1),
        "sheen_roughness": few(0.3, 0.8),
        "iridescence": few(0, 1),
        "anisotropy": few(0, 0.5, 1),
        "anisotropy_direction": normalised(rng.normal(size=(count, 2))),
        "transmission": few(0, 0.4, 1),
    }
    return Parameters(**{**values, **changes})


def any_surface(rng, count):
    """Views from above the geometric normals; mapped normals, some of which turn away from the viewer."""
    geometric_n, v = random_unit(rng, count), random_unit(rng, count)
    v = np.where(dot(geometric_n, v) < 0, -v, v)
    n, coat_n = (normalised(geometric_n + 0.4 * random_unit(rng, count)) for _ in range(2))
    tangent = np.concatenate(
        [normalised(np.cross(geometric_n, (1, 2, 3))), rng.choice([-1.0, 1.0], (count, 1))], -1
    )
    return Surface(np.zeros((count, 3)), v, geometric_n, n, coat_n, tangent)


def test_values_are_the_sums_for_lights():
    rng = np.random.default_rng(1)
    count = 3000
    # All light that enters goes through: the diffuse base has a test of its own.
    p = any_parameters(rng, count, multiple_scattering=False, transmission=1.0)
    surface = any_surface(rng, count)
    l = random_unit(rng, count)  # noqa: E741
    l = np.where(dot(surface.geometric_n, l) < 0, -l, l)  # noqa: E741
    share = p.clearcoat * schlick(0.04, 1.0, facing(surface.clearcoat_n, surface.v))
    want = mix(lit_base(p, surface, l), lit_coat(p, surface, l), share)
    got = evaluate(p, surface, l)
    np.testing.assert_allclose(got, want, rtol=1e-9, atol=1e-12)
    assert (got > 0).mean() > 0.5
    assert not evaluate(p, surface, l - 2 * dot(surface.geometric_n, l) * surface.geometric_n).any()


@pytest.mark.parametrize("several", [False, True])
def test_the_diffuse_base_gets_what_the_lobe_leaves(several):
    """(1 - max3(Fss + Fms)) color / pi, as in the renderer's environment; without a lobe for one direction alone."""
    v, l = view(0.3), view(0.6, 2.5)  # noqa: E741
    values: dict[str, Any] = {"metallic": 0.25, "roughness": 0.7, "ior": 2.0}
    surface = surface_of(v, 1)
    black, colour = (
        evaluate(
            Parameters(color=c, transmission=0.5, multiple_scattering=several, **values),
            surface,
            l[None],
        )
        for c in ((0.0, 0.0, 0.0), (0.8, 0.5, 0.2))
    )
    metal = [
        evaluate(
            Parameters(color=c, multiple_scattering=several, **{**values, "metallic": 1.0}),
            surface,
            l[None],
        )
        for c in ((0.0, 0.0, 0.0), (0.8, 0.5, 0.2))
    ]
    a, b = brdf_terms(np.array([0.3]), np.array([0.7]))[0]
    fss, fms = scattered(Fresnel(np.full(3, 1 / 9), 1.0), a, b)
    left = 1 - (fss + fms * several).max()
    want = 0.75 * 0.5 * np.array([0.8, 0.5, 0.2]) * left / np.pi * 0.6 + 0.25 * (
        metal[1] - metal[0]
    )
    np.testing.assert_allclose(colour - black, want, rtol=1e-6)


def test_points_do_not_know_each_other():
    rng = np.random.default_rng(2)
    p, surface = any_parameters(rng, 24), any_surface(rng, 24)
    u, l = numbers(rng, 24), random_unit(rng, 24)  # noqa: E741
    together = sample(p, surface, u)
    value, density = evaluate(p, surface, l), pdf(p, surface, l)

    def row(x, i):
        return x[i : i + 1] if isinstance(x, np.ndarray) and len(x) == 24 else x

    for i in range(24):
        alone_p = Parameters(**{k: row(x, i) for k, x in vars(p).items()})
        alone = Surface(**{k: row(x, i) for k, x in vars(surface).items()})
        np.testing.assert_allclose(evaluate(alone_p, alone, row(l, i)), row(value, i), rtol=1e-9)
        np.testing.assert_allclose(pdf(alone_p, alone, row(l, i)), row(density, i), rtol=1e-9)
        drawn = sample(alone_p, alone, row(u, i))
        np.testing.assert_allclose(drawn.l, row(together.l, i), atol=1e-9)
        np.testing.assert_allclose(drawn.weight, row(together.weight, i), rtol=1e-6)


@pytest.mark.parametrize("cosine", [0.15, 0.8])
@pytest.mark.parametrize("name", ROUGH)
def test_densities_have_a_sum_of_one(name, cosine):
    l, angle = all_directions()  # noqa: E741
    bsdf = StandardBsdf(parameters(name), surface_of(view(cosine), len(l)))
    through = bsdf.shares[0, -1]
    assert (bsdf.pdf(l) * angle).sum() == pytest.approx(1 - through, abs=3e-3)
    assert (through > 0) == ("transmission" in ROUGH[name])


@pytest.mark.parametrize("cosine", [0.15, 0.8])
@pytest.mark.parametrize("name", ROUGH)
def test_mean_weights_are_the_albedo(name, cosine):
    """The same integral by a sum over all directions and by samples; 4 standard errors."""
    l, angle = all_directions()  # noqa: E741
    p, count = parameters(name), 20_000
    want = (evaluate(p, surface_of(view(cosine), len(l)), l) * angle).sum(0)
    rng = np.random.default_rng(3)
    got = sample(p, surface_of(view(cosine), count), numbers(rng, count))
    weight = np.where(got.transmitted[:, None], 0.0, got.weight)
    error = weight.std(0) / np.sqrt(count)
    assert not got.delta.any()
    assert (abs(weight.mean(0) - want) < 4 * error + 1e-4).all()
    assert (error < 0.02).all()
    assert got.weight.max() < 12


def test_weights_are_values_over_densities():
    rng = np.random.default_rng(4)
    p, surface = any_parameters(rng, 4000), any_surface(rng, 4000)
    got = sample(p, surface, numbers(rng, 4000))
    np.testing.assert_allclose(np.linalg.norm(got.l, axis=-1), 1, atol=1e-12)
    rows = ~got.delta & ~got.transmitted
    density, value = pdf(p, surface, got.l), evaluate(p, surface, got.l)
    assert (density[rows] > 0).all()
    np.testing.assert_allclose(got.pdf[rows], density[rows], rtol=1e-9)
    np.testing.assert_allclose((got.weight * density)[rows], value[rows], rtol=1e-9, atol=1e-12)
    assert (got.pdf[~rows] == 0).all()
    assert rows.mean() > 0.5
    assert got.transmitted.mean() > 0.1


def test_the_last_number_below_one_draws_a_lobe_that_scatters():
    """Sums of shares may round to less than 1; the lobe behind the last one would lead through a metal."""
    rng = np.random.default_rng(12)
    p = any_parameters(rng, 500, transmission=0.0, sheen_color=(0, 0, 0))
    surface = any_surface(rng, 500)
    ends = StandardBsdf(p, surface).shares.cumsum(-1)[:, -1]
    assert (ends < 1).any()
    u = numbers(rng, 500)
    u[:, 2] = np.nextafter(1, 0)
    got = sample(p, surface, u)
    assert not got.transmitted.any()
    assert np.isfinite(got.weight).all()


@pytest.mark.parametrize("roughness", [0.3, 0.6, 1.0])
def test_a_white_metal_loses_no_light(roughness):
    """With the light that facets pass to each other; without it, rough metals darken."""
    rng = np.random.default_rng(5)
    count = 30_000
    for cosine in (0.2, 0.6, 1.0):
        surface = surface_of(view(cosine), count)
        means = [
            sample(Parameters(roughness=roughness, multiple_scattering=several), surface, u).weight
            for several in (True, False)
            for u in [numbers(rng, count)]
        ]
        assert means[0].mean() == pytest.approx(1, abs=0.01)
        if roughness == 1:
            assert means[1].mean() < 0.75


def test_what_plastic_facets_pass_to_each_other_does_not_reach_the_base():
    """Fms / pi more, and max3(Fms) of the base's colour less; A and B of the split sum give Fms."""
    l = view(0.7, 2.0)[None]  # noqa: E741
    surface = surface_of(view(0.5), 1)
    values: dict[str, Any] = {
        "color": (0.8, 0.5, 0.2),
        "metallic": 0.0,
        "roughness": 0.9,
        "ior": 4.0,
    }
    alone, together = (
        evaluate(Parameters(**values, multiple_scattering=several), surface, l)
        for several in (False, True)
    )
    a, b = brdf_terms(np.array([0.5]), np.array([0.9]))[0]
    _, several = scattered(Fresnel(np.full(3, 0.36), 1.0), a, b)
    want = (several - several.max() * np.array(values["color"])) / np.pi * 0.7
    assert several.max() > 0.01
    np.testing.assert_allclose(together - alone, want[None], rtol=1e-9)


def test_a_white_plastic_gives_no_more_light_than_it_got():
    rng = np.random.default_rng(6)
    count = 20_000
    for cosine in (0.05, 0.3, 0.7, 1.0):
        surface = surface_of(view(cosine), count)
        for roughness in (0.0, 0.3, 1.0):
            p = Parameters(metallic=0.0, roughness=roughness)
            mean = sample(p, surface, numbers(rng, count)).weight.mean()
            assert mean == pytest.approx(1, abs=0.015), (cosine, roughness)


def test_light_takes_the_same_share_both_ways():
    """Reciprocity (Helmholtz) of single scattering."""
    rng = np.random.default_rng(7)
    count = 1000
    p = any_parameters(
        rng,
        count,
        multiple_scattering=False,
        sheen_color=(0, 0, 0),
        clearcoat=0.0,
        transmission=1.0,
    )
    surface = any_surface(rng, count)
    surface.n = surface.geometric_n
    l = random_unit(rng, count)  # noqa: E741
    l = np.where(dot(surface.n, l) < 0, -l, l)  # noqa: E741
    back = Surface(surface.position, l, surface.n, tangent=surface.tangent)
    there = evaluate(p, surface, l) / dot(surface.n, l)
    np.testing.assert_allclose(
        there, evaluate(p, back, surface.v) / dot(surface.n, surface.v), rtol=1e-9
    )


@pytest.mark.parametrize("name", ["metal", "anisotropic", "coat", "sheen", "all"])
def test_directions_have_the_density(name):
    """Pearson's chi-square over cells of equal solid angle, the expected counts by sums over 16 x 16 points each."""
    cells, inside, count = (16, 16), 16, 40_000
    bounds = [(np.arange(c * inside) + 0.5) / (c * inside) for c in cells]
    grid = np.meshgrid(2 * bounds[0] - 1, 2 * np.pi * bounds[1], indexing="ij")
    z, phi = (x.ravel() for x in grid)
    l = np.stack([np.sqrt(1 - z**2) * np.cos(phi), np.sqrt(1 - z**2) * np.sin(phi), z], -1)  # noqa: E741
    p, v = parameters(name), view(0.6)
    density = pdf(p, surface_of(v, len(l)), l).reshape(cells[0], inside, cells[1], inside)
    want = density.mean((1, 3)) * 4 * np.pi / np.prod(cells) * count

    rng = np.random.default_rng(8)
    got = sample(p, surface_of(v, count), numbers(rng, count))
    l = got.l[~got.transmitted]  # noqa: E741
    row = ((l[:, 2] + 1) / 2 * cells[0]).astype(int)
    column = (np.arctan2(l[:, 1], l[:, 0]) / (2 * np.pi) % 1 * cells[1]).astype(int)
    found = np.zeros(cells)
    np.add.at(found, (np.minimum(row, cells[0] - 1), column), 1)
    used = want > 8
    freedom = used.sum()
    chi = ((found - want)[used] ** 2 / want[used]).sum()
    assert freedom > 40
    assert chi < freedom + 4 * np.sqrt(2 * freedom)
    assert abs(found[~used].sum() - want[~used].sum()) < 6 * np.sqrt(want[~used].sum() + 1)


def test_smooth_layers_are_mirrors():
    """A smooth metal reflects its colour; under a smooth coat, what the coat leaves of it."""
    rng = np.random.default_rng(9)
    count, cosine = 20_000, 0.7
    surface = surface_of(view(cosine), count)
    color = np.array([0.9, 0.5, 0.2])
    f = color + (1 - color) * (1 - cosine) ** 5

    got = sample(
        Parameters(color, roughness=0.0, multiple_scattering=False), surface, numbers(rng, count)
    )
    assert got.delta.all()
    np.testing.assert_allclose(got.weight, np.broadcast_to(f, (count, 3)), rtol=1e-12)
    np.testing.assert_allclose(got.l, surface.v * (-1, -1, 1), atol=1e-12)
    assert not evaluate(
        Parameters(color, roughness=0.0, multiple_scattering=False), surface, got.l
    ).any()

    coat = 0.04 + 0.96 * (1 - cosine) ** 5
    p = Parameters(color, roughness=0.0, clearcoat=1.0, multiple_scattering=False)
    got = sample(p, surface, numbers(rng, count))
    np.testing.assert_allclose(got.weight.mean(0), f * (1 - coat) + coat, rtol=5e-3)

    # A mapped normal turns the mirror, and a mirrored direction below the surface ends the path.
    tilted = surface_of(view(0.3, 0.0), 100, n=normalised((-0.6, 0, 0.8)))
    got = sample(
        Parameters(color, roughness=0.0, multiple_scattering=False), tilted, numbers(rng, 100)
    )
    np.testing.assert_allclose(got.l, 2 * dot(tilted.n, tilted.v) * tilted.n - tilted.v, atol=1e-12)
    assert (got.weight > 0).all() == (got.l[0] @ UP > 0)


def test_extinction_is_the_colour_after_the_distance():
    p = Parameters(attenuation_color=(0.9, 0.5, 0.0), attenuation_distance=2.5)
    kept = np.exp(-extinction(p) * np.array([[0.0], [2.5], [5.0]]))
    want = np.array([[1, 1, 1], [0.9, 0.5, 0], [0.81, 0.25, 0]])
    np.testing.assert_allclose(kept, want, atol=1e-12)
    assert not extinction(Parameters(attenuation_color=(0.5, 0, 1))).any()
