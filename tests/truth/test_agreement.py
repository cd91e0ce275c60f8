"""Where the renderer approximates nothing, exact rays give the same picture, off the edges of nodes and shadows."""

import itertools
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.gl.world import smooth_environment
from tests.reference.raycast import interior

SIZE = (96, 72)
STEP = 1 / 255


def checks(seed, texels, mag_filter):
    """A picture of large texels of similar colours: a texture unit knows 1/256 of a texel, and no mipmap is used."""
    pixels = np.random.default_rng(seed).integers(90, 170, (texels, texels, 3), np.uint8)
    return cc.Image(pixels, mag_filter=mag_filter)


def random_scene(seed):
    """Phong and basic surfaces, turned and scaled, under lamps with and without shadows."""
    rng = np.random.default_rng(seed)
    scene = cc.Scene(background=rng.random(3))
    scene.add(cc.AmbientLight(color=rng.random(3), intensity=0.3))
    scene.add(cc.PointLight(position=(2, 4, 3), decay=1, intensity=3, shadow=cc.Shadow(size=2048)))
    scene.add(cc.DirectionalLight(direction=(-1, -2, -1.5), color=rng.random(3), intensity=0.6))
    scene.add(
        cc.SpotLight(
            position=(-3, 4, 2),
            direction=(2.4, -4, -2),
            angle=40,
            penumbra=0.5,
            decay=2,
            intensity=12,
            range=20,
            shadow=cc.Shadow(size=2048),
        )
    )
    floor = cc.PhongMaterial(color=(1, 1, 1), map=checks(seed, 8, "linear"))
    scene.add(cc.Mesh.plane(9, 9), floor, position=(0, -1, 0))
    meshes = (
        cc.Mesh.sphere(0.5, 48, 24),
        cc.Mesh.box(0.8),
        cc.Mesh.torus(0.4, 0.15, 48, 24),
        cc.Mesh.cone(0.4, 0.8, 48),
    )
    for i in range(7):
        mesh = meshes[i % len(meshes)]
        phong = cc.PhongMaterial(
            color=rng.random(3), ks=rng.random(), shininess=rng.uniform(2, 40), ka=rng.random() / 2
        )
        basic = cc.BasicMaterial(color=rng.random(3), map=checks(i, 2, "nearest"))
        scene.add(
            mesh,
            basic if i % 3 == 2 else phong,
            position=(rng.uniform(-2, 2), rng.uniform(-0.5, 1.2), rng.uniform(-2, 1)),
            rotation=rng.normal(size=4),
            scale=rng.uniform(0.6, 1.2, 3) * rng.choice([-1, 1], 3),
        )
    return scene


def camera():
    return cc.PerspectiveCamera(fov=45, position=(0.5, 1.2, 6), target=(0, 0, 0), near=0.5, far=50)


def steady(scene, view, size=SIZE, **options):
    """Pixels whose neighbours show the same node, lit by the same lamps: there no edge decides."""
    shadows = []
    for light in scene.lights:
        if getattr(light, "shadow", None) is None:
            continue
        others = [(other, other.intensity) for other in scene.lights if other is not light]
        for other, _ in others:
            other.intensity = 0
        shadowed = cc.truth.render(scene, view, size, samples=1, **options).color
        kept, light.shadow = light.shadow, None
        lit = cc.truth.render(scene, view, size, samples=1, **options).color
        light.shadow = kept
        for other, intensity in others:
            other.intensity = intensity
        shadows.append(np.abs(lit - shadowed)[..., :3].max(-1) > 1e-6)
    exact = cc.truth.render(scene, view, size, samples=1, outputs=("id",), **options)
    return exact, interior(exact.id, *shadows, radius=2)


