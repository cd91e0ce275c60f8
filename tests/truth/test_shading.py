import numpy as np
import pytest

from cubecam.truth import shading
from cubecam.truth.shading import Ambient, Directional, Point, normalised
from tests.reference import tone
from tests.reference.compositing import composite, over


def test_reflection_keeps_the_angle(rng):
    incident, normal = normalised(rng.normal(size=(2, 100, 3)))
    out = shading.reflect(incident, normal)
    np.testing.assert_allclose(shading.dot(out, normal), -shading.dot(incident, normal), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(out, axis=-1), 1)


def test_refraction_obeys_snell(rng):
    normal = normalised(rng.normal(size=(100, 3)))
    incident = normalised(rng.normal(size=(100, 3)))
    incident = np.where(shading.dot(incident, normal) > 0, -incident, incident)
    out = shading.refract(incident, normal, 1 / 1.52)
    np.testing.assert_allclose(np.linalg.norm(out, axis=-1), 1)
    sines = (
        np.linalg.norm(np.cross(incident, normal), axis=-1),
        np.linalg.norm(np.cross(out, normal), axis=-1),
    )
    np.testing.assert_allclose(sines[0], 1.52 * sines[1], atol=1e-12)
    assert (shading.dot(out, normal) < 0).all()


def test_total_reflection():
    incident = normalised(np.array([[1, -0.2, 0]]))
    normal = np.array([[0, 1.0, 0]])
    assert not shading.refract(incident, normal, 1.52).any()
    assert shading.fresnel_dielectric(-shading.dot(incident, normal), 1.52) == 1


def test_fresnel_at_normal_and_grazing_incidence_and_brewster():
    f0 = ((1.52 - 1) / (1.52 + 1)) ** 2
    assert shading.fresnel_dielectric(1.0, 1 / 1.52) == pytest.approx(f0)
    assert shading.fresnel_dielectric(0.0, 1 / 1.52) == 1
    brewster = np.cos(np.arctan(1.52))
    c_t = np.sqrt(1 - (1 - brewster**2) / 1.52**2)
    perpendicular = ((brewster - 1.52 * c_t) / (brewster + 1.52 * c_t)) ** 2
    assert shading.fresnel_dielectric(brewster, 1 / 1.52) == pytest.approx(perpendicular / 2)
    assert shading.schlick(0.04, 1.0) == pytest.approx(0.04)
    assert shading.schlick(0.04, 0.0) == 1


def test_phong_by_hand():
    """With the light straight above and the eye 60 degrees off, diffuse is 1 and specular is cos(60)^2."""
    position, normal = np.array([[0, 0, 0.0]]), np.array([[0, 1.0, 0]])
    eye = (np.sin(np.pi / 3), np.cos(np.pi / 3), 0)
    color = (0.5, 0.25, 1)
    got = shading.phong(position, normal, eye, color, [Point((0, 9, 0))], shininess=2)
    np.testing.assert_allclose(got[0], np.array(color) * 0.9 + 0.25)
    below = shading.phong(position, normal, eye, color, [Point((0, -9, 0))])
    np.testing.assert_allclose(below[0], np.array(color) * 0.2)
    falloff = shading.phong(
        position, normal, eye, color, [Point((0, 2, 0), intensity=8, decay=2)], shininess=2
    )
    np.testing.assert_allclose(falloff[0], np.array(color) * (0.2 + 1.4) + 0.5)
    sun = shading.phong(position, normal, eye, color, [Directional((0, -3, 0))], shininess=2)
    np.testing.assert_allclose(sun, got)
    sky = shading.phong(position, normal, eye, color, [Ambient(intensity=0.5)])
    np.testing.assert_allclose(sky[0], np.array(color) * 0.3)


def test_tone_curves():
    assert tone.reinhard(1.0) == 0.5
    assert tone.aces(0.0) == 0
    assert tone.aces(1e6) == 1
    grey = tone.neutral(np.full(3, 0.5))
    np.testing.assert_allclose(grey, 0.46)  # below the shoulder only the toe's .04 is subtracted
    bright = tone.neutral(np.array([50.0, 1.0, 1.0]))
    assert (bright <= 1).all()
    assert bright[1] > 0.3  # bright colours lose saturation
    hdr = tone.neutral(np.linspace(0, 100, 5000)[:, None] * np.ones(3))
    assert (np.diff(hdr, axis=0) >= 0).all()


def test_srgb_round_trip_and_known_values():
    x = np.linspace(0, 1, 1001)
    np.testing.assert_allclose(tone.srgb_decode(tone.srgb_encode(x)), x, atol=1e-7)
    assert tone.srgb_encode(0.5) == pytest.approx(0.7353569830524495)
    assert tone.srgb_decode(np.float64(128 / 255)) == pytest.approx(0.21586050011389926)


def test_source_over():
    np.testing.assert_allclose(over([1, 0, 0, 0.25], [0, 0, 1, 1]), [0.25, 0, 0.75, 1])
    np.testing.assert_allclose(over([1, 0, 0, 0.5], [0, 0, 0, 0]), [0.5, 0, 0, 0.5])
    two = composite([0, 0, 0, 0], [1, 1, 1, 0.5], [0, 0, 0, 0.5])
    np.testing.assert_allclose(two, [0.25, 0.25, 0.25, 0.75])
