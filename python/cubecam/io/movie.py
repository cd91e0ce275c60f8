"""Write MP4 files with ffmpeg: that of the package imageio-ffmpeg, or the command on PATH."""

from __future__ import annotations

import contextlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from .._core import FileError, _to_array
from .files import PathLike, as_path
from .writing import replacing


def find_ffmpeg(path: Path) -> str:
    """Return the path of ffmpeg; raise FileError if there is none. `path` is the file to write.

    The program of imageio-ffmpeg is preferred, which every one who has that package has in the same version; its
    variable IMAGEIO_FFMPEG_EXE names another one.
    """
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (
        ImportError,
        RuntimeError,
    ):  # RuntimeError: the package without a program for this machine
        command = shutil.which("ffmpeg")
    if command is None:
        raise FileError(
            f"{path}: expected the package imageio-ffmpeg or the command ffmpeg on PATH to write .mp4, found neither; "
            'pip install "cubecam[video]" installs the package, and .png, .gif and .webp need none'
        )
    return command


def save_mp4(path: PathLike, frames: Iterable[Any], fps: float) -> None:
    """Write uint8 pictures (H, W, 3 or 4), all of one size, as a film without alpha.

    The format needs even sides, so a side of an odd number of pixels gets one more pixel, in black. Raises FileError if
    ffmpeg is missing or fails, ValueError for pictures of another type or size, and OSError as `save_image` does.
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
            # A broken pipe is reported below, with the message of ffmpeg.
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
    pixels = _to_array(picture, "frames")
    if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
        raise ValueError(
            f"frames: expected uint8 pictures (H, W, 3 or 4), got {pixels.dtype} {pixels.shape}"
        )
    pixels = np.ascontiguousarray(pixels[..., :3])
    if shape is not None and pixels.shape != shape:
        raise ValueError(f"frames: expected one size, got {shape} and {pixels.shape}")
    return pixels
