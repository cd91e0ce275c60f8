"""Mirror and glass pixels against numpy reflect and refract and a lookup; the cube by object-space position."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.compare import assert_close
from tests.gl.flat import flat_camera, quad, random_picture
from tests.gl.world import (
    World,
    capture_hits,
    inner,
    inner_smooth,
    orthographic,
    perspective,
    smooth_environment,
)
from tests.reference.sampling import sample_faces, sample_trilinear

ENVIRONMENT = smooth_environment()
VIEWS = {
    "perspective": lambda: perspective((1.5, 1, 3.2), (0.1, 0, 0), fov=45),
    "orthographic": lambda: orthographic((1.5, 1, 3.2), (0.1, 0, 0), height=3),
}
views = pytest.mark.parametrize("make_view", VIEWS.values(), ids=VIEWS)


def ball(material):
    """A sphere stretched and turned, so that normals need the inverse transpose."""
    world = World(cc.Scene(environment=cc.CubeMap(ENVIRONMENT), background=(0, 0, 0, 0)))
    world.sphere(
        0.9,
        material=material,
        position=(0.2, 0.1, -0.1),
        axis=(1, 1, 0),
        degrees=40,
        scale=(1, 1.6, 0.8),
    )
    return world


def drawn(renderer, world, view):
    """Return colours, view directions and normals at the pixels well inside the ball."""
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    assert mask.sum() > 150
    return frame.color[mask], view.directions()[mask], hits.normal[mask]


def with_alpha(rgb):
    return np.concatenate([rgb, np.ones_like(rgb[..., :1])], axis=-1)


@views
@pytest.mark.parametrize("fresnel", [None, 0.04, 0.5])
def test_mirror(renderer, make_view, fresnel):
    material = cc.MirrorMaterial(
        tint=(1, 0.9, 0.7),
        env_weight=0.78,
        color=(0.95, 0.85, 0.4),
        color_weight=0.3,
        f0=fresnel,
    )
    got, incident, normal = drawn(renderer, ball(material), make_view())
    weight = 0.78
    if fresnel is not None:
        weight = weight * shading.schlick(fresnel, -shading.dot(incident, normal))
    env = sample_faces(ENVIRONMENT, shading.reflect(incident, normal))
    want = weight * np.array([1, 0.9, 0.7]) * env + 0.3 * np.array([0.95, 0.85, 0.4])
    assert_close(got, with_alpha(want), "mirror")


@views
@pytest.mark.parametrize("eta", [1 / 1.52, 1 / 2.4, 1.0, 1.3])
@pytest.mark.parametrize("fresnel", [True, False])
def test_glass(renderer, make_view, eta, fresnel):
    material = cc.GlassMaterial(ior=1 / eta, fresnel=fresnel, tint=(0.8, 1, 0.9))
    got, incident, normal = drawn(renderer, ball(material), make_view())
    bent = shading.refract(incident, normal, eta)
    gone = ~np.any(bent, -1)
    through = np.array([0.8, 1, 0.9]) * sample_faces(
        ENVIRONMENT, np.where(gone[:, None], incident, bent)
    )
    back = sample_faces(ENVIRONMENT, shading.reflect(incident, normal))
    f = shading.fresnel_dielectric(-shading.dot(incident, normal), eta)
    want = f * back + (1 - f) * through if fresnel else through
    # At the critical angle Fresnel's curve is vertical. There, and where a plain refraction has
    # nothing to show, rounding decides the result.
    k = 1 - eta**2 * (1 - shading.dot(incident, normal)[:, 0] ** 2)
    keep = np.abs(k) > 0.03
    if not fresnel:
        keep &= ~gone
    assert keep.sum() > 50
    if eta > 1:
        assert gone.any()
    assert_close(got[keep], with_alpha(want)[keep], "mirror")


def test_total_reflection_shows_the_mirror_image(renderer):
    material = cc.GlassMaterial(ior=1 / 1.5)
    got, incident, normal = drawn(renderer, ball(material), VIEWS["perspective"]())
    k = 1 - 1.5**2 * (1 - shading.dot(incident, normal)[:, 0] ** 2)
    total = k < -0.03
    assert total.sum() > 20
    want = sample_faces(ENVIRONMENT, shading.reflect(incident, normal))
    assert_close(got[total], with_alpha(want)[total], "mirror")


def test_a_flat_mirror_shows_the_environment_mirrored(renderer):
    """The geometry is exact and no normals are interpolated, so the tolerance is that of a lookup."""
    world = World(cc.Scene(environment=cc.CubeMap(ENVIRONMENT), background=(0, 0, 0, 0)))
    world.plane(4, 4, material=cc.MirrorMaterial(), axis=(1, 0, 1), degrees=30)
    view = perspective((0.5, 2, 2.5), (0, 0, 0))
    frame = renderer.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    mask = inner_smooth(hits) & hits.hit
    want = sample_faces(ENVIRONMENT, shading.reflect(view.directions(), hits.normal))
    assert_close(frame.color[mask][:, :3], want[mask], "shaded", least=0)


def test_mirrors_in_a_capture_use_the_captures_position_as_eye(renderer):
    world = ball(cc.MirrorMaterial())
    position = np.array([1.5, 0.8, 1.2])
    hits = capture_hits(world, position, 48)
    mask = inner_smooth(hits) & hits.hit
    assert mask.sum() > 100
    for eye, given in ((position, None), (np.array([0, 1, 5.0]), (0, 1, 5))):
        cube = renderer.capture(world.scene, position=position, size=48, eye=given)
        incident = normalised(hits.position[mask] - eye)
        want = sample_faces(ENVIRONMENT, shading.reflect(incident, hits.normal[mask]))
        front = shading.dot(incident, hits.normal[mask])[:, 0] < -0.05
        assert_close(cube.faces[mask][front][:, :3], want[front], "mirror")


def test_a_node_has_an_environment_of_its_own(renderer):
    world = ball(cc.MirrorMaterial())
    world.scene.nodes[0].environment = cc.CubeMap(ENVIRONMENT[..., ::-1].copy())
    got, incident, normal = drawn(renderer, world, VIEWS["perspective"]())
    want = sample_faces(ENVIRONMENT[..., ::-1], shading.reflect(incident, normal))
    assert_close(got, with_alpha(want), "mirror")


def test_without_any_environment_mirrors_are_black(renderer):
    world = ball(cc.MirrorMaterial())
    world.scene.environment = None
    got, *_ = drawn(renderer, world, VIEWS["perspective"]())
    assert_close(got, np.broadcast_to([0, 0, 0, 1.0], got.shape), "exact")


def test_a_mirror_reflects_the_environment_not_the_background(renderer):
    world = ball(cc.MirrorMaterial())
    world.scene.background = cc.CubeMap(np.ones((6, 2, 2, 3), np.float32))
    got, incident, normal = drawn(renderer, world, VIEWS["perspective"]())
    want = sample_faces(ENVIRONMENT, shading.reflect(incident, normal))
    assert_close(got, with_alpha(want), "mirror")


@pytest.mark.parametrize("mipmaps", [False, True])
def test_a_box_textured_by_object_space_position(any_path, mipmaps):
    """P1: the lookup direction is the object-space position, for any matrix of the node."""
    rng = np.random.default_rng(3)
    pixels = rng.random((6, 8, 8, 3)).astype(np.float32)
    world = World()
    material = cc.BasicMaterial(cubemap=cc.CubeMap(pixels, mipmaps=mipmaps))
    world.box(1, material=material, position=(0.3, 0.2, 0), axis=(1, 2, 0), degrees=35, scale=2)
    view = perspective((2, 1.5, 4.5), (0, 0, 0), near=1, far=15, size=(64, 64))
    frame = any_path.render(world.scene, view.camera, view.size, format="rgba32f")
    hits = view.hits(world.shapes)
    mask = inner(hits) & hits.hit
    want = sample_trilinear(pixels, np.nan_to_num(hits.local, nan=1.0), 0)
    if not mipmaps:
        assert_close(frame.color[mask][:, :3], want[mask], "mirror", least=0)
        return
    # A texel covers several pixels, so level 0 is looked up, except on sides seen at a slant.
    difference = np.abs(frame.color[mask][:, :3] - want[mask])
    assert np.quantile(difference, 0.95) < 4e-3
    assert difference.max() < 0.2


def test_a_lookup_in_a_noisy_cube_equals_sample(renderer):
    """The GPU's seamless lookup and CubeMap.sample are the same function, on edges and corners too."""
    rng = np.random.default_rng(4)
    cube = cc.CubeMap(rng.random((6, 5, 5, 4)).astype(np.float32))
    view = perspective((0, 0, 0), (1, 1, 1), fov=100, size=(64, 64))
    frame = renderer.render(cc.Scene(background=cube), view.camera, view.size, format="rgba32f")
    assert_close(frame.color[..., :3], cube.sample(view.directions())[..., :3], "shaded")