@pytest.mark.parametrize("seed", range(3))
def test_random_scenes(renderer, seed):
    scene = random_scene(seed)
    exact, inside = steady(scene, camera())
    got = renderer.render(scene, camera(), SIZE, format="rgba32f", outputs=("id",))
    # Where facets turn away from a lamp that their normals still face, both round them, in different ways.
    terminator = np.zeros(inside.shape, bool)
    normal, position = (
        np.asarray(cc.truth.render(scene, camera(), SIZE, samples=1, outputs=(name,)).outputs[name])
        for name in ("normal", "position")
    )
    for light in scene.lights:
        if getattr(light, "shadow", None) is not None:
            towards = light.world_position - position
            towards /= np.linalg.norm(towards, axis=-1, keepdims=True)
            terminator |= np.abs((normal * towards).sum(-1)) < 0.15
    inside &= ~terminator
    assert inside.mean() > 0.4
    assert (exact.id == got.id)[inside].all()
    apart = np.abs(exact.color - got.color).max(-1)[inside]
    assert apart.max() <= STEP
    assert len(np.unique(exact.id[inside])) > 4


def test_parallel_rays(renderer):
    scene = random_scene(5)
    view = cc.OrthographicCamera(height=4, position=(1, 2, 6), target=(0, 0, 0))
    names = ("id", "distance", "z", "normal", "position", "label")
    exact = cc.truth.render(scene, view, SIZE, samples=1, outputs=names)
    got = renderer.render(scene, view, SIZE, format="rgba32f", outputs=names)
    inside = interior(exact.id, radius=1)
    for name in names:
        a, b = exact.outputs[name][inside], got.outputs[name][inside]
        assert a.dtype == b.dtype
        assert np.allclose(a, b, rtol=1e-4, atol=1e-4, equal_nan=True), name


def test_a_capture(renderer):
    scene = random_scene(6)
    hidden = scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=(1, 0, 0)), in_captures=False)
    left_out = scene.add(cc.Mesh.sphere(0.4), cc.BasicMaterial(color=(0, 1, 0)), position=(0, 1, 0))
    for light in scene.lights[1:]:
        if hasattr(light, "shadow"):
            light.shadow = None
    options: dict[str, Any] = {
        "near": 0.05,
        "far": 5.0,
        "rotation": (0.9, 0.1, 0.3, 0.2),
        "exclude": [left_out],
    }
    names = ("id", "distance", "z", "normal")
    exact = cc.truth.capture(scene, (0.2, 0.3, 0.1), 32, samples=1, outputs=names, **options)
    got = renderer.capture(scene, (0.2, 0.3, 0.1), 32, outputs=names, **options)
    inside = interior(exact.id, radius=1)
    assert hidden.id not in exact.id
    assert left_out.id not in exact.id
    assert len(np.unique(exact.id)) > 3
    for name in names:
        a, b = exact.outputs[name][inside], got.outputs[name][inside]
        assert np.allclose(a, b, rtol=1e-4, atol=1e-4), name
    # The eye of a capture is its middle; what lies beyond the far plane is the background in both.
    assert np.abs(exact.faces - got.faces)[inside].max() <= STEP


@pytest.mark.parametrize("blend", ["alpha", "alpha_keep", "additive", "multiply", "premultiplied"])
def test_panes_before_each_other(renderer, blend):
    scene = cc.Scene(background=(0.1, 0.4, 0.2, 0.5))
    scene.add(
        cc.Mesh.box((2, 0.5, 0.5)), cc.BasicMaterial(color=(0.9, 0.3, 0.1)), position=(0, 0, -1)
    )
    for i, color in enumerate(((1, 0.5, 0, 0.7), (0, 0.6, 1, 0.4))):
        scene.add(
            cc.Mesh.box((1.0, 1.2, 0.02)),
            cc.BasicMaterial(color=color, opacity=0.8, blend=blend),
            position=(0.5 * i - 0.25, 0, i),
        )
    view = cc.PerspectiveCamera(position=(0, 0, 5), target=(0, 0, 0))
    exact = cc.truth.render(scene, view, SIZE, samples=1)
    got = renderer.render(scene, view, SIZE, format="rgba32f")
    for light in (exact.color, got.color):
        assert len(np.unique(light.round(3).reshape(-1, 4), axis=0)) >= 6
    edges = np.abs(np.diff(exact.color, axis=1, prepend=exact.color[:, :1])).max(-1) > 0
    edges |= np.abs(np.diff(exact.color, axis=0, prepend=exact.color[:1])).max(-1) > 0
    inside = interior(edges.astype(int), radius=1) & ~edges
    assert inside.mean() > 0.5
    assert np.abs(exact.color - got.color)[inside].max() <= STEP / 4


