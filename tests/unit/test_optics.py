"""cc.reflect, cc.refract, cc.fresnel and cc.schlick: the laws of optics, the reference, shapes, types and errors."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised

UP = (0.0, 1.0, 0.0)
ETAS = (1 / 1.52, 1 / 1.33, 1.0, 1.33, 2.4)
etas = pytest.mark.parametrize("eta", ETAS)


def at(degrees):
    """Directions towards a floor, at angles of incidence."""
    angle = np.radians(degrees)
    return np.stack([np.sin(angle), -np.cos(angle), np.zeros_like(angle)], axis=-1)


def pairs(rng, count=400):
    """Random directions of length 1, and normals on the side that they come from."""
    incident, normal = normalised(rng.normal(size=(2, count, 3)))
    facing = np.where(shading.dot(incident, normal) > 0, -normal, normal)
    return incident, facing


# --- reflect


def test_reflect_is_the_reference(rng):
    incident, normal = pairs(rng)
    np.testing.assert_allclose(
        cc.reflect(3 * incident, normal), shading.reflect(3 * incident, normal), atol=1e-14
    )


def test_angles_of_incidence_and_reflection_are_equal(rng):
    incident, normal = pairs(rng)
    away = cc.reflect(incident, normal)
    np.testing.assert_allclose((away * normal).sum(-1), -(incident * normal).sum(-1), atol=1e-14)
    # The three directions lie in a plane, and a second reflection gives the first direction back.
    np.testing.assert_allclose((np.cross(incident, normal) * away).sum(-1), 0, rtol=0, atol=1e-14)
    np.testing.assert_allclose(cc.reflect(away, normal), incident, atol=1e-14)
    np.testing.assert_allclose(cc.reflect(incident, -normal), away, atol=1e-14)


def test_where_nothing_was_drawn_a_direction_stays():
    assert cc.reflect((1.0, 2.0, 3.0), (0, 0, 0)).tolist() == [1, 2, 3]


# --- refract


@etas
def test_refract_is_the_reference(eta, rng):
    incident, normal = pairs(rng)
    np.testing.assert_allclose(
        cc.refract(incident, normal, eta), shading.refract(incident, normal, eta), atol=1e-14
    )


@etas
def test_snell(eta, rng):
    """n_outside sin_i = n_inside sin_t, in the plane of incidence, on the other side of the surface."""
    incident, normal = pairs(rng)
    bent = cc.refract(incident, normal, eta)
    through = bent.any(axis=-1)
    assert through.any()
    np.testing.assert_allclose(np.linalg.norm(bent[through], axis=-1), 1, atol=1e-14)
    sine_i = np.linalg.norm(np.cross(incident, normal), axis=-1)
    sine_t = np.linalg.norm(np.cross(bent, normal), axis=-1)
    np.testing.assert_allclose(sine_t[through], eta * sine_i[through], atol=1e-13)
    assert ((bent * normal).sum(-1)[through] <= 0).all()
    np.testing.assert_allclose((np.cross(incident, normal) * bent).sum(-1), 0, rtol=0, atol=1e-14)


def test_light_finds_its_way_back(rng):
    incident, normal = pairs(rng)
    inside = cc.refract(incident, normal, 1 / 1.52)
    back = cc.refract(-inside, -normal, 1.52)
    np.testing.assert_allclose(back, -incident, atol=1e-13)


def test_total_reflection_begins_at_the_critical_angle():
    critical = np.degrees(np.arcsin(1 / 1.52))
    below, above = at(critical - 1e-4), at(critical + 1e-4)
    assert cc.refract(below, UP, 1.52).any()
    assert not cc.refract(above, UP, 1.52).any()
    assert cc.fresnel(above, UP, 1.52) == 1
    assert 0.9 < cc.fresnel(below, UP, 1.52) < 1
    assert cc.refract(above, UP, 1 / 1.52).any()  # never from air into glass


def test_eta_1_changes_nothing(rng):
    incident, normal = pairs(rng)
    np.testing.assert_allclose(cc.refract(incident, normal, 1), incident, atol=1e-14)
    np.testing.assert_allclose(cc.fresnel(incident, normal, 1), 0, atol=1e-14)
    assert cc.fresnel((1, 0, 0), UP, 1) == 0


# --- fresnel


@etas
def test_fresnel_is_the_reference(eta, rng):
    incident, normal = pairs(rng)
    cosine = -(incident * normal).sum(-1)
    np.testing.assert_allclose(
        cc.fresnel(incident, normal, eta), shading.fresnel_dielectric(cosine, eta), atol=1e-13
    )


@pytest.mark.parametrize("index", [1.33, 1.52, 2.4])
def test_head_on_and_grazing(index):
    want = ((index - 1) / (index + 1)) ** 2
    for eta in (index, 1 / index):
        assert cc.fresnel(at(0.0), UP, eta) == pytest.approx(want, abs=1e-15)
        assert cc.fresnel((1, 0, 0), UP, eta) == 1
        assert cc.fresnel((0, 1, 0), UP, eta) == 1  # from behind, as a grazing angle


@etas
def test_energy_is_conserved(eta, rng):
    """What is reflected and what goes through, by the amplitudes of the waves, is all the light."""
    incident, normal = pairs(rng)
    cos_i = -(incident * normal).sum(-1)
    bent = cc.refract(incident, normal, eta)
    through = bent.any(axis=-1)
    cos_i, cos_t = cos_i[through], -(bent * normal).sum(-1)[through]
    # Born and Wolf, section 1.5.2, equations 20: transmitted amplitudes, for n_outside = eta and n_inside = 1.
    t_s = 2 * eta * cos_i / (eta * cos_i + cos_t)
    t_p = 2 * eta * cos_i / (cos_i + eta * cos_t)
    transmitted = cos_t / (eta * cos_i) * (t_s**2 + t_p**2) / 2
    share = cc.fresnel(incident, normal, eta)
    np.testing.assert_allclose(share[through] + transmitted, 1, atol=1e-13)
    assert (share[~through] == 1).all()


@etas
def test_both_directions_reflect_the_same_share(eta, rng):
    incident, normal = pairs(rng)
    bent = cc.refract(incident, normal, eta)
    through = bent.any(axis=-1)
    back = cc.fresnel(-bent[through], -normal[through], 1 / eta)
    np.testing.assert_allclose(back, cc.fresnel(incident[through], normal[through], eta), atol=1e-9)


@pytest.mark.parametrize("index", [1.33, 1.52, 2.4])
def test_brewster(index):
    """At Brewster's angle one polarisation is not reflected, and the two rays are at a right angle."""
    ray = at(np.degrees(np.arctan(index)))
    mirrored, bent = cc.reflect(ray, UP), cc.refract(ray, UP, 1 / index)
    assert mirrored @ bent == pytest.approx(0, abs=1e-14)
    r_s = (1 - index**2) / (1 + index**2)
    assert cc.fresnel(ray, UP, 1 / index) == pytest.approx(r_s**2 / 2, abs=1e-15)