def test_mipmapped_lookups_blur_with_distance(renderer):
    """Far away a texel is much smaller than a pixel: trilinear lookups give grey, level 0 gives noise."""
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 2, (6, 128, 128, 3)).astype(np.float32)
    spread = {}
    for mipmaps in (False, True):
        scene = cc.Scene()
        scene.add(cc.Mesh.box(1), cc.BasicMaterial(cubemap=cc.CubeMap(pixels, mipmaps=mipmaps)))
        camera = cc.OrthographicCamera(height=1, position=(0, 0, 3), target=(0, 0, 0))
        spread[mipmaps] = (
            renderer.render(scene, camera, (8, 8), format="rgba32f").color[..., :3].std()
        )
    assert spread[True] < 0.12 < 0.25 < spread[False]


def test_a_map_and_a_cubemap_of_one_surface(any_path):
    """Each texture that is set has a unit of its own."""
    picture, light = random_picture(3).astype(np.float32), np.array([0.5, 2, 3], np.float32)
    around = cc.CubeMap(np.broadcast_to(light, (6, 2, 2, 3)))
    both = cc.BasicMaterial(map=picture, cubemap=around)
    scene = cc.Scene()
    scene.add(quad(9, 6), both)
    for image, cube in ((picture, None), (None, around), (picture, around)):
        both.map, both.cubemap = image, cube
        frame = any_path.render(scene, flat_camera(9, 6), (9, 6), format="rgba32f")
        want = (picture if image is not None else 1) * (light if cube is not None else 1)
        assert_close(frame.color[..., :3], np.broadcast_to(want, (6, 9, 3)), "lookup")
