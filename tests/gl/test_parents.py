"""Pictures by cameras and lights that follow nodes equal those by ones that stand where the nodes put them."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import shading
from tests.compare import assert_close, assert_identical
from tests.gl.world import World, inner, perspective

SIZE = (40, 30)
SHADOW = cc.Shadow(size=32)
PLACE, WAY = (0.1, 0.4, 0.2), (-0.2, -1, -0.1)
KINDS = {
    "point": lambda place, way, **more: cc.PointLight(place, **more),
    "spot": lambda place, way, **more: cc.SpotLight(place, way, angle=50, penumbra=0.5, **more),
    "sun": lambda place, way, **more: cc.DirectionalLight(way, **more),
}


def stage():
    scene = cc.Scene(background=(0.1, 0.2, 0.3))
    scene.add(cc.Mesh.plane(8, 8), cc.PhongMaterial())
    scene.add(cc.Mesh.box(0.7), cc.StandardMaterial(color=(0.9, 0.4, 0.2)), position=(0.3, 0.5, 0))
    return scene


def shot(renderer, scene, camera=None):
    camera = camera or cc.PerspectiveCamera(position=(2, 3, 4), target=(0, 0.3, 0))
    return renderer.render(scene, camera, SIZE, format="rgba32f").color


@pytest.mark.parametrize("shadow", [None, SHADOW])
@pytest.mark.parametrize("elsewhere", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_lights(renderer, fresh_renderer, kind, elsewhere, shadow):
    scene = stage()
    other = cc.Scene() if elsewhere else scene
    crane = other.add(position=(0, 2, 0))
    hook = other.add(position=(0.5, 0, 0.5), parent=crane)
    scene.add(KINDS[kind](PLACE, WAY, intensity=2, shadow=shadow, parent=hook))
    for turn in (0, 35, 90):
        crane.rotation = cc.axis_angle((0.2, 1, 0.4), turn)
        hook.scale = 1 + turn / 50
        got = shot(renderer, scene)
        free = stage()
        matrix = hook.world_matrix
        place = (matrix @ (*PLACE, 1))[:3]
        free.add(KINDS[kind](place, matrix[:3, :3] @ WAY, intensity=2, shadow=shadow))
        assert_close(got, shot(fresh_renderer, free), "lookup")
        drawn = renderer.stats.views_drawn
        assert drawn == 1
        assert_identical(shot(renderer, scene), got)
        assert renderer.stats.views_drawn == 0


@pytest.mark.parametrize("elsewhere", [False, True])
def test_cameras(renderer, fresh_renderer, elsewhere):
    scene = stage()
    scene.add(cc.PointLight((2, 4, 1)))
    other = cc.Scene() if elsewhere else scene
    cart = other.add(scale=2)
    seat = other.add(position=(0, 0.5, 2), parent=cart)
    camera = scene.add(cc.PerspectiveCamera(position=(0.1, 0.2, 0), target=(0, 0, -1), parent=seat))
    for turn in (0, 50):
        cart.rotation = cc.axis_angle((0, 1, 0), turn)
        matrix = seat.world_matrix
        free = cc.PerspectiveCamera(
            position=camera.world_position,
            target=(matrix @ (0, 0, -1, 1))[:3],
            up=matrix[:3, 1],
        )
        assert_identical(shot(renderer, scene, camera), shot(fresh_renderer, scene, free))
    eyes = cc.StereoCamera.off_axis(camera, separation=0.1)
    cart.position = (0.5, 0, 0)
    step = np.array((0.5, 0, 0))
    free.position, free.target = free.position + step, free.target + step
    same = cc.StereoCamera.off_axis(free, separation=0.1)
    assert_close(shot(renderer, scene, eyes), shot(fresh_renderer, scene, same), "lookup")


def test_cameras_of_render_textures(renderer, fresh_renderer):
    inner_scene = stage()
    inner_scene.add(cc.PointLight((2, 4, 1)))
    scene = cc.Scene()
    cart = inner_scene.add(position=(0, 1, 4))
    outside = scene.add(position=(0, 1, 4))
    for parent in (cart, outside):
        texture = cc.RenderTexture(inner_scene, cc.PerspectiveCamera(parent=parent), size=(16, 12))
        screen = scene.add(cc.Mesh.plane(2, 2), cc.BasicMaterial(map=texture))
        camera = cc.PerspectiveCamera(position=(0, 2, 0.1), target=(0, 0, 0))
        before = shot(renderer, scene, camera)
        parent.position = (0.3, 1.2, 3)
        after = shot(renderer, scene, camera)
        assert (before != after).any()
        assert_identical(after, shot(fresh_renderer, scene, camera))
        free = cc.PerspectiveCamera(position=(0.3, 1.2, 3))
        screen.material = cc.BasicMaterial(map=cc.RenderTexture(inner_scene, free, size=(16, 12)))
        assert_identical(after, shot(fresh_renderer, scene, camera))
        scene.remove(screen)


RANGED = """vec4 shade(Surface s) {
    LightSample light = sample_light(0, s);
    return vec4(max(dot(s.normal, light.direction), 0.) * light.radiance, 1.);
}"""


@pytest.mark.parametrize("count", [1, 7])
@pytest.mark.parametrize("material", ["phong", "standard", "shader"])
def test_ranges(renderer, material, count):
    """The share of light that a range leaves, among lights with and without one."""
    made = {
        "phong": cc.PhongMaterial(color=(1, 1, 1), ka=0, kd=1, ks=0),
        "standard": cc.StandardMaterial(metallic=0, specular_weight=0, roughness=1),
        "shader": cc.ShaderMaterial(RANGED),
    }[material]
    world = World()
    world.plane(8, 8, material=made)
    world.scene.add(cc.PointLight((0.4, 1, -0.3), decay=2, range=2.2))
    for x in range(count - 1):
        world.scene.add(cc.PointLight((x, -1, 0), intensity=1))  # below the plane: none of it shows
    view = perspective((1, 4, 3), (0, 0, 0))
    got = renderer.render(world.scene, view.camera, view.size, format="rgba32f").color
    hits = view.hits(world.shapes)
    lamp = shading.Point((0.4, 1, -0.3), decay=2, range=2.2)
    to_light, distance = shading.way_to(lamp, hits.position)
    want = np.maximum(shading.dot(hits.normal, to_light), 0) * shading.falloff(lamp, distance)
    want = want / np.pi if material == "standard" else want
    mask = inner(hits) & hits.hit
    assert (want[mask] == 0).any()
    assert (want[mask] > 0).any()
    assert_close(got[..., :3], np.broadcast_to(want, got[..., :3].shape), "phong", mask=mask)


def test_time_moves_little(fresh_renderer):
    """An animation reads again what it moved, and nothing is drawn where the time gives the same places."""
    scene = stage()
    scene.add(cc.PointLight((2, 4, 1)))
    box = scene.nodes[1]
    channel = cc.AnimationChannel(
        box, "translation", [0, 1], [(0, 0.5, 0), (1, 0.5, 0)], interpolation="step"
    )
    scene.add(cc.Animation([channel]))
    pictures = {}
    for seconds in (0, 0.5, 1, 0.7):
        scene.set_time(seconds)
        pictures[seconds] = shot(fresh_renderer, scene)
        assert fresh_renderer.stats.views_drawn == (0 if seconds == 0.5 else 1)
    assert (pictures[0] != pictures[1]).any()
    assert_identical(pictures[0], pictures[0.7])


def test_variants_are_drawn(renderer, fresh_renderer):
    scene = stage()
    scene.add(cc.AmbientLight())
    scene.variants = ["red"]
    plain = shot(renderer, scene)
    scene.nodes[0].variants = {"red": cc.BasicMaterial(color=(1, 0, 0))}
    assert_identical(shot(renderer, scene), plain)
    scene.variant = "red"
    red = shot(renderer, scene)
    assert (red[-1, :, :3] == (1, 0, 0)).all()
    assert_identical(red, shot(fresh_renderer, scene))
    scene.variant = None
    assert_identical(shot(renderer, scene), plain)


def test_names_and_cameras_draw_nothing_again(fresh_renderer):
    scene = stage()
    shot(fresh_renderer, scene)
    scene.nodes[0].material.name = "floor"
    scene.add(cc.PerspectiveCamera())
    shot(fresh_renderer, scene)
    assert fresh_renderer.stats.views_drawn == 0