# --- schlick


@pytest.mark.parametrize("f0", [0.0, 0.04, 0.6, 1.0])
def test_schlick_is_the_reference(f0, rng):
    incident, normal = pairs(rng)
    cosine = -(incident * normal).sum(-1)
    np.testing.assert_allclose(
        cc.schlick(incident, normal, f0), shading.schlick(f0, cosine), atol=1e-14
    )
    assert cc.schlick((0, 1, 0), UP, f0) == 1  # from behind, as a grazing angle


def test_schlick_is_near_fresnel():
    angles = at(np.linspace(0, 90, 91))
    exact = cc.fresnel(angles, UP, 1 / 1.5)
    near = cc.schlick(angles, UP, 0.04)
    assert 0.001 < np.abs(exact - near).max() < 0.06


# --- shapes, types, errors

WITH_NUMBER = {
    "refract": (cc.refract, 0.7, (3,)),
    "fresnel": (cc.fresnel, 0.7, ()),
    "schlick": (cc.schlick, 0.7, ()),
}


@pytest.mark.parametrize(("function", "number", "tail"), WITH_NUMBER.values(), ids=WITH_NUMBER)
def test_shapes_are_broadcast(function, number, tail, rng):
    incident, normal = (part.reshape(2, 1, 5, 3) for part in pairs(rng, 10))
    assert cc.reflect(incident, UP).shape == (2, 1, 5, 3)
    assert cc.reflect(UP, normal).shape == (2, 1, 5, 3)
    assert function(incident, normal, number).shape == (2, 1, 5, *tail)
    numbers = np.linspace(0.5, 0.9, 4).reshape(4, 1)
    many = function(incident, normal, numbers)
    assert many.shape == (2, 4, 5, *tail)
    for index, one in enumerate(numbers[:, 0]):
        np.testing.assert_array_equal(many[:, index], function(incident, normal, one)[:, 0])
    # Three indices of refraction, one for each primary colour.
    assert function(at(30.0), UP, (0.65, 0.66, 0.67)).shape == (3, *tail)
    assert function(np.zeros((0, 3)), UP, number).shape == (0, *tail)


