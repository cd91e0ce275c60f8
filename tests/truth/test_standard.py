"""The reference of StandardMaterial against facts: normalisations, furnaces, thin films, sums over a photograph."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cubecam.truth import shading
from cubecam.truth.shading import Ambient, Directional, Point, dot, normalised
from cubecam.truth.shading.standard import microfacets
from cubecam.truth.shading.standard.iridescence import iridescent_fresnel, schlick_to_f0
from cubecam.truth.shading.standard.material import (
    Environment,
    Parameters,
    Surface,
    anisotropy_direction,
    mapped_normal,
    occluded,
)
from cubecam.truth.shading.standard.samples import (
    frame_around,
    hammersley,
    radical_inverse,
    sampled_lobes,
    visible_normal,
)
from cubecam.truth.shading.standard.shade import (
    Fresnel,
    dominant_direction,
    lit_base,
    scattered,
    shade,
)
from cubecam.truth.shading.standard.tables import brdf_terms, sheen_albedo
from tests.reference.cube_faces import unit_texel_directions
from tests.reference.equirect import equirect_to_faces
from tests.reference.lookups import environment_of

FOREST = Path(__file__).parents[2] / "python" / "cubecam" / "data" / "forest.exr"
UP = np.array([0.0, 0.0, 1.0])
ALPHAS = (0.05, 0.2, 0.5, 1.0)


def sphere_of(turns=256, steps=1024, half=True):
    """Unit directions (K, 3) around +Z and their solid angles (K, 1); denser near the pole."""
    edges = np.linspace(0, 1, steps + 1) ** 2 * (np.pi / 2 if half else np.pi)
    theta = (edges[1:] + edges[:-1]) / 2
    phi = 2 * np.pi * (np.arange(turns) + 0.5) / turns
    theta, phi = (a.ravel() for a in np.meshgrid(theta, phi, indexing="ij"))
    directions = np.stack(
        [np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1
    )
    weight = np.repeat(np.cos(edges[:-1]) - np.cos(edges[1:]), turns) * 2 * np.pi / turns
    return directions, weight[:, None]


HEMISPHERE = sphere_of()


def viewer(cosine, turn=0.3):
    sine = np.sqrt(1 - cosine**2)
    return np.array([sine * np.cos(turn), sine * np.sin(turn), cosine])


def surface_of(cosines, **others):
    v = np.stack([viewer(cosine) for cosine in np.atleast_1d(cosines)])
    n = np.broadcast_to(UP, v.shape)
    return Surface(np.zeros(v.shape), v, n, **others)


def constant(value=1.0):
    def light(directions, *_):
        return np.full(np.shape(directions), value)

    return Environment(light, light, light, 64, light)


# --- lobes ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("alpha_t", ALPHAS)
@pytest.mark.parametrize("alpha_b", [0.1, 0.7])
def test_facets_cover_the_surface_and_show_its_projection(alpha_t, alpha_b):
    """Heitz 2014, equations 8 and 19: the areas of facets project to 1, and those that v sees to n.v."""
    h, solid_angle = HEMISPHERE
    density = microfacets.trowbridge_reitz_anisotropic(
        h[:, :1], h[:, 1:2], h[:, 2:], alpha_t, alpha_b
    )
    assert (density * h[:, 2:] * solid_angle).sum() == pytest.approx(1, abs=2e-3)
    for cosine in (0.2, 0.6, 0.95):
        v = viewer(cosine)
        masking = (
            2 * cosine * microfacets.smith_half_anisotropic(v[0], v[1], v[2], alpha_t, alpha_b)
        )
        seen = masking * np.maximum(dot(h, v), 0) * density * solid_angle
        assert seen.sum() == pytest.approx(cosine, rel=5e-3)


@pytest.mark.parametrize("alpha", ALPHAS)
def test_the_isotropic_lobe_is_the_anisotropic_one_with_equal_alphas(alpha, rng):
    v, l = normalised(rng.normal(size=(2, 50, 3)))  # noqa: E741
    n = normalised(rng.normal(size=(50, 3)))
    t, b = frame_around(n)
    both = microfacets.specular_brdf_anisotropic((t, b, n), v, l, alpha, alpha)
    np.testing.assert_allclose(both, microfacets.specular_brdf(n, v, l, alpha), rtol=1e-9)


@pytest.mark.parametrize("sheen_roughness", [0.3, 0.6, 1.0])
def test_fibres_cover_the_surface(sheen_roughness):
    h, solid_angle = HEMISPHERE
    density = microfacets.charlie(h[:, 2:], sheen_roughness)
    assert (density * h[:, 2:] * solid_angle).sum() == pytest.approx(1, abs=2e-3)


def test_the_fit_of_the_sheen_has_no_jump():
    for alpha in (0.1, 0.5, 1.0):
        low, high = microfacets.charlie_lambda(np.array([0.5 - 1e-9, 0.5]), alpha)
        assert low == pytest.approx(high, rel=1e-6)


@pytest.mark.parametrize("anisotropy", [0.0, 0.8])
def test_lobes_are_reciprocal(anisotropy, rng):
    p = Parameters(
        (0.9, 0.5, 0.2), 1.0, 0.4, anisotropy=anisotropy, anisotropy_direction=(0.6, 0.8)
    )
    v, l = normalised(np.abs(rng.normal(size=(2, 50, 3))) + 0.01)  # noqa: E741
    tangent = np.broadcast_to([1.0, 0, 0, 1], (50, 4))
    n = np.broadcast_to(UP, v.shape)
    forth = lit_base(p, Surface(v, v, n, tangent=tangent), l) / dot(n, l)
    back = lit_base(p, Surface(v, l, n, tangent=tangent), v) / dot(n, v)
    np.testing.assert_allclose(forth, back, rtol=1e-9)


def test_fresnel_at_its_ends():
    assert microfacets.schlick(0.04, 0.7, 1.0) == pytest.approx(0.04)
    assert microfacets.schlick(0.04, 0.7, 0.0) == pytest.approx(0.7)


# --- integrals --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("roughness", [0.35, 0.6, 1.0])
def test_the_table_is_the_integral_over_all_lights(roughness):
    """Karis 2013: A and B from midpoints of the half vector, against the sum over directions of the light."""
    l, solid_angle = HEMISPHERE  # noqa: E741
    for cosine in (0.1, 0.5, 0.9):
        v = viewer(cosine)
        value = microfacets.specular_brdf(UP, v, l, roughness**2) * l[:, 2:] * solid_angle
        grazing = (1 - dot(v, microfacets.half_way(v, l))) ** 5
        expected = [(value * (1 - grazing)).sum(), (value * grazing).sum()]
        np.testing.assert_allclose(brdf_terms(cosine, roughness), expected, atol=2e-3)


def test_a_mirror_reflects_all_and_no_roughness_reflects_more():
    cosines = np.linspace(0.01, 1, 30)
    np.testing.assert_allclose(brdf_terms(cosines, 0.0).sum(-1), 1, atol=2e-3)
    grazing = (1 - cosines) ** 5
    np.testing.assert_allclose(brdf_terms(cosines, 0.0)[:, 1], grazing, atol=4e-3)
    for roughness in np.linspace(0.1, 1, 10):
        assert brdf_terms(cosines, roughness).sum(-1).max() <= 1.001


@pytest.mark.parametrize("sheen_roughness", [0.3, 0.6, 1.0])
def test_the_albedo_of_sheen_is_its_integral(sheen_roughness):
    l, solid_angle = HEMISPHERE  # noqa: E741
    for cosine in (0.1, 0.4, 0.9):
        value = microfacets.sheen_brdf(UP, viewer(cosine), l, sheen_roughness)
        expected = (value * l[:, 2:] * solid_angle).sum()
        assert sheen_albedo(cosine, sheen_roughness) == pytest.approx(expected, abs=4e-3)
        assert expected <= 1


# --- furnaces: in light of 1 from all sides, what absorbs nothing cannot be seen ---------------------------------

WHITE = Parameters(color=(1, 1, 1))
FURNACES = {
    "metal": replace(WHITE, metallic=1.0),
    "dielectric": replace(WHITE, metallic=0.0),
    "half": replace(WHITE, metallic=0.5),
    "heavy": replace(WHITE, metallic=0.0, ior=2.4),
    "weightless": replace(WHITE, metallic=0.0, specular_weight=0.3),
    "coated": replace(WHITE, metallic=0.3, clearcoat=1.0, clearcoat_roughness=0.4),
    "velvet": replace(WHITE, metallic=0.0, sheen_color=(1, 1, 1), sheen_roughness=0.5),
    "glass": replace(WHITE, metallic=0.0, transmission=1.0, thickness=0.2, dispersion=1.0),
    "brushed": replace(WHITE, anisotropy=0.7),
}


@pytest.mark.parametrize("roughness", [0.0, 0.3, 0.7, 1.0])
@pytest.mark.parametrize("name", FURNACES)
def test_a_white_furnace_hides_what_absorbs_nothing(name, roughness):
    surface = surface_of([0.05, 0.3, 0.6, 1.0], tangent=np.array([[1.0, 0, 0, 1]] * 4))
    p = replace(FURNACES[name], roughness=roughness)
    np.testing.assert_allclose(shade(p, surface, environment=constant()), 1, atol=3e-3)


@pytest.mark.parametrize("roughness", [0.3, 0.6, 1.0])
def test_a_furnace_of_samples(roughness):
    surface = surface_of([0.2, 0.5, 1.0])
    p = replace(WHITE, roughness=roughness, specular="sampled", specular_samples=1024)
    np.testing.assert_allclose(shade(p, surface, environment=constant()), 1, atol=3e-3)
    single = shade(replace(p, multiple_scattering=False), surface, environment=constant())
    terms = brdf_terms(np.array([0.2, 0.5, 1.0]), roughness).sum(-1)
    np.testing.assert_allclose(single[:, 0], terms, atol=3e-3)


def test_single_scattering_loses_what_the_table_says():
    surface = surface_of([0.1, 0.5, 1.0])
    p = replace(WHITE, roughness=0.8, color=(0.9, 0.5, 0.1), multiple_scattering=False)
    a, b = brdf_terms(np.array([0.1, 0.5, 1.0]), 0.8).T[..., None]
    np.testing.assert_allclose(
        shade(p, surface, environment=constant()), np.array(p.color) * a + b, rtol=1e-9
    )


def test_scattered_light_is_a_geometric_series():
    """Fdez-Aguera 2019, section 3: each further bounce meets the mean reflectance and what single scattering lost."""
    f = Fresnel(np.array([0.9, 0.5, 0.1]), 0.8)
    a, b = 0.5, 0.1
    cosine = (np.arange(4000) + 0.5)[:, None] / 4000
    mean = (2 * cosine * microfacets.schlick(f.f0, f.f90, cosine)).mean(0)
    single = f.f0 * a + f.f90 * b
    bounces = sum(single * (mean * (1 - (a + b))) ** k for k in range(1, 80))
    np.testing.assert_allclose(np.stack(scattered(f, a, b)), [single, bounces], rtol=1e-5)


def test_lights_all_around_are_a_furnace_of_single_scattering():
    """The BRDF for lights, summed over the hemisphere, is the one for an environment."""
    directions, solid_angle = sphere_of(64, 256)
    for p in (
        replace(WHITE, color=(0.9, 0.6, 0.3), roughness=0.6, multiple_scattering=False),
        replace(WHITE, metallic=0.0, specular_weight=0.0),
        replace(WHITE, metallic=0.0, specular_weight=0.0, transmission=0.4),
    ):
        for cosine in (0.3, 0.9):
            v = np.broadcast_to(viewer(cosine), directions.shape)
            surface = Surface(np.zeros(v.shape), v, np.broadcast_to(UP, v.shape))
            lit = (lit_base(p, surface, directions) * solid_angle).sum(0)
            dark_behind = replace(constant(), behind=Environment().behind)
            expected = shade(p, surface_of(cosine), environment=dark_behind)[0]
            np.testing.assert_allclose(lit, expected, atol=4e-3)


def test_a_coat_sends_its_share_of_a_light_and_takes_it_from_what_lies_below():
    """KHR_materials_clearcoat: below, an emission of 1 in darkness; above, the lobe of appendix B.3.1."""
    surface = surface_of([0.2, 0.7])
    p = Parameters((0, 0, 0), 0.0, specular_weight=0.0, emissive=(1, 1, 1), clearcoat=0.5)
    share = 0.5 * microfacets.schlick(0.04, 1.0, np.array([[0.2], [0.7]]))
    np.testing.assert_allclose(shade(p, surface), np.repeat(1 - share, 3, -1))
    light = Directional(travels=(-0.3, 0.2, -1), intensity=2.0)
    to_light = -normalised(light.travels)
    rough = replace(p, clearcoat_roughness=0.5, emissive=(0, 0, 0))
    lobe = microfacets.specular_brdf(UP, surface.v, to_light, 0.25)
    expected = share * lobe * 2 * to_light[2]
    np.testing.assert_allclose(shade(rough, surface, [light]), np.repeat(expected, 3, -1))


def test_sheen_over_a_base_in_a_light_takes_the_greater_albedo():
    """KHR_materials_sheen: min(1 - E(n.v), 1 - E(n.l)), on a diffuse base."""
    surface = surface_of([0.2])
    light = Directional(travels=(0, 0, -1), intensity=np.pi)
    p = Parameters(
        (1, 1, 1), 0.0, specular_weight=0.0, sheen_color=(0.8, 0, 0), sheen_roughness=0.6
    )
    below = 1 - 0.8 * max(sheen_albedo(0.2, 0.6), sheen_albedo(1.0, 0.6))
    fibres = 0.8 * np.pi * microfacets.sheen_brdf(UP, surface.v, UP, 0.6)[0, 0]
    np.testing.assert_allclose(shade(p, surface, [light])[0], [below + fibres, below, below])


# --- units and layers -------------------------------------------------------------------------------------------------


def test_a_matt_surface_in_lux_and_candela():
    surface = surface_of([0.4])
    matt = Parameters((0.5, 0.25, 1.0), 0.0, specular_weight=0.0)
    sun = Directional(travels=(0, 0, -1), intensity=3.0)
    np.testing.assert_allclose(shade(matt, surface, [sun])[0], np.array(matt.color) / np.pi * 3)
    lamp = Point((0, 0, 2.0), intensity=8.0, decay=2.0)
    np.testing.assert_allclose(shade(matt, surface, [lamp])[0], np.array(matt.color) / np.pi * 2)


def test_occlusion_dims_the_surroundings_and_no_lamp():
    surface = surface_of([0.4])
    p = Parameters((0.5, 0.25, 1.0), 0.3, 0.5, occlusion=occluded(0.2, 0.5), clearcoat=0.5)
    bright = replace(p, occlusion=1.0)
    assert p.occlusion == pytest.approx(0.6)
    sun = Directional(travels=(0, 0, -1))
    np.testing.assert_allclose(shade(p, surface, [sun]), shade(bright, surface, [sun]))
    np.testing.assert_allclose(
        shade(p, surface, environment=constant()),
        0.6 * shade(bright, surface, environment=constant()),
    )


@pytest.mark.parametrize("specular", ["levels", "sampled"])
def test_an_ambient_light_is_a_constant_environment(specular):
    surface = surface_of([0.1, 0.7])
    p = Parameters((0.5, 0.25, 1.0), 0.3, 0.5, specular=specular)
    around = constant(0.6)
    expected = shade(p, surface, environment=replace(around, behind=Environment().behind))
    np.testing.assert_allclose(shade(p, surface, [Ambient(intensity=0.6)]), expected)


def test_roughness_0_is_a_mirror():
    surface = surface_of([0.05, 0.5, 1.0])
    color = np.array([0.9, 0.6, 0.3])

    def sky(directions, *_):
        return 1.5 + normalised(directions)

    around = Environment(sky, sky, sky, 64)
    mirror = sky(shading.reflect(-surface.v, UP)) * shading.schlick(color, surface.v[:, 2:])
    for specular in ("levels", "sampled"):
        p = Parameters(color, 1.0, 0.0, specular=specular)
        np.testing.assert_allclose(shade(p, surface, environment=around), mirror, atol=6e-3)


def test_one_lookup_goes_from_the_reflection_to_the_normal():
    r = viewer(0.3)
    np.testing.assert_allclose(dominant_direction(UP, r, 0.0), r)
    np.testing.assert_allclose(dominant_direction(UP, r, 1.0), UP)
    # By hand at roughness .7: a = .49, (1 - a) (sqrt(1 - a) + a) = .6141.
    np.testing.assert_allclose(dominant_direction(UP, r, 0.7), UP + 0.61411 * (r - UP), atol=1e-5)


def test_what_shows_through_a_sheet_and_through_a_volume():
    surface = surface_of([0.5], scale=(2.0, 2.0, 2.0))
    seen = []

    def behind(exit_point, direction, roughness):
        seen.append((exit_point, direction, roughness))
        return np.ones(np.shape(direction))

    around = Environment(behind=behind)
    glass = Parameters((0.5, 1, 1), 0.0, 0.4, specular_weight=0.0, transmission=1.0, ior=1.3)
    np.testing.assert_allclose(shade(glass, surface, environment=around)[0], [0.5, 1, 1])
    exit_point, direction, roughness = seen[-1]
    np.testing.assert_allclose(direction, -surface.v)
    np.testing.assert_allclose(exit_point, 0)
    assert roughness == pytest.approx(0.4 * 0.6)

    thick = replace(
        glass,
        thickness=0.5,
        attenuation_distance=2.0,
        attenuation_color=(1, 0.25, 1),
        dispersion=2.0,
    )
    # A way of .5 * 2 through what keeps a quarter of the green in 2: a half.
    np.testing.assert_allclose(shade(thick, surface, environment=around)[0], [0.5, 0.5, 1])
    # KHR_materials_dispersion: Abbe number 20 / 2 = 10, so that n_F - n_C = .3 / 10.
    for ior, (exit_point, direction, _) in zip((1.285, 1.3, 1.315), seen[-3:], strict=True):
        sine = np.linalg.norm(np.cross(direction, UP))
        assert ior * sine == pytest.approx(np.sqrt(0.75))
        np.testing.assert_allclose(exit_point, direction)


def test_maps_of_directions():
    tangent = np.array([1.0, 0, 0, -1])
    np.testing.assert_allclose(mapped_normal(UP, tangent, np.array([0.5, 0.5, 1.0])), UP)
    tilted = mapped_normal(UP, tangent, np.array([0.5, 0.75, 1.0]), 2.0)
    np.testing.assert_allclose(tilted, normalised([0, -1, 1]))
    np.testing.assert_allclose(anisotropy_direction(90), [0, 1], atol=1e-12)
    np.testing.assert_allclose(anisotropy_direction(90, (0.5, 1.0, 1.0)), [-1, 0], atol=1e-12)


# --- thin films -------------------------------------------------------------------------------------------------------


def matching_functions(nanometres):
    """CIE 1931 by the sums of Gaussians of Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations"."""

    def bump(center, below, above):
        return np.exp(
            -0.5 * ((nanometres - center) / np.where(nanometres < center, below, above)) ** 2
        )

    x = (
        1.056 * bump(599.8, 37.9, 31.0)
        + 0.362 * bump(442.0, 16.0, 26.7)
        - 0.065 * bump(501.1, 20.4, 26.2)
    )
    y = 0.821 * bump(568.8, 46.9, 40.5) + 0.286 * bump(530.9, 16.3, 31.1)
    z = 1.217 * bump(437.0, 11.8, 36.0) + 0.681 * bump(459.0, 26.0, 13.8)
    return np.stack([x, y, z], -1)


