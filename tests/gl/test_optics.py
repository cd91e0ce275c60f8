"""cc.reflect, cc.refract, cc.fresnel and cc.schlick against GLSL: the functions themselves, glass and mirrors."""

import numpy as np
import pytest

import cubecam as cc

# Directions that cover the half sphere, from the place in a picture of 32 x 32 pixels; the normal is no axis.
DIRECTIONS = """
uniform float eta;
const vec3 normal = normalize(vec3(0.3, 0.8, -0.5));
vec3 towards(Surface surface) {
    vec2 angle = vec2(1.5, 6.2) * surface.uv;
    vec3 side = normalize(cross(normal, vec3(1.0, 0.0, 0.0)));
    vec3 along = cos(angle.y) * side + sin(angle.y) * cross(normal, side);
    return sin(angle.x) * along - cos(angle.x) * normal;
}
"""
ETAS = (1 / 1.52, 1.52, 1.0)


def drawn(renderer, expression, eta=1.0):
    """What GLSL gives for each pixel of a wall that fills the picture."""
    source = f"{DIRECTIONS}vec3 shade(Surface surface) {{ return {expression}; }}"
    scene = cc.Scene()
    wall = scene.add(cc.Mesh.plane(2, 2), cc.ShaderMaterial(source, uniforms={"eta": eta}))
    wall.rotation = cc.axis_angle((1, 0, 0), 90)
    camera = cc.OrthographicCamera(height=2, position=(0, 0, 1), target=(0, 0, 0))
    frame = renderer.render(scene, camera, (32, 32), format="rgba32f")
    return frame.color[..., :3]


@pytest.fixture
def directions(renderer):
    """The incident directions that GLSL made, and the normal."""
    incident = drawn(renderer, "towards(surface)")
    normal = np.array([0.3, 0.8, -0.5])
    assert np.ptp(incident @ normal) > 0.8
    return incident, (normal / np.linalg.norm(normal)).astype(np.float32)


def test_reflect(renderer, directions):
    want = drawn(renderer, "reflect(towards(surface), normal)")
    np.testing.assert_allclose(cc.reflect(*directions), want, atol=1e-6)


@pytest.mark.parametrize("eta", ETAS)
def test_refract(renderer, directions, eta):
    want = drawn(renderer, "refract(towards(surface), normal, eta)", eta)
    got = cc.refract(directions[0], directions[1], eta)
    assert got.dtype == np.float32
    assert (want.any(axis=-1).all()) == (eta <= 1)
    # At the critical angle the root of a small number magnifies the error of float arithmetic.
    near = np.abs(1 - eta**2 * (1 - (directions[0] @ directions[1]) ** 2)) < 1e-3
    assert near.mean() < 0.1
    np.testing.assert_allclose(got[~near], want[~near], atol=2e-5)


def seen(renderer, material):
    """What a ball shows in white surroundings, with its incident directions and normals."""
    white = cc.CubeMap(np.ones((6, 1, 1, 3), np.float32))
    scene = cc.Scene(environment=white, background=(0, 0, 0, 0))
    scene.add(cc.Mesh.sphere(1, 64, 32), material)
    camera = cc.PerspectiveCamera(fov=40, position=(0.4, 1, 3), target=(0, 0, 0))
    frame = renderer.render(
        scene, camera, (64, 64), format="rgba32f", outputs=("position", "normal")
    )
    hit = frame.color[..., 3] == 1
    incident = frame.position[hit] - np.float32(camera.position)
    incident /= np.linalg.norm(incident, axis=-1, keepdims=True)
    assert hit.mean() > 0.4
    return frame.color[hit][:, :3], incident, frame.normal[hit]


@pytest.mark.parametrize("ior", [1.52, 1 / 1.52])
def test_fresnel_is_that_of_glass(renderer, ior):
    """Black glass in white surroundings shows the share that it reflects."""
    color, incident, normal = seen(renderer, cc.GlassMaterial(ior=ior, tint=(0, 0, 0)))
    share = cc.fresnel(incident, normal, 1 / ior)
    near = np.abs(1 - (1 - (incident * normal).sum(-1) ** 2) / ior**2) < 2e-2
    assert near.mean() < 0.2
    np.testing.assert_allclose(
        color[~near], np.broadcast_to(share[:, None], color.shape)[~near], atol=1e-4
    )
    assert share.max() > 0.9
    assert share.min() < 0.05


def test_schlick_is_that_of_a_mirror_and_of_shaders(renderer):
    color, incident, normal = seen(renderer, cc.MirrorMaterial(f0=0.3))
    share = cc.schlick(incident, normal, 0.3)
    assert 0.3 <= share.min() < 0.31
    assert share.max() > 0.8
    np.testing.assert_allclose(color, np.broadcast_to(share[:, None], color.shape), atol=1e-4)
    source = "vec3 shade(Surface surface) { return vec3(schlick(surface, 0.3)); }"
    own, _, _ = seen(renderer, cc.ShaderMaterial(source))
    np.testing.assert_allclose(own, color, atol=1e-6)