def test_the_first_mirror_that_is_plane(renderer):
    """A plane mirror shows the mirrored scene: the renderer draws that as a scene of its own."""
    scene = random_scene(3)
    for light in scene.lights:
        if hasattr(light, "shadow"):
            light.shadow = None
    scene.lights[2].direction = (0, -1, 0)  # the lamps must be mirrored, too
    mirrored = cc.Scene(background=scene.background)
    z = -2.5
    flip = np.diag([1.0, 1, -1, 1])
    flip[2, 3] = 2 * z
    for light in scene.lights:
        other = mirrored.add(type(light)(color=light.color, intensity=light.intensity))
        for name in ("decay", "range", "angle", "penumbra"):
            if hasattr(light, name):
                setattr(other, name, getattr(light, name))
        if hasattr(light, "position"):
            other.position = (flip @ [*light.position, 1])[:3]
        if hasattr(light, "direction"):
            other.direction = flip[:3, :3] @ light.direction
    for node in scene.nodes:
        copy = mirrored.add(node.mesh, node.material)
        copy.matrix = flip @ node.world_matrix
    quarter = cc.axis_angle((1, 0, 0), 90)
    wall = scene.add(
        cc.Mesh.plane(9, 9), cc.MirrorMaterial(), position=(0, 0, z), rotation=quarter, name="wall"
    )
    exact = cc.truth.render(scene, camera(), SIZE, samples=1, outputs=("id",))
    got = renderer.render(mirrored, camera(), SIZE, format="rgba32f", outputs=("id",))
    inside = interior(exact.id, got.id, radius=1) & (exact.id == wall.id) & (got.id > 0)
    assert inside.mean() > 0.02
    assert np.abs(exact.color - got.color)[inside][:, :3].max() <= STEP


def test_a_mirror_and_glass_in_surroundings_alone(renderer):
    rng = np.random.default_rng(0)
    cube = cc.CubeMap(rng.random((6, 4, 4, 3), np.float32))
    scene = cc.Scene(
        environment=cube, environment_intensity=1.5, environment_rotation=rng.normal(size=4)
    )
    mirror = cc.MirrorMaterial(f0=0.2, tint=(1, 0.8, 0.6))
    scene.add(cc.Mesh.sphere(0.5, 64, 32), mirror, in_captures=False)
    one_way = cc.Mesh.plane(
        1, 1
    )  # a surface without a back: light enters the glass and stays in it
    turned = cc.axis_angle((1, 0, 0), 60)
    glass = cc.GlassMaterial(ior=1.4, tint=(0.9, 1, 0.8), fresnel=False)
    scene.add(one_way, glass, position=(1.2, 0, 0), rotation=turned, in_captures=False)
    view = cc.PerspectiveCamera(position=(0.4, 0.2, 3), target=(0.4, 0, 0))
    exact = cc.truth.render(scene, view, SIZE, samples=1, outputs=("id",))
    got = renderer.render(scene, view, SIZE, format="rgba32f", outputs=("id",))
    inside = interior(exact.id, radius=1)
    assert {1, 2} <= set(exact.id[inside])
    assert np.abs(exact.color - got.color)[inside].max() <= STEP