@pytest.mark.parametrize(("function", "number", "tail"), WITH_NUMBER.values(), ids=WITH_NUMBER)
def test_types(function, number, tail, rng):
    incident, normal = pairs(rng)
    exact = function(incident, normal, number)
    assert exact.dtype == np.float64
    single = [part.astype(np.float32) for part in (incident, normal)]
    for factor in (number, np.float64(number), np.array(number)):
        result = function(*single, factor)
        assert result.dtype == np.float32
        np.testing.assert_allclose(result, exact, atol=2e-5)
    assert function(single[0], UP, number).dtype == np.float32  # a tuple has no type of its own
    assert function(single[0], normal, number).dtype == np.float64
    assert function(incident.astype(np.float16), UP, number).dtype == np.float64
    assert function((0, -1, 0), (0, 1, 0), 1).dtype == np.float64
    assert cc.reflect(*single).dtype == np.float32
    assert cc.reflect(np.array([1, -1, 0]), np.array([0, 1, 0])).tolist() == [1, 1, 0]


def test_arguments_stay_as_they_are():
    incident, normal = at(40.0), np.array(UP)
    before = incident.copy(), normal.copy()
    cc.refract(incident, normal, 1)[:] = 5
    cc.reflect(incident, normal)[:] = 5
    assert (incident == before[0]).all()
    assert (normal == before[1]).all()


BAD = {
    "shape": (
        lambda: cc.reflect((1, 2), UP),
        ValueError,
        r"^incident: expected shape \(..., 3\), got \(2,\)$",
    ),
    "a number": (lambda: cc.reflect(1, UP), ValueError, r"got \(\)$"),
    "normal": (
        lambda: cc.fresnel(UP, np.zeros((4, 4)), 1),
        ValueError,
        r"^normal: expected shape \(..., 3\), got \(4, 4\)$",
    ),
    "pairs": (
        lambda: cc.reflect(np.zeros((4, 3)), np.zeros((5, 3))),
        ValueError,
        r"^normal: expected a shape that can be broadcast with \(4, 3\), got \(5, 3\)$",
    ),
    "etas": (
        lambda: cc.refract(np.zeros((4, 3)), UP, (1, 2)),
        ValueError,
        r"^eta: expected a shape that can be broadcast with \(4,\), got \(2,\)$",
    ),
    "ragged": (lambda: cc.reflect([(1, 2, 3), (1, 2)], UP), ValueError, "^incident: expected an"),
    "text": (lambda: cc.reflect("up", UP), TypeError, "^incident: expected real numbers, got str$"),
    "complex": (lambda: cc.reflect(UP, (1j, 0, 0)), TypeError, "^normal: .*got dtype complex128$"),
    "mask": (
        lambda: cc.fresnel(UP, UP, True),
        TypeError,
        "^eta: expected real numbers, got dtype bool",
    ),
    "eta 0": (
        lambda: cc.refract(UP, UP, 0),
        ValueError,
        r"^eta: expected finite numbers above 0, got 0\.0$",
    ),
    "eta below 0": (lambda: cc.fresnel(UP, UP, (1, -2)), ValueError, r"got -2\.0$"),
    "eta nan": (lambda: cc.fresnel(UP, UP, np.nan), ValueError, "got nan$"),
    "f0": (
        lambda: cc.schlick(UP, UP, 1.5),
        ValueError,
        r"^f0: expected numbers from 0 to 1, got 1\.5$",
    ),
    "misspelt": (
        lambda: cc.refract(UP, UP, ior=1.5),  # type: ignore[call-arg]
        TypeError,
        r"^refract\(\) has no option 'ior'; it takes incident, normal, eta$",
    ),
    "missing": (lambda: cc.refract(UP), TypeError, r"^refract\(\) needs normal and eta$"),  # type: ignore[call-arg]
}


@pytest.mark.parametrize(("call", "kind", "message"), BAD.values(), ids=BAD)
def test_bad_input(call, kind, message):
    with pytest.raises(kind, match=message):
        call()
