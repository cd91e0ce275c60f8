"""Light that goes through StandardMaterial: thin walls, bodies, dispersion, and the way out of a body."""

from typing import Any

import numpy as np
import pytest

from cubecam.truth.bsdf.standard import sample, sample_exit
from cubecam.truth.shading import dot, normalised
from cubecam.truth.shading.standard.material import Parameters, Surface
from cubecam.truth.shading.standard.tables import brdf_terms, sheen_albedo

from .bsdf_cases import UP, random_unit, surface_of, view

CLEAR: dict[str, Any] = {
    "metallic": 0.0,
    "transmission": 1.0,
    "roughness": 0.0,
    "multiple_scattering": False,
}


def numbers(rng, count):
    return rng.random((count, 3))


def schlick(ior, cosine):
    f0 = ((ior - 1) / (ior + 1)) ** 2
    return f0 + (1 - f0) * (1 - cosine) ** 5


def test_a_thin_smooth_wall_does_not_bend_light():
    rng = np.random.default_rng(1)
    count, cosine, color = 20_000, 0.5, np.array([0.9, 0.6, 0.3])
    surface = surface_of(view(cosine), count)
    got = sample(Parameters(color, **CLEAR), surface, numbers(rng, count))
    assert got.delta.all()
    np.testing.assert_allclose(got.l[got.transmitted], -surface.v[got.transmitted], atol=1e-12)
    through = np.where(got.transmitted[:, None], got.weight, 0)
    f = schlick(1.5, cosine)
    error = through.std(0) / np.sqrt(count)
    assert (abs(through.mean(0) - color * (1 - f)) < 4 * error).all()
    np.testing.assert_allclose((got.weight - through).mean(0), f, rtol=0.1)


def test_sheen_and_coat_take_their_share_before():
    rng = np.random.default_rng(9)
    count, cosine = 20_000, 0.5
    p = Parameters(**CLEAR, clearcoat=0.8, sheen_color=(0.9, 0.5, 0.2), sheen_roughness=0.8)
    got = sample(p, surface_of(view(cosine), count), numbers(rng, count))
    through = np.where(got.transmitted[:, None], got.weight, 0)
    f = schlick(1.5, cosine)
    sheen = 0.9 * sheen_albedo(np.array([cosine]), np.array([0.8]))[0]
    want = (1 - f) * (1 - 0.8 * f) * (1 - sheen)
    assert sheen > 0.1
    assert (abs(through.mean(0) - want) < 4 * through.std(0) / np.sqrt(count)).all()


@pytest.mark.parametrize("roughness", [0.3, 0.8])
def test_a_thin_rough_wall_blurs_as_much_as_it_reflects(roughness):
    """The lobe is the reflection's, mirrored; its sum follows from A and B of the split sum with 1 - F for F."""
    rng = np.random.default_rng(2)
    count, cosine = 30_000, 0.6
    p = Parameters(**{**CLEAR, "roughness": roughness})
    got = sample(p, surface_of(view(cosine), count), numbers(rng, count))
    rows = got.transmitted
    assert not got.delta.any()
    assert (got.l[rows & got.weight.any(-1)] @ UP < 0).all()
    a, b = brdf_terms(np.array([cosine]), np.array([roughness]))[0]
    through = np.where(rows[:, None], got.weight, 0)
    want = (a + b) - (0.04 * a + b)
    assert abs(through.mean() - want) < 4 * through[:, 0].std() / np.sqrt(count) + 1e-3
    assert (got.pdf[rows] == 0).all()


def test_refraction_obeys_snell():
    """n sin is the same on both sides, in one plane with the normal."""
    rng = np.random.default_rng(3)
    count = 500
    n, v = random_unit(rng, count), random_unit(rng, count)
    v = np.where(dot(n, v) < 0, -v, v)
    ior = rng.uniform(1.05, 2.5, (count, 1))
    p = Parameters(**CLEAR, ior=ior, thickness=1.0)
    got = sample(p, Surface(np.zeros((count, 3)), v, n), numbers(rng, count))
    rows = got.transmitted
    assert rows.sum() > 100
    np.testing.assert_allclose(
        np.cross(n, ior * got.l)[rows], np.cross(n, -v)[rows], rtol=1e-9, atol=1e-12
    )
    assert (dot(n, got.l)[rows] < 0).all()
    assert (dot(n, got.l)[~rows] > 0).all()


def test_rough_bodies_refract_about_facets():
    """Walter et al. 2007, equation 16: -(v + ior l) points along the facet, whose distribution has the right width."""
    rng = np.random.default_rng(4)
    count, ior = 20_000, 1.5
    p = Parameters(**{**CLEAR, "roughness": 0.4}, ior=ior, thickness=1.0)
    surface = surface_of(UP, count)
    got = sample(p, surface, numbers(rng, count))
    rows = got.transmitted & got.weight.any(-1)
    h = normalised(-(surface.v + ior * got.l))[rows]
    # Seen along the normal the density of facets is D n.h, whose share within an angle is known.
    tangent = 0.16 * np.sqrt(0.5 / (1 - 0.5))
    inside = (h[:, 2] > 1 / np.sqrt(1 + tangent**2)).mean()
    assert inside == pytest.approx(0.5, abs=0.02)


