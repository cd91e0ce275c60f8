"""Parts that several programs share: the six photographs, the two models, the lamp of document 000."""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

import cubecam as cc

if TYPE_CHECKING:
    from cubecam.typing import FilePixels, Pixels, RenderOptions

#: The background colour of documents 000 and 001.
GREY = (0.4, 0.4, 0.4, 1.0)
#: The position of the lamp, which document 000 does not print.
LIGHT = (5.0, 5.0, 5.0)
#: Texels along an edge of the documents' photographs.
PHOTOGRAPH = 512
#: World units: the largest extent of the bunny and the teapot, which stand in for sonic.obj and mario.obj.
ACTOR = 1.2

Picture: TypeAlias = "Pixels"
#: Six arrays, an array (6, N, N, C), six paths, or a path with {face}.
Photographs: TypeAlias = (
    str
    | os.PathLike[str]
    | Sequence[str | os.PathLike[str] | npt.NDArray[np.generic]]
    | npt.NDArray[np.generic]
)


def photographs(images: Photographs | None = None, sample: str = "sunset.exr") -> list[FilePixels]:
    """Return six pictures (N, N, C) in the order +X -X +Y -Y +Z -Z, in the layout of OpenGL's faces.

    images : six arrays, an array (6, N, N, C), six paths, or a path with {face}. Files that hold light, such as EXR,
    are tone-mapped. None: pictures of 512 x 512 pixels of 8 bits, like those of a camera, made from a sample
    photograph, by default that of a quay at sunset.
    """
    if images is None:
        return list(_developed(sample))
    if isinstance(images, str) or not isinstance(images, Sequence | np.ndarray):
        return [_for_screen(face) for face in cc.load_cubemap(images).faces]
    if len(images) != 6:
        raise ValueError(f"images: expected six, +X -X +Y -Y +Z -Z, got {len(images)}")
    given: Any = images  # six paths or six arrays, which load_image and asarray check
    return [
        np.asarray(image) if hasattr(image, "__array__") else _for_screen(cc.load_image(image))
        for image in given
    ]


def surroundings(
    images: Photographs | None = None, sample: str = "sunset.exr", *, mipmaps: bool = False
) -> cc.CubeMap:
    """Return the six photographs as a cubemap."""
    return cc.CubeMap(photographs(images, sample), convention="gl", mipmaps=mipmaps)


def _for_screen(pixels: FilePixels) -> FilePixels:
    """Tone-map light; the pixels of a camera's picture stay as they are."""
    return cc.to_screen(pixels) if np.issubdtype(pixels.dtype, np.floating) else pixels


@functools.cache
def _developed(sample: str) -> Picture:
    """Make six pictures of a panorama of light.

    A panorama of 1024 pixels has 256 for a face, half as many as the documents' photographs have. Linear interpolation
    between so few is visible as blur. Therefore the panorama is first enlarged by Lanczos' filter and sharpened, as
    cameras sharpen their pictures.
    """
    from PIL import Image, ImageFilter

    panorama = cc.to_screen(cc.load_image(cc.sample_data(sample)))[..., :3]
    height, width = panorama.shape[:2]
    times, margin = 2, 16  # the left border goes on at the right one
    around = np.concatenate([panorama[:, -margin:], panorama, panorama[:, :margin]], axis=1)
    size = (times * around.shape[1], times * height)
    large = Image.fromarray(around).resize(size, Image.Resampling.LANCZOS)
    sharp = np.asarray(large.filter(ImageFilter.UnsharpMask(radius=1.2, percent=100, threshold=0)))
    inner = sharp[:, times * margin : times * (margin + width)]
    return cc.CubeMap.from_equirect(inner, size=PHOTOGRAPH).faces


@functools.cache
def bunny(size: float = ACTOR) -> cc.Mesh:
    """Return the bunny, centred, with a largest extent of `size` world units. All programs share it unchanged."""
    return cc.load_mesh(cc.sample_data("bunny.obj"), size=size)


@functools.cache
def teapot(size: float = ACTOR) -> cc.Mesh:
    """Return the teapot, centred, with a largest extent of `size` world units."""
    return cc.load_mesh(cc.sample_data("teapot.obj"), size=size)


def on_circle(radius: float, height: float, radians: float) -> tuple[float, float, float]:
    """Return a place on a circle round +Y, counter-clockwise seen from above; 0 is on +X."""
    return radius * math.cos(radians), height, -radius * math.sin(radians)


def squares(count: int) -> cc.Image:
    """Return a pattern of light and dark squares, `count` along an edge, for a ground that shows what lies over it."""
    rows, columns = np.indices((count, count))
    shade = np.where((rows + columns) % 2 == 0, 255, 150).astype(np.uint8)
    return cc.Image(np.repeat(shade[..., None], 3, axis=2), mag_filter="nearest")


def picture(
    renderer: cc.Renderer,
    scene: cc.Scene,
    camera: cc.Camera | cc.StereoCamera,
    size: tuple[int, int],
    options: RenderOptions,
) -> Picture:
    """Render a frame and return its colours."""
    return renderer.render(scene, camera, size, **options).color
