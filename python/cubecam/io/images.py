"""Read and write pictures. Row 0 is on top.

Numbers of arrays are raw, unless an option says otherwise; objects are written as a screen shows them.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap, Frame, Image
from ..typing import FilePixels, Tonemap
from .cubemap_save import save_cubemap
from .files import PathLike, as_path
from .formats import FORMATS, decode, encode, fit_samples, for_file, holds_light, is_opaque
from .picture_files import Part, read_picture
from .pixels import Array, FloatArray, check_picture, on_color, to_float32
from .screen import (
    CURVES,
    Clipping,
    Picture,
    check_look,
    curve_for,
    exposed,
    numbers_of,
)
from .writing import write_files

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt

__all__ = ["load_image", "save_animation", "save_frame", "save_image"]


@checked_call
def load_image(path: PathLike, *, srgb: bool = False, part: Part | None = None) -> FilePixels:
    """Read a picture as it is stored.

    Parameters
    ----------
    path : str or os.PathLike
        A file in EXR, HDR, PNG, JPEG, TIFF, WebP, DDS, KTX2 or another format that OpenImageIO reads. The format
        follows from the contents, not from the name.
    srgb : bool
        True decodes files of 8 and 16 bits from the sRGB curve (IEC 61966-2-1) to linear float32; alpha stays as it
        is. Files of floating-point numbers are linear already and stay as they are.
    part : int or str, optional
        Which picture of a file that holds several: a number from 0 on (the parts of an EXR, the pages of a TIFF, the
        frames of a GIF or WebP, the faces of a DDS or KTX2 cubemap), or the name of a part, a view or a layer of an
        EXR, or of a face ("+X") of a cubemap. None: the first part of an EXR with the channels R, G, B, else with Y; of
        other files the first picture.

    Returns
    -------
    ndarray (H, W, C)
        C is 1, 3 or 4, row 0 on top. uint8 for 8 bits (float32 of value/255 decoded with `srgb`), float32 of
        value/65535 for 16 bits, float16 for half, float32 for float, uint32 for an EXR of whole numbers.
        Grey with alpha and palettes become RGB or RGBA. PNG colour is not multiplied by alpha. The array belongs to the
        caller.

    Raises
    ------
    OSError
        If there is no file of that name (FileNotFoundError), or it may not be read.
    ImageError
        If the contents are not a picture, end early, or claim more pixels than their bytes can hold; for kinds that are
        not read, such as deep EXR and KTX2 of ASTC; for a DDS or KTX2 cubemap, which `load_cubemap` reads, without
        `part`; for KTX2 of Zstandard or Basis Universal without the packages of the extra "ktx2".
    ValueError
        For a part that the file does not have.

    Notes
    -----
    The pixels of an EXR are those of its display window, 0 outside the data window. The numbers of a Radiance file are
    component / 256 * 2**(exponent - 128), divided by its EXPOSURE and COLORCORR, in any orientation and coding; XYZ is
    converted to RGB of Radiance's primaries and white, and may be below 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> studio = cc.load_image(cc.sample_data("studio.exr"))
    >>> studio.shape, studio.dtype.name, float(studio.max())
    ((512, 1024, 3), 'float16', 616.5)
    """
    picture = read_picture(path, part)
    return decode(picture.pixels, srgb, picture.encoding)


@checked_call
def save_image(
    path: PathLike,
    pixels: npt.ArrayLike | Picture,
    *,
    srgb: bool | None = None,
    half: bool = False,
    exposure: float = 0.0,
    tonemap: Tonemap | Literal["auto"] | None = "auto",
) -> None:
    """Write a frame, a cubemap or an array as a picture; the extension names the kind of file.

    A Frame, a CubeMap or an Image is written as a screen shows it, unless the file holds linear numbers; an array is
    written as it is.

    Parameters
    ----------
    path : str or os.PathLike
        A name that ends in .exr, .hdr, .png, .jpg, .tif, .webp, .bmp or .tga.
    pixels : Frame, CubeMap, Image or array_like (H, W) or (H, W, C), C of 1, 3 or 4
        Row 0 on top. A cubemap is written as `CubeMap.save` writes it by default, as a cross.
    srgb : bool, optional
        Whether a file of 8 or 16 bits holds sRGB-encoded numbers. EXR, HDR and float TIFF hold linear numbers and are
        never encoded.

        Of an object: None and True encode what is linear, and leave what is encoded; False writes the numbers
        as they are. Of an array: True encodes it (uint8 is taken as value/255); None and False write it as it is.
    half : bool
        True stores an EXR with 16 bits a number, half the bytes, three digits, up to 65504.
    exposure : float
        Stops: colours are multiplied by ``2**exposure``.
    tonemap : {"neutral", "reinhard", "aces", "auto"} or None
        The curve that maps floats into 0..1 for files of 8 and 16 bits, see `to_screen`. None clips, with a warning.
        "auto" is "neutral" for objects and None for arrays.

    Raises
    ------
    OSError
        If the folder does not exist or may not be written, or the disk is full. The old file stays as it was.
    ValueError
        For an extension that is not in the list, a shape of no picture, numbers that the file cannot hold, a frame
        without a colour, or a look (exposure, tone curve) of ids or of numbers that are written as they are.
    TypeError
        For bool, complex, object or text.

    Warns
    -----
    ClippingWarning
        If numbers above 1 are clipped for a file of 8 or 16 bits.

    Notes
    -----
    ========================  =========================================================================
    file                      numbers
    ========================  =========================================================================
    EXR                       float16 as half, float32 as float (NaN and infinity too), uint8 as half of
                              value/255, other whole numbers exactly, as 32-bit unsigned: id maps
    HDR                       float32, three channels of a shared exponent: one per cent; below 0 becomes 0;
                              infinity and NaN are refused
    PNG, JPEG, ...            uint8 as it is; floats clipped to 0..1 and rounded to 0..255; NaN is refused
    PNG, TIFF                 uint16 as it is; other whole numbers 0..65535 as they are, in 16 bits: id maps
    TIFF                      floats as float32
    ========================  =========================================================================

    One channel is written as grey if the format allows it, else as three equal channels (HDR, WebP). HDR, JPEG and
    BMP hold no alpha: a fourth channel is left out if it is 1 everywhere; otherwise it raises ValueError. WebP loses
    the colour where alpha is 0. JPEG is written at quality 95 without colour subsampling.

    Examples
    --------
    >>> import cubecam as cc, numpy as np, tempfile, pathlib
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> depth = np.array([[1.5, np.inf]], dtype=np.float32)
    >>> cc.save_image(folder / "depth.exr", depth)
    >>> cc.load_image(folder / "depth.exr")[..., 0]
    array([[1.5, inf]], dtype=float32)
    """
    target = as_path(path)
    if isinstance(pixels, CubeMap):
        curve: Tonemap | None = "neutral" if tonemap == "auto" else tonemap
        save_cubemap(pixels, target, srgb=srgb, half=half, exposure=exposure, tonemap=curve)
        return
    write_files({target: encode_picture(target, pixels, srgb, half, exposure, tonemap)})


@checked_call
def save_frame(
    frame: Frame,
    path: PathLike,
    *,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    srgb: bool | None = None,
    half: bool = False,
) -> None:
    """Write the frame's colour as a picture. The method `Frame.save`.

    A file of 8 bits holds what a screen shows: linear floats are mapped by the tone curve, then everything linear is
    sRGB-encoded. EXR and HDR hold linear numbers.

    Parameters
    ----------
    path : str or os.PathLike
        The extension names the kind of file, as in `save_image`.
    exposure : float
        Stops: colours are multiplied by ``2**exposure``.
    tonemap : {"neutral", "reinhard", "aces"} or None
        The curve for linear floats, see `to_screen`. None clips, with a warning.
    srgb : bool, optional
        False writes the numbers as they are; None and True as described above.
    half : bool
        True stores an EXR with 16 bits a number.

    Raises
    ------
    OSError
        If the folder does not exist or may not be written, or the disk is full. The old file stays as it was.
    ValueError
        For a frame without a colour, an extension that is not in the list, or an alpha that the file cannot hold.

    Examples
    --------
    >>> import cubecam as cc, tempfile, pathlib
    >>> path = pathlib.Path(tempfile.mkdtemp(), "frame.png")
    >>> with cc.Renderer() as renderer:
    ...     frame = renderer.render(cc.Scene(background=(0.2, 0.2, 0.2)), cc.PerspectiveCamera(), size=(2, 1))
    >>> frame.save(path)
    >>> cc.load_image(path)[0, 0].tolist()
    [124, 124, 124, 255]
    """
    target = as_path(path)
    write_files({target: encode_picture(target, frame, srgb, half, exposure, tonemap)})


def encode_picture(
    target: Path,
    pixels: npt.ArrayLike | Picture,
    srgb: bool | None = None,
    half: bool = False,
    exposure: float = 0.0,
    tonemap: Tonemap | Literal["auto"] | None = "auto",
) -> bytes:
    """Turn a picture into the bytes of the file that `target` names, by the rules of `save_image`."""
    numbers, encoded = prepare(pixels, target, srgb, exposure, tonemap)
    return encode(target, numbers, srgb=encoded, half=half)


def prepare(
    pixels: npt.ArrayLike | Picture,
    target: Path,
    srgb: bool | None,
    exposure: float,
    tonemap: Tonemap | Literal["auto"] | None,
    name: str = "pixels",
) -> tuple[Array, bool]:
    """Give the numbers to write and whether they are still to be sRGB-encoded."""
    if isinstance(pixels, (Frame, Image)):
        numbers, encoding = numbers_of(pixels)
        named: Tonemap | None = "neutral" if tonemap == "auto" else tonemap
        check_look(exposure, named, srgb)
        curve = curve_for(pixels, numbers, named)
        light = holds_light(target, numbers)
        return for_file(numbers, encoding, light, exposure, curve, srgb), False
    array = check_picture(pixels, name)
    check_look(exposure, None if tonemap == "auto" else tonemap, srgb)
    is_id = array.dtype.kind in "iu" and array.dtype not in (np.uint8, np.uint16)
    if is_id and (exposure != 0 or tonemap not in ("auto", None)):
        raise ValueError(
            f"exposure, tonemap: expected colours, got {array.dtype} numbers, which are ids and written as they are"
        )
    # As for objects, files of light and whole numbers need no curve.
    curve = None
    if tonemap != "auto" and not holds_light(target, array):
        curve = curve_for(array, array, tonemap)
    if exposure == 0 and curve is None:
        return array, bool(srgb)

    def shown(color: FloatArray) -> FloatArray:
        if curve is not None:
            mapped = CURVES[curve](exposed(color, exposure))
            mapped[np.isnan(color)] = np.nan  # which the file refuses, in an array
            return mapped
        with np.errstate(over="ignore"):  # what overflows is infinite, and clipped or stored
            return np.asarray(color * np.float32(2.0**exposure), dtype=np.float32)

    return on_color(shown, to_float32(array, name)), bool(srgb)


@checked_call
def save_animation(
    path: PathLike,
    frames: Iterable[npt.ArrayLike | Frame | Image],
    *,
    fps: float = 25,
    srgb: bool | None = None,
    exposure: float = 0.0,
    tonemap: Tonemap | Literal["auto"] | None = "auto",
) -> None:
    """Write pictures as an animation that repeats forever.

    Parameters
    ----------
    path : str or os.PathLike
        A name that ends in .png (APNG: all colours, every browser opens it), .gif (256 colours a frame, which others
        are mixed of) or .webp (lossless).
    frames : iterable of Frame, Image or array_like (H, W) or (H, W, C)
        Pictures as for `save_image`, all of one size. Alpha is kept, except in a GIF. Equal frames in a row are stored
        as a single frame that lasts as long as all of them.
    fps : float
        Frames a second, from 0.001 to 100. A GIF's frames last a whole number of hundredths of a second.
    srgb, exposure, tonemap
        As in `save_image`. Clipping warns once for all frames.

    Raises
    ------
    OSError
        As for `save_image`.
    ValueError
        If there is no frame, for frames of unequal sizes, another extension, or fps out of range.

    Examples
    --------
    >>> import cubecam as cc, numpy as np, tempfile, pathlib
    >>> frames = [np.full((4, 6, 3), level, dtype=np.uint8) for level in (0, 128, 255)]
    >>> cc.save_animation(pathlib.Path(tempfile.mkdtemp()) / "grey.png", frames, fps=10)
    """
    from PIL import Image as Picture

    target = as_path(path)
    extension = target.suffix.lower()
    if extension not in (".png", ".apng", ".gif", ".webp"):
        raise ValueError(
            f"expected a file name that ends in .png, .gif or .webp, got {text_of(target.name)}"
        )
    if not 0.001 <= fps <= 100:
        raise ValueError(f"fps: expected a number from 0.001 to 100, got {fps}")
    pictures: list[Any] = []
    clipping = Clipping()
    like = Path("frame.png")  # every kind of animation holds pictures of 8 bits
    for index, frame in enumerate(frames):
        with clipping.gathered():
            pixels, encoded = prepare(frame, like, srgb, exposure, tonemap, f"frames[{index}]")
            pixels = fit_samples(pixels, FORMATS[".webp"], extension, encoded, False)
        pixels = np.repeat(pixels, 3, axis=2) if pixels.shape[2] == 1 else pixels
        if extension == ".gif" or (pixels.shape[2] == 4 and is_opaque(pixels)):
            pixels = pixels[..., :3]
        pictures.append(Picture.fromarray(np.ascontiguousarray(pixels)))
    if not pictures:
        raise ValueError("frames: expected at least one picture, got none")
    if len({picture.size for picture in pictures}) > 1:
        raise ValueError(
            f"frames: expected one size, got {sorted({picture.size for picture in pictures})}"
        )
    data = io.BytesIO()
    if len({picture.mode for picture in pictures}) > 1:
        pictures = [picture.convert("RGBA") for picture in pictures]
    if extension == ".gif":
        pictures = [_with_palette(picture) for picture in pictures]
    duration = 10 * max(1, round(100 / fps)) if extension == ".gif" else 1000 / fps
    kind = {".gif": "GIF", ".webp": "WEBP"}.get(extension, "PNG")
    options: dict[str, Any] = {"lossless": True} if kind == "WEBP" else {}
    pictures[0].save(
        data,
        format=kind,
        save_all=True,
        append_images=pictures[1:],
        duration=duration,
        loop=0,
        **options,
    )
    clipping.warn()
    write_files({target: data.getvalue()})


def _with_palette(picture: Any) -> Any:
    """Choose 256 colours for a frame of a GIF, and mix others of them, since skies would have bands."""
    from PIL import Image as Picture

    if picture.getcolors(256) is not None:
        return picture  # few colours are kept exactly
    palette = picture.quantize(256, method=Picture.Quantize.MEDIANCUT)
    return picture.quantize(palette=palette, dither=Picture.Dither.FLOYDSTEINBERG)