def test_dispersion_spreads_the_channels():
    rng = np.random.default_rng(5)
    count, cosine, ior, dispersion = 9000, 0.4, 1.6, 3.0
    p = Parameters(**CLEAR, ior=ior, thickness=1.0, dispersion=dispersion)
    surface = surface_of(view(cosine), count)
    got = sample(p, surface, numbers(rng, count))
    rows = got.transmitted
    assert (got.channel[~rows] == -1).all()
    for channel in range(3):
        here = rows & (got.channel == channel)
        assert here.sum() > 700
        index = ior + (channel - 1) * (ior - 1) * 0.025 * dispersion
        sines = np.linalg.norm(got.l[here][:, :2], axis=-1) * index
        np.testing.assert_allclose(sines, np.sqrt(1 - cosine**2), rtol=1e-9)
        assert (np.delete(got.weight[here], channel, axis=1) == 0).all()
    through = np.where(rows[:, None], got.weight, 0)
    error = through.std(0) / np.sqrt(count)
    assert (abs(through.mean(0) - (1 - schlick(ior, cosine))) < 4 * error).all()

    # A path that carries one channel already keeps it, with its index, and loses nothing.
    again = sample(p, surface, numbers(rng, count), np.full(count, 2))
    assert (again.channel == 2).all()
    some = again.weight[again.transmitted]
    np.testing.assert_allclose(some, np.broadcast_to(some[:1, :1], some.shape), rtol=1e-12)
    index = ior + (ior - 1) * 0.025 * dispersion
    sines = np.linalg.norm(again.l[again.transmitted][:, :2], axis=-1) * index
    np.testing.assert_allclose(sines, np.sqrt(1 - cosine**2), rtol=1e-9)


def test_light_leaves_a_slab_as_it_came():
    rng = np.random.default_rng(6)
    count = 2000
    v = random_unit(rng, count)
    v[:, 2] = abs(v[:, 2])
    p = Parameters(**CLEAR, ior=1.7, thickness=1.0, dispersion=5.0)
    outside = Surface(np.zeros((count, 3)), v, np.broadcast_to(UP, (count, 3)))
    got = sample(p, outside, numbers(rng, count))
    inside = Surface(outside.position, -got.l, outside.geometric_n)
    out = sample_exit(p, inside, numbers(rng, count), got.channel)
    rows = got.transmitted & out.transmitted
    assert rows.sum() > 1000
    np.testing.assert_allclose(out.l[rows], -v[rows], atol=1e-9)
    # Schlick's curve of the angle outside: the same share goes in and out.
    back = got.transmitted & ~out.transmitted
    share = back.sum() / got.transmitted.sum()
    f = schlick(1.7, v[got.transmitted][:, 2]).mean()
    assert share == pytest.approx(f, abs=0.03)
    np.testing.assert_allclose(out.weight[rows | back], 1, rtol=1e-12)


def test_light_stays_inside_beyond_the_critical_angle():
    rng = np.random.default_rng(7)
    count, ior = 4000, 1.5
    critical = np.sqrt(1 - 1 / ior**2)
    for cosine in (critical - 0.01, critical + 0.01):
        surface = surface_of(view(cosine), count)
        got = sample_exit(Parameters(**CLEAR, ior=ior, thickness=1.0), surface, numbers(rng, count))
        mirrored = surface.v * (-1, -1, 1)
        np.testing.assert_allclose(got.l[~got.transmitted], mirrored[~got.transmitted], atol=1e-12)
        assert got.transmitted.any() == (cosine > critical)
        np.testing.assert_allclose(got.weight, 1, rtol=1e-12)


def test_a_path_of_all_channels_leaves_with_the_middle_index():
    rng = np.random.default_rng(10)
    p = Parameters(**CLEAR, ior=1.6, thickness=1.0, dispersion=5.0)
    got = sample_exit(p, surface_of(view(0.9), 100), numbers(rng, 100))
    sines = np.linalg.norm(got.l[got.transmitted][:, :2], axis=-1)
    np.testing.assert_allclose(sines, 1.6 * np.sqrt(1 - 0.9**2), rtol=1e-9)


def test_a_mapped_normal_sends_nothing_through_the_wrong_side():
    """A mirrored direction that leaves the body, or a bent one that stays in it, ends its path."""
    rng = np.random.default_rng(11)
    count = 4000
    p = Parameters(**{**CLEAR, "roughness": 0.3}, thickness=1.0)
    tilted = surface_of(view(0.5, 0.0), count, n=normalised((-0.3, 0, 0.95)))
    for draw, least in ((sample_exit, 0.1), (sample, 0.01)):
        got = draw(p, tilted, numbers(rng, count))
        wrong = np.where(got.transmitted, 1, -1) * (got.l @ UP) > 0
        assert wrong.mean() > least
        assert not got.weight[wrong].any()
        assert got.weight[~wrong].any()


def test_rough_exits_make_no_light():
    rng = np.random.default_rng(8)
    count = 10_000
    for cosine in (0.3, 0.9):
        p = Parameters(**{**CLEAR, "roughness": 0.5}, thickness=1.0)
        got = sample_exit(p, surface_of(view(cosine), count), numbers(rng, count))
        kept = got.weight.any(-1)
        assert got.weight.max() <= 1
        assert 0.75 < got.weight.mean() <= 1
        assert (np.where(got.transmitted, -1, 1)[kept] * got.l[kept, 2] > 0).all()
