"""A crowd of things under small edits, each picture of it against that of a renderer which keeps nothing."""

import dataclasses
from typing import Any

import numpy as np

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import smooth_environment
from tests.reference.stencil import FUNCS, OPS, Stencil

STEPS = 12

#: COMBINATIONS and COLORLESS hold options of pictures: the first has formats and depth formats,
#: the second has pictures without a color buffer and a picture of few bits.
COMBINATIONS: dict[str, dict[str, Any]] = {
    "565": {"format": "rgb565"},
    "565 samples": {"format": "rgb565", "samples": 4},
    "16 bits": {"depth_format": "depth_component16", "outputs": ("depth", "id")},
    "16 bits samples": {
        "depth_format": "depth_component16", "outputs": ("depth",), "samples": 4, "format": "rgb565"
    },
    "24 bits": {"depth_format": "depth_component24", "outputs": ("depth", "normal")},
    "stencil": {"depth_format": "depth24_stencil8", "outputs": ("depth", "stencil")},
    "float and stencil": {"depth_format": "depth32f_stencil8", "outputs": ("depth", "id")},
    "painter": {"depth_format": None},
    "painter samples": {"depth_format": None, "samples": 4},
    "painter with a stencil": {"depth_format": "stencil_index8", "outputs": ("stencil",)},
}  # fmt: skip
COLORLESS: dict[str, dict[str, Any]] = {
    "depth only": {"format": None, "outputs": ("depth",)},
    "16 bits only": {
        "format": None, "depth_format": "depth_component16", "outputs": ("depth", "z"), "samples": 4
    },
    "stencil only": {"format": None, "depth_format": "stencil_index8", "outputs": ("stencil",)},
    "graded": {"format": "rgb565", "tonemap": "aces", "encode": "srgb"},
}  # fmt: skip


def crowd(rng, offset=(0, 0, 0), size=4.0):
    """Opaque, translucent, textured and mirrored things of all sizes, some of them touching."""
    scene = cc.Scene(environment=cc.CubeMap(smooth_environment(16), mipmaps=True))
    scene.add(cc.PointLight(position=np.add(offset, (2, 5, 3))))
    root = scene.add(position=offset)
    picture = rng.integers(0, 256, (16, 16, 3), dtype=np.uint8)
    materials = [
        cc.PhongMaterial(color=(1, 0.5, 0.2)),
        cc.BasicMaterial(color=(0.2, 0.8, 1), opacity=0.5, double_sided=True),
        cc.MirrorMaterial(),
        cc.BasicMaterial(map=cc.Image(picture, mipmaps=True)),
        cc.GlassMaterial(opacity=0.7),
    ]
    meshes = [cc.Mesh.box(1), cc.Mesh.sphere(0.6, segments=12, rings=6), cc.Mesh.plane(1.5, 1)]
    for index in range(14):
        scene.add(
            meshes[index % 3],
            materials[index % 5],
            position=rng.uniform(-size / 2, size / 2, 3),
            rotation=cc.axis_angle(rng.normal(size=3), rng.uniform(0, 360)),
            scale=rng.uniform(0.05, 1.2, 3),
            parent=root,
        )
    return scene


def random_stencil(rng):
    if rng.random() < 0.15:
        return None
    return Stencil(
        func=rng.choice(list(FUNCS), p=[0.04] + [0.12] * 6 + [0.24]),
        reference=int(rng.choice([0, 1, 2, 3, 255, 254, rng.integers(256)])),
        read_mask=int(rng.choice([255, 255, 1, 3, rng.integers(256)])),
        write_mask=int(rng.choice([255, 255, 255, 6, rng.integers(256)])),
        fail=rng.choice(list(OPS)),
        depth_fail=rng.choice(list(OPS)),
        depth_pass=rng.choice(list(OPS)),
    )


def ours(stencil):
    return None if stencil is None else cc.Stencil(**dataclasses.asdict(stencil))


def masked_crowd(rng):
    """The crowd with random stencils and orders."""
    scene = crowd(rng)
    for node in scene.nodes[1:]:
        node.material = type(node.material)(
            opacity=node.material.opacity, double_sided=True, stencil=ours(random_stencil(rng))
        )
        node.render_order = rng.integers(-2, 3)
    return scene


def small_edit(scene, rng):
    """Change one random node a little, as an animation does."""
    node = scene.nodes[rng.integers(1, len(scene.nodes))]
    kind = rng.integers(7)
    if kind == 0:
        node.position = np.array(node.position) + rng.normal(size=3) * 0.3
    elif kind == 1:
        node.rotation = cc.axis_angle(rng.normal(size=3), rng.uniform(0, 360))
    elif kind == 2:
        node.scale = rng.uniform(0.02, 1.5, 3) * rng.choice([-1, 1])
    elif kind == 3:
        node.visible = not node.visible
    elif kind == 4:
        node.label = rng.integers(-2, 3)
    elif kind == 5 and node.material is not None:
        node.material.flat_shading = not node.material.flat_shading
    else:
        node.position = rng.uniform(-3, 3, 3)


def follow(live, scratch, draw, scene, rng, names):
    for step in range(STEPS):
        for _ in range(rng.integers(1, 3)):
            small_edit(scene, rng)
        got, want = draw(live), draw(scratch)
        for name in names:
            assert_identical(getattr(got, name), getattr(want, name), f"{name} of step {step}")