def test_a_picture_of_another_scene(renderer):
    inner = cc.Scene(background=(0.1, 0.2, 0.3))
    inner.add(
        cc.Mesh.box((1, 0.5, 0.5)), cc.BasicMaterial(color=(1, 0.6, 0)), position=(0.4, 0.3, 0)
    )
    texture = cc.RenderTexture(
        inner, cc.OrthographicCamera(height=2, position=(0, 0, 3)), size=(32, 32)
    )
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1.5), cc.BasicMaterial(map=texture))
    view = cc.PerspectiveCamera(position=(0.5, 0.4, 3), target=(0, 0, 0))
    exact = cc.truth.render(scene, view, SIZE, samples=1)
    got = renderer.render(scene, view, SIZE, format="rgba32f")
    apart = np.abs(exact.color - got.color).max(-1)
    assert (apart <= 2 * STEP).mean() > 0.97  # the rest lies on edges
    assert (exact.color[..., 0] > 0.9).mean() > 0.02


# Probes that see each other.

WHITE = cc.CubeMap(np.ones((6, 1, 1, 3), np.float32))


def facing_planes(bounces, order=(-1, 1)):
    """Two mirrors that keep a half, with a probe in the middle of each; the eye is between them."""
    scene = cc.Scene(environment=WHITE)
    half = cc.MirrorMaterial(tint=(0.5, 0.5, 0.5))
    for z in order:
        turn = cc.axis_angle((1, 0, 0), -90 * z)
        mirror = scene.add(cc.Mesh.plane(4, 4), half, position=(0, 0, z), rotation=turn)
        mirror.environment = cc.Probe(parent=mirror, size=32, format="rgba32f", bounces=bounces)
    return scene


@pytest.mark.parametrize("bounces", [1, 2, 5])
def test_mirrors_that_face_each_other(renderer, bounces):
    """Where each path meets both mirrors in turn, a probe's bounces are those of the exact rays."""
    pictures = []
    for order, ahead in itertools.product([(-1, 1), (1, -1)], (-1, 1)):
        scene = facing_planes(bounces, order)
        camera = cc.PerspectiveCamera(fov=20, position=(0, 0, -0.5 * ahead), target=(0, 0, ahead))
        exact = cc.truth.render(
            scene, camera, (12, 12), samples=1, bounces=bounces, self_hits=False, progress=False
        )
        assert np.ptp(exact.color[..., :3]) < 1e-6
        found = renderer.render(scene, camera, (12, 12), format="rgba32f")
        pictures.append(found.color)
        assert np.abs(found.color - exact.color)[..., :3].max() < 1e-6
        assert found.color[0, 0, 0] == pytest.approx(0.5 ** (bounces + 1))
    for picture in pictures:
        assert np.array_equal(picture, pictures[0])


def test_more_bounces_are_nearer_to_all_bounces(renderer):
    """Balls: the parallax of cubemaps limits how near, but no further bounce adds to the error."""
    size, errors = (48, 32), []
    camera = cc.PerspectiveCamera(fov=20, position=(0, 0, 3), target=(0, 0, 0))
    for bounces in (1, 2, 3):
        scene = cc.Scene(environment=cc.CubeMap(smooth_environment(16)))
        for x in (-0.525, 0.525):
            tint = cc.MirrorMaterial(tint=(0.9, 0.9, 0.9))
            ball = scene.add(cc.Mesh.icosphere(0.5, subdivisions=5), tint, position=(x, 0, 0))
            ball.environment = cc.Probe(parent=ball, size=64, near=0.01, bounces=bounces)
        found = renderer.render(scene, camera, size, format="rgba32f", outputs=("id",))
        for of in (bounces, 8):
            exact = cc.truth.render(
                scene, camera, size, samples=1, bounces=of, self_hits=False, progress=False
            )
            difference = (found.color - exact.color)[found.id > 0, :3]
            errors.append(float(np.sqrt((difference**2).mean())))
    same, all_of_them = errors[::2], errors[1::2]
    assert max(same[1:]) < same[0]
    assert all_of_them[1] < all_of_them[0]
    assert all_of_them[2] < all_of_them[0]