@pytest.mark.parametrize("cosine", [1.0, 0.7, 0.4])
@pytest.mark.parametrize("thickness", [150.0, 300.0, 450.0, 700.0])
@pytest.mark.parametrize("base_f0", [0.04, 0.3, 0.7])
@pytest.mark.parametrize("film_ior", [1.4, 1.8])
def test_a_film_interferes_as_airys_sum_says(thickness, cosine, base_f0, film_ior):
    """All orders of interference, wavelength by wavelength (Born and Wolf, Principles of Optics, section 7.6)."""
    wavelengths = np.linspace(360.0, 830.0, 471)
    weights = matching_functions(wavelengths)
    weights = weights / weights[:, 1].sum()

    cosine_2 = np.sqrt(1 - (1 - cosine**2) / film_ior**2)
    base_ior = (1 + np.sqrt(base_f0 + 1e-4)) / (1 - np.sqrt(base_f0 + 1e-4))
    r12 = ((film_ior - 1) / (film_ior + 1)) ** 2
    r23 = ((base_ior - film_ior) / (base_ior + film_ior)) ** 2
    r12 = r12 + (1 - r12) * (1 - cosine) ** 5
    r23 = r23 + (1 - r23) * (1 - cosine_2) ** 5
    # Amplitudes: reflection turns the phase where the index grows.
    first, second = -np.sqrt(r12), np.sqrt(r23) * (-1 if base_ior > film_ior else 1)
    turn = np.exp(2j * np.pi * 2 * film_ior * thickness * cosine_2 / wavelengths)
    airy = np.abs((first + second * turn) / (1 + first * second * turn)) ** 2
    mean = r12 + (1 - r12) ** 2 * r23 / (1 - r12 * r23)
    from_xyz = np.array(
        [[3.2405, -1.5371, -0.4985], [-0.9693, 1.8760, 0.0416], [0.0556, -0.2040, 1.0572]]
    )  # IEC 61966-2-1
    expected = mean + from_xyz @ ((airy - mean)[:, None] * weights).sum(0)
    got = iridescent_fresnel(
        np.array([cosine]), film_ior, np.array([thickness]), np.full(3, base_f0)
    )
    np.testing.assert_allclose(got, np.maximum(expected, 0), atol=0.035)


