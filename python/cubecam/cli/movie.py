"""MP4 files by the command ffmpeg, where there is one."""

from __future__ import annotations

import contextlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from .._core import FileError
from ..io.files import PathLike, as_path, replacing


def find_ffmpeg(path: Path) -> str:
    """Give the command's path, or a FileError that says what to do about it; path is the file that needs it."""
    command = shutil.which("ffmpeg")
    if command is None:
        raise FileError(
            f"{path}: expected the command ffmpeg on PATH to write .mp4, found none; "
            ".png, .gif and .webp need nothing else"
        )
    return command


def save_mp4(path: PathLike, frames: Iterable[Any], fps: float) -> None:
    """Write uint8 pictures (H, W, 3 or 4), all of one size, as a film; alpha is left out.

    Sides of an odd number of pixels get one more, in black: the format wants even ones. Raises FileError
    without ffmpeg and when it fails, ValueError for pictures that do not fit, OSError as `save_image`.
    """
    target = as_path(path)
    command = find_ffmpeg(target)
    pictures = iter(frames)
    first = _pixels(next(pictures, None), None)
    height, width = first.shape[:2]
    with replacing([target]) as (temporary,), tempfile.TemporaryFile() as complaints:
        process = subprocess.Popen(
            [
                command, "-y", "-loglevel", "error",
                "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{fps:g}", "-i", "-",
                "-an", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
                "-movflags", "+faststart", "-f", "mp4", str(temporary),
            ],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=complaints,
        )  # fmt: skip
        assert process.stdin is not None
        try:
            # A pipe that breaks is told of below, in ffmpeg's words.
            with contextlib.suppress(BrokenPipeError):
                process.stdin.write(first.tobytes())
                for picture in pictures:
                    process.stdin.write(_pixels(picture, first.shape).tobytes())
            with contextlib.suppress(BrokenPipeError):
                process.stdin.close()
            status = process.wait()
        except BaseException:
            process.kill()
            process.wait()
            raise
        if status != 0 or temporary.stat().st_size == 0:
            complaints.seek(0)
            told = complaints.read().decode("utf-8", "replace").strip()[-500:]
            raise FileError(
                f"{target}: ffmpeg ended with status {status}: {told or 'no reason given'}"
            )


def _pixels(picture: Any, shape: tuple[int, ...] | None) -> Any:
    if picture is None:
        raise ValueError("frames: expected at least one picture, got none")
    pixels = np.asarray(picture)
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise ValueError(
            f"frames: expected uint8 pictures (H, W, 3 or 4), got {pixels.dtype} {pixels.shape}"
        )
    pixels = np.ascontiguousarray(pixels[..., :3])
    if shape is not None and pixels.shape != shape:
        raise ValueError(f"frames: expected one size, got {shape} and {pixels.shape}")
    return pixels
