"""Scenes with shadows, and their shadows by ray casting."""

from dataclasses import dataclass
from typing import Any

import numpy as np

import cubecam as cc
from cubecam.truth import shading
from cubecam.truth.shading import normalised
from tests.gl.world import World, inner, inner_smooth
from tests.reference import raycast

COLORS = {
    "floor": (0.6, 0.6, 0.7),
    "box": (1, 0.5, 0.4),
    "wall": (0.5, 0.9, 0.4),
    "ball": (0.4, 0.6, 1),
}


def stage():
    """A box that stands on the floor, one that floats, a thin wall and a ball: all cast and receive."""
    world = World()

    def add(make, name, **place):
        return make(
            color=COLORS[name],
            material=cc.PhongMaterial(color=COLORS[name], double_sided=name == "wall"),
            **place,
        )

    add(lambda **p: world.plane(7, 6, **p), "floor", position=(0.3, 0, -0.2))
    add(lambda **p: world.box((0.8, 1.2, 0.6), **p), "box", position=(-0.9, 0.6, -0.4), degrees=25)
    add(
        lambda **p: world.box((0.7, 0.3, 0.5), **p),
        "box",
        position=(0.9, 1.3, 0.3),
        axis=(1, 2, 1),
        degrees=40,
    )
    add(
        lambda **p: world.plane(1.1, 1, **p),
        "wall",
        position=(0.5, 0.5, -1.2),
        axis=(1, 0, 0),
        degrees=90,
    )
    add(lambda **p: world.sphere(0.5, subdivisions=2, **p), "ball", position=(0.2, 0.5, 0.9))
    return world


@dataclass
class Lamp:
    """A light of cubecam, its reference light, and the width of a shadow map texel one unit away (None: no map)."""

    ours: cc.Light
    theirs: object
    texel: float | None
    far: bool = False


def lamps(size=256, radius=1.0, **more):
    """One lamp of each kind, above the stage. The texel widths are upper bounds; they follow from the scene's size."""
    shadow = cc.Shadow(size=size, radius=radius, **more)
    wide = size - 2 * (np.ceil(radius) + 2)
    return {
        "directional": Lamp(
            cc.DirectionalLight((-1, -1.7, 0.7), shadow=shadow),
            shading.Directional((-1, -1.7, 0.7)),
            8 / (size - 2),
            True,
        ),
        "spot": Lamp(
            cc.SpotLight(
                (2.2, 4, -1.8), (-2.2, -3.8, 1.8), angle=38, penumbra=0.4, decay=0.3, shadow=shadow
            ),
            shading.Spot((2.2, 4, -1.8), (-2.2, -3.8, 1.8), 38, 0.4, decay=0.3),
            2 * np.tan(np.radians(38)) / wide,
        ),
        "point": Lamp(
            cc.PointLight((-0.1, 1.9, 0.2), shadow=shadow),
            shading.Point((-0.1, 1.9, 0.2)),
            2 / wide,
        ),
    }


def around(hits, lamp, radius=1.0):
    """(share of the light, whether that share is the same around the point, cosine of the angle to the light).

    "Around" means points on the surface's plane, as far as the texels that the filter reaches, and one texel more.
    """

    def cast(points, start):
        to_light, distance = shading.way_to(lamp.theirs, points)
        return raycast.visible(hits.shapes, points, to_light, distance[..., 0], start)

    share, same = np.ones(hits.id.shape), np.ones(hits.id.shape, bool)
    to_light, distance = shading.way_to(lamp.theirs, hits.position)
    cosine = shading.dot(hits.normal, to_light)[..., 0]
    rows = hits.hit & (cosine > 0)  # other pixels are dark anyway
    points, normal, to_light = hits.position[rows], hits.normal[rows], to_light[rows]
    texel = lamp.texel * (1 if lamp.far else distance[rows])
    share[rows] = cast(points, 1e-4)
    right = normalised(np.cross(to_light, [0.3, 0.5, -0.8]))
    up = np.cross(right, to_light)
    # `widest` covers the diagonals of square texels, and the bias of about one texel.
    widest = np.sqrt(2) * (radius + 0.5) + 1.5
    for reach, angle in (
        (1, 0),
        (1, 1),
        (1, 2),
        (1, 3),
        (1, 4),
        (1, 5),
        (1, 6),
        (1, 7),
        (0.5, 0),
        (0.5, 3),
        (0.5, 5),
    ):
        turn = angle * np.pi / 4
        across = reach * widest * texel * (np.cos(turn) * right + np.sin(turn) * up)
        slide = shading.dot(normal, across) / np.maximum(cosine[rows], 0.02)[..., None]
        same[rows] &= cast(points + across - slide * to_light, 2e-3) == share[rows]
    return share, same, cosine


def lit(hits, eye, all_lamps, radius=1.0, background=(0, 0, 0)):
    """Phong with ray-cast shadows, and a mask of the pixels where they are exact."""
    color = np.zeros((*hits.id.shape, 3))
    for id_, name in enumerate(("floor", "box", "box", "wall", "ball"), start=1):
        color[hits.id == id_] = COLORS[name]
    shares: list[Any] = []
    good = np.where(hits.id == 5, inner_smooth(hits), inner(hits))
    outside = ~hits.hit & raycast.interior(hits.id)
    for lamp in all_lamps:
        if lamp.texel is None:
            shares.append(None)
            continue
        share, same, cosine = around(hits, lamp, radius)
        shares.append(share)
        good &= same | (cosine < 0)
        # The ball's facets and its shading normals do not agree on where its dark side begins. On
        # other surfaces, grazing light takes long steps from texel to texel.
        good &= (cosine < -0.3) | (cosine > np.where(hits.id == 5, 0.3, 0.05))
    want = shading.phong(
        hits.position, hits.normal, eye, color, [lamp.theirs for lamp in all_lamps],
        visibility=shares,
    )  # fmt: skip
    want[~hits.hit] = background
    return want, (good & hits.hit & (hits.id <= 5)) | outside, shares


def with_shapes(hits, shapes):
    """The hits, with the shapes that can block the light stored in them."""
    hits.shapes = shapes
    return hits