def test_schlick_backwards():
    f0 = np.array([0.04, 0.5, 0.9])
    for cosine in (1.0, 0.5, 0.2):
        there = microfacets.schlick(f0, 1.0, cosine)
        np.testing.assert_allclose(schlick_to_f0(there, cosine), f0)


def test_total_reflection_below_a_film():
    assert (
        iridescent_fresnel(
            np.array([0.1]), 1.2, np.array([300.0]), np.full(3, 0.1), outside_ior=1.5
        )
        == 1
    ).all()


# --- samples ----------------------------------------------------------------------------------------------------------


def test_hammersley_points():
    np.testing.assert_allclose(radical_inverse(np.arange(6)), [0, 0.5, 0.25, 0.75, 0.125, 0.625])
    points = hammersley(16)
    for axis in (0, 1):
        np.testing.assert_allclose(np.sort(points[:, axis]), (np.arange(16) + 0.5) / 16)


def test_frames_are_right_handed(rng):
    n = np.concatenate([normalised(rng.normal(size=(50, 3))), [UP, -UP]])
    t, b = frame_around(n)
    np.testing.assert_allclose(np.cross(t, b), n, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(t, axis=-1), 1)


@pytest.mark.parametrize("alpha_t", [0.1, 0.6])
@pytest.mark.parametrize("cosine", [0.2, 0.8])
def test_half_vectors_are_as_dense_as_visible_facets(alpha_t, cosine):
    """Heitz 2014, equation 22: means over many samples against integrals of D G1(v) v.h / n.v over the hemisphere."""
    v = viewer(cosine)
    h = np.array([visible_normal(v, point, alpha_t, 0.3) for point in hammersley(1 << 11)])
    directions, solid_angle = HEMISPHERE
    density = microfacets.trowbridge_reitz_anisotropic(
        directions[:, :1], directions[:, 1:2], directions[:, 2:], alpha_t, 0.3
    )
    masking = 2 * microfacets.smith_half_anisotropic(v[0], v[1], v[2], alpha_t, 0.3)
    weight = density * masking * np.maximum(dot(directions, v), 0) * solid_angle
    for moment in (lambda x: x, lambda x: x**2, lambda x: x * np.roll(x, 1, -1)):
        expected = (moment(directions) * weight).sum(0)
        np.testing.assert_allclose(moment(h).mean(0), expected, atol=4e-3)


