"""Frames of many cameras: `Renderer.render_many`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from .._calls import checked_call
from .._checks import check_room, text_of
from .._core import Camera, Frame, ImageEffect, Renderer, Scene, StereoCamera, _RenderBatch
from .._progress import bar
from ..typing import DepthFormat, Encode, Format, Tonemap
from ._outputs import OutputArrays
from .frames import FrameBatch

if TYPE_CHECKING:
    from ..typing import Pixels

__all__ = ["cameras_of", "render_many"]


@checked_call
def render_many(
    self: Renderer,
    scene: Scene,
    cameras: Iterable[Camera | StereoCamera],
    size: tuple[int, int],
    *,
    outputs: Iterable[str] = (),
    format: Format | None = "rgba8",  # noqa: A002 - as Renderer.render
    samples: int = 1,
    exposure: float = 0.0,
    tonemap: Tonemap | None = None,
    encode: Encode | None = None,
    effects: Iterable[ImageEffect] = (),
    depth_format: DepthFormat | None = "depth_component32f",
    screen_reflections: bool = False,
    max_lod_error: float = 0.0,
    progress: bool = True,
) -> FrameBatch:
    """Render a scene for many cameras, as `Renderer.render` does for one.

    The scene and the cameras are those of the moment of the call.

    Parameters
    ----------
    scene : Scene
        What is rendered.
    cameras : iterable of Camera or StereoCamera
        A frame is rendered for each.
    size : (int, int)
        (width, height) of each frame, pixels.
    outputs, format, samples, exposure, tonemap, encode, effects, depth_format, screen_reflections, max_lod_error
        As in `Renderer.render`, for all frames.
    progress : bool
        Whether a bar shows on the error stream how many frames are done, if it is a terminal and the work takes more
        than half a second.

    Returns
    -------
    FrameBatch
        ``color`` (F, H, W, 4) and outputs; the same bytes as single calls give.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.render` raises; ValueError, too, if there is no camera, or if the memory does not hold the results.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene()
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial())
    >>> cameras = [cc.PerspectiveCamera(position=(0, 0, z)) for z in (3, 4, 5)]
    >>> with cc.Renderer() as renderer:
    ...     batch = renderer.render_many(scene, cameras, (40, 30), outputs=["distance"])
    >>> batch.color.shape, batch.distance.min(axis=(1, 2)).round(1).tolist()
    ((3, 30, 40, 4), [2.0, 3.0, 4.0])
    """
    seen_by = cameras_of(cameras)
    batch = _RenderBatch(
        self,
        scene,
        seen_by,
        size,
        outputs=outputs,
        format=format,
        samples=samples,
        exposure=exposure,
        tonemap=tonemap,
        encode=encode,
        effects=effects,
        depth_format=depth_format,
        screen_reflections=screen_reflections,
        max_lod_error=max_lod_error,
    )
    made: FrameBatch | None = None
    with bar("frames", len(batch), None if progress else False) as advance:
        for number in range(len(batch)):
            frame = batch.draw(number)
            if made is None:
                made = _room_for(len(batch), frame)
            if made.color is not None:
                made.color[number] = frame.color
            for name, values in frame.outputs.items():
                made.outputs[name][number] = values
            advance(1)
    assert made is not None  # there is at least one camera
    return made


def cameras_of(cameras: Iterable[Camera | StereoCamera]) -> list[Camera | StereoCamera]:
    """Give a list of cameras, at least one."""
    if isinstance(cameras, str) or not isinstance(cameras, Iterable):
        raise TypeError(f"cameras: expected a sequence of cameras, got {text_of(cameras)}")
    seen_by = list(cameras)
    for camera in seen_by:
        if not isinstance(camera, (Camera, StereoCamera)):
            raise TypeError(
                f"cameras: expected cameras, Camera or StereoCamera, got {text_of(camera)}"
            )
    if not seen_by:
        raise ValueError("cameras: expected at least one camera, got none")
    return seen_by


def _room_for(count: int, frame: Frame) -> FrameBatch:
    """Make a batch of undefined numbers for frames like this one."""
    arrays = [*frame.outputs.values(), *([] if frame.color is None else [frame.color])]
    width, height = frame.size
    check_room(
        count * sum(array.nbytes for array in arrays),
        f"{count} frames of {width} x {height} pixels",
        "cameras",
    )
    color: Pixels | None = None
    if frame.color is not None:
        color = np.empty((count, *frame.color.shape), frame.color.dtype)
    outputs: OutputArrays = {
        name: np.empty((count, *values.shape), values.dtype)
        for name, values in frame.outputs.items()
    }
    return FrameBatch(count, frame.size, color, outputs, frame.format, frame.encoding)
