"""Each way to reflect what is near: in frames and captures, on both paths, translucent, shadowed, in light above 1."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical

LOW, HIGH = (-3, -2, -3), (3, 2, 3)
EYE = (0.3, 0.2, 2.2)
LAMP = 24.0
BALL, SHEET = cc.Mesh.sphere(0.6, 32, 16), cc.Mesh.plane(1.6, 1.4)
UPRIGHT = cc.axis_angle((1, 0, 0), 90)  # the sheet's normal is +Z


def probe(**options):
    return lambda node: cc.Probe(parent=node, size=32, format="rgba32f", **options)


def blend(node):
    options: dict[str, Any] = {"size": 32, "format": "rgba32f", "exclude": [node]}
    return cc.ProbeBlend(
        [
            cc.Probe(
                (x, 0, 0), influence=((x - 1, -1, -1), (x + 1, 1, 1)), blend_distance=0.8, **options
            )
            for x in (-1, 1)
        ]
    )


#: What a node sees, and what it is made of.
WAYS: dict[str, tuple[Callable[..., Any], Callable[..., cc.Material], cc.Mesh]] = {
    "plain": (probe(), cc.MirrorMaterial, BALL),
    "box": (probe(parallax="box", box=(LOW, HIGH)), cc.MirrorMaterial, BALL),
    "sphere": (probe(parallax="sphere", box=(LOW, HIGH)), cc.MirrorMaterial, BALL),
    "distance": (probe(parallax="distance"), cc.MirrorMaterial, BALL),
    "layers": (probe(parallax="layers"), cc.MirrorMaterial, BALL),
    "bounces": (probe(parallax="distance", bounces=2), cc.MirrorMaterial, BALL),
    "rough": (
        probe(parallax="layers"),
        lambda **look: cc.StandardMaterial(color=(1, 1, 1), metallic=1, roughness=0.3, **look),
        BALL,
    ),
    "planar": (lambda node: cc.PlanarMirror(), cc.MirrorMaterial, SHEET),
    "glass": (
        probe(parallax="distance"),
        lambda **look: cc.GlassMaterial(surfaces=2, fresnel=False, **look),
        BALL,
    ),
    "blend": (blend, cc.MirrorMaterial, BALL),
}


def world(way, **look):
    """A room with lamps far above 1, a light, posts that throw shadows, and the reflector."""
    environment, material, mesh = WAYS[way]
    scene = cc.Scene(background=(0, 0, 0))
    walls = cc.PhongMaterial(color=(0.7, 0.6, 0.5), ka=0, kd=1, ks=0, double_sided=True)
    scene.add(cc.Mesh.box(1), walls, scale=np.subtract(HIGH, LOW))
    lamp = cc.BasicMaterial(color=(LAMP, LAMP / 2, 0))
    for z in (2.6, -2.6):  # before mirrors and behind glass
        scene.add(cc.Mesh.box(1), lamp, position=(1.2, 0.6, z))
    scene.add(cc.Mesh.box(0.5), walls, position=(-0.9, 0.1, 2.3))
    scene.add(cc.Mesh.box(0.5), walls, position=(-0.9, 0.1, -2.3))
    light = cc.PointLight((0.2, 1.5, 1.2), decay=0, shadow=cc.Shadow(size=128))
    scene.add(light)
    node = scene.add(mesh, material(**look), rotation=UPRIGHT if mesh is SHEET else None)
    node.cast_shadow = False  # what is half there throws half a shadow
    node.environment = environment(node)
    return scene, node, light


def captured(renderer, scene, node):
    """The colours (6, N, N, 3) of a capture, and the pixels of the node."""
    cube = renderer.capture(scene, EYE, size=40, format="rgba32f", outputs=("id",))
    return np.asarray(cube.faces)[..., :3].astype(float), cube.outputs["id"] == node.id


@pytest.mark.parametrize("way", WAYS)
def test_a_capture_is_the_same_on_any_path_and_a_face_is_what_a_camera_sees(
    way, any_path, renderer
):
    scene, node, _ = world(way)
    cube, other = (by.capture(scene, EYE, size=40, format="rgba32f") for by in (any_path, renderer))
    assert_identical(cube.faces, other.faces, across="programs")
    camera = cc.PerspectiveCamera(position=EYE, target=np.subtract(EYE, (0, 0, 1)), fov=90)
    frame = renderer.render(scene, camera, (40, 40), format="rgba32f", outputs=("id",))
    on = frame.outputs["id"] == node.id
    assert on.sum() > 60
    # Seen as a picture, a face is the mirror image of what the camera sees.
    off = np.abs(np.asarray(cube.faces)[5][:, ::-1, :3] - frame.color[..., :3]).max(axis=-1)[on]
    assert np.quantile(off, 0.95) < 1e-3


@pytest.mark.parametrize("way", WAYS)
def test_light_above_1_is_reflected_as_it_is(way, any_path):
    scene, node, _ = world(way)
    faces, on = captured(any_path, scene, node)
    # The two probes of the blend have the lamp at two places.
    share = {"rough": 0.2, "blend": 0.45}.get(way, 0.95)
    assert faces[on].max() > share * LAMP
    assert np.isfinite(faces).all()


@pytest.mark.parametrize("way", WAYS)
def test_what_is_reflected_has_shadows(way, any_path):
    scene, node, light = world(way)
    with_shadows, on = captured(any_path, scene, node)
    light.shadow = None
    without, _ = captured(any_path, scene, node)
    change = (without - with_shadows)[on]
    assert change.max() > 0.1
    assert change.min() > (-0.02 if way == "rough" else -1e-4)  # a shadow makes nothing brighter


@pytest.mark.parametrize("way", WAYS)
def test_half_of_a_reflector_is_half_of_what_it_shows(way, any_path):
    opaque, node, _ = world(way)
    whole, on = captured(any_path, opaque, node)
    half, node, _ = world(way, opacity=0.5)
    share, _ = captured(any_path, half, node)
    node.visible = False
    behind, _ = captured(any_path, half, node)
    want = 0.5 * whole + 0.5 * behind
    inner = on & np.roll(on, 1, 1) & np.roll(on, -1, 1) & np.roll(on, 1, 2) & np.roll(on, -1, 2)
    assert inner.sum() > 60
    assert np.abs(share - want)[inner].max() < 2e-3 * LAMP
    assert np.abs(whole - behind)[inner].max() > 0.1