def photograph(size=64):
    """The forest as faces (6, size, size, 3), its pixels box filtered before the lookup."""
    import OpenImageIO

    file = OpenImageIO.ImageInput.open(str(FOREST))
    assert file is not None
    pixels = np.asarray(file.read_image("float"))[..., :3]
    width = 4 * size
    factor = pixels.shape[1] // width
    pixels = pixels.reshape(-1, factor, width, factor, 3).mean((1, 3)).astype(float)
    return equirect_to_faces(pixels, size)


@pytest.mark.parametrize("roughness", [0.3, 0.6, 1.0])
def test_samples_converge_to_the_sum_over_a_photograph(roughness):
    """The sum over all texels of a photograph with a sun, against filtered importance sampling of its box mips."""
    faces = photograph()
    directions = unit_texel_directions(64).reshape(-1, 3)
    # The solid angle of a texel is that of its tangent plane, cos^3, within 1e-4.
    major = np.abs(directions).max(-1, keepdims=True)
    solid_angle = major**3 * (2 / 64) ** 2
    color = np.array([0.9, 0.6, 0.3])
    n = normalised([0.2, 0.9, 0.3])
    t, _ = frame_around(n)
    cosines = np.array([0.3, 0.6, 0.9])[:, None]
    v = cosines * n + np.sqrt(1 - cosines**2) * t
    surface = Surface(np.zeros((3, 3)), v, np.broadcast_to(n, (3, 3)))
    p = Parameters(
        color, 1.0, roughness, specular="sampled", specular_samples=1024, multiple_scattering=False
    )
    got = shade(p, surface, environment=environment_of(faces))
    for index in range(3):
        brdf = microfacets.specular_brdf(n, v[index], directions, roughness**2)
        f = microfacets.schlick(
            color, 1.0, dot(v[index], microfacets.half_way(v[index], directions))
        )
        each = f * brdf * np.maximum(dot(directions, n), 0) * solid_angle
        expected = (faces.reshape(-1, 3) * each).sum(0)
        np.testing.assert_allclose(got[index], expected, rtol=0.03)


