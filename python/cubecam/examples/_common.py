"""What several programs share: the six photographs, the two models, the lamp of document 000."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import cubecam as cc
from cubecam.pictures import for_screen

#: What document 000 and 001 clear the picture to.
GREY = (0.4, 0.4, 0.4, 1.0)
#: Document 000 prints no light; fixed here.
LIGHT = (5.0, 5.0, 5.0)
#: Texels along an edge of the documents' photographs.
PHOTOGRAPH = 512
#: World units: the largest extent of the bunny and the teapot, which stand in for sonic.obj and mario.obj.
ACTOR = 1.2

Picture = npt.NDArray[Any]


def photographs(images: Any = None) -> list[Picture]:
    """Give six pictures (N, N, C) in the order +X -X +Y -Y +Z -Z, as OpenGL lays faces out.

    images : six arrays, an array (6, N, N, C), six paths, or a path with {face}. None: 512 x 512 pixels of 8 bits
    each, made from the packaged photograph of a city square as a camera would, by tone mapping.
    """
    if images is None:
        return list(_city())
    if isinstance(images, str) or not isinstance(images, Sequence | np.ndarray):
        return list(cc.load_cubemap(images).faces)
    if len(images) != 6:
        raise ValueError(f"images: expected six, +X -X +Y -Y +Z -Z, got {len(images)}")
    given: Any = images  # six of a kind, which load_image and asarray check
    return [
        np.asarray(image) if hasattr(image, "__array__") else cc.load_image(image)
        for image in given
    ]


def surroundings(images: Any = None, *, mipmaps: bool = False) -> cc.CubeMap:
    """Give the six photographs as a cubemap."""
    return cc.CubeMap(photographs(images), convention="gl", mipmaps=mipmaps)


@functools.cache
def _city() -> Picture:
    # Tone mapping rounds to 8 bits; nothing is rounded before.
    cube = cc.load_environment(cc.sample_data("city.exr"), size=PHOTOGRAPH, dtype="float32")
    return np.stack([for_screen(face) for face in cube.faces])


@functools.cache
def bunny(size: float = ACTOR) -> cc.Mesh:
    """Give the bunny, centred, its largest extent `size` world units. One serves all: no program sets its vertices."""
    return cc.load_mesh(cc.sample_data("bunny.obj"), size=size)


@functools.cache
def teapot(size: float = ACTOR) -> cc.Mesh:
    """Give the teapot, centred, its largest extent `size` world units."""
    return cc.load_mesh(cc.sample_data("teapot.obj"), size=size)


def on_circle(radius: float, height: float, radians: float) -> tuple[float, float, float]:
    """Give a place on a circle round +Y, counter-clockwise seen from above; 0 is on +X."""
    return radius * math.cos(radians), height, -radius * math.sin(radians)


def picture(
    renderer: cc.Renderer,
    scene: cc.Scene,
    camera: cc.Camera | cc.StereoCamera,
    size: tuple[int, int],
    options: Any,
) -> Picture:
    """Render a frame and give its colours."""
    color: Picture = renderer.render(scene, camera, size, **options).color
    return color