def test_lookups_between_levels():
    levels = [np.full((6, n, n, 3), float(value)) for n, value in ((8, 1), (4, 2), (2, 4))]
    around = environment_of(levels[0], levels[1:], levels[2])
    directions = np.array([[1.0, 0.2, 0.3], [0.1, -1, 0.5], [0.2, 0.3, 1]])
    roughness = np.array([[0.0], [0.5], [0.75]])
    np.testing.assert_allclose(around.radiance(directions, roughness)[:, 0], [1, 2, 3])
    np.testing.assert_allclose(around.irradiance(directions), 4)
    np.testing.assert_allclose(around.mip(directions, 1.5), 1)


def test_levels_of_detail_follow_the_solid_angle_of_a_sample():
    """Krivanek and Colbert 2008: with n = v and a roughness of 1, D G1(v) / (4 n.v) is 1 / (4 pi) all around."""
    n = np.array([[0.0, 0.0, 1.0]])
    frame = (*frame_around(n), n)
    ((_, _, _, lod),) = sampled_lobes(frame, n, 1.0, 1.0, [(0.3, 0.4)], 64)
    # The sample covers the whole sphere, a texel 1 / (6 64^2) of it.
    assert lod.item() == pytest.approx(0.5 * np.log2(6 * 64**2) + 0.25)
