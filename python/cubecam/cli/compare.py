"""`cubecam compare`: how far a picture is from the truth, as a table, as JSON and as a figure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .common import FILE, NUMBER, complain, failures_reported
from .help import Command, argument, option

if TYPE_CHECKING:
    from ..truth import Comparison


@click.command(cls=Command)
@argument("picture", metavar="PICTURE", type=FILE, help="The file that is measured.")
@argument("truth", metavar="TRUTH", type=FILE, help="The file that it is measured against.")
@option(
    "--mask",
    metavar="FILE",
    type=FILE,
    help="A picture of the same size: pixels of which a colour is above 0 count.",
    note="all pixels count",
)
@option(
    "--cube",
    is_flag=True,
    help="The files are cubemaps, each of the layout that its shape says. Names with {face} always are.",
)
@option("--srgb", is_flag=True, help="Decode files of 8 and 16 bits to linear floats.")
@option("--no-flip", is_flag=True, help="Leave FLIP out, which takes most of the time.")
@option(
    "--output",
    "-o",
    metavar="FILE",
    type=FILE,
    help="Draw picture, truth and error into this file, such as error.png or error.pdf.",
    note="no figure",
)
@option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@option(
    "--fail-above",
    type=NUMBER,
    metavar="RMSE",
    help="End with exit status 1 if the RMSE is above this number.",
    note="never",
)
def compare(
    picture: str,
    truth: str,
    mask: str | None,
    cube: bool,
    srgb: bool,
    no_flip: bool,
    output: str | None,
    as_json: bool,
    fail_above: float | None,
) -> None:
    """Measure how far a picture is from the truth: RMSE, relative RMSE, SSIM, FLIP and the worst place.

    The numbers are those of cc.truth.compare, whose documentation defines them. Files of 8 and 16 bits count as shares
    of their largest number, without decoding.
    """
    with failures_reported():
        found = _compared(picture, truth, mask, cube, srgb, not no_flip)
        if output is not None:
            _draw(found, output)
    if as_json:
        import json

        click.echo(
            json.dumps({"picture": picture, "truth": truth} | _finite(found.numbers()), indent=2)
        )
    else:
        click.echo(f"{picture} against {truth}")
        click.echo("\n".join(f"  {name:<15}{text}" for name, text in found.rows()))
    if fail_above is not None and not found.rmse <= fail_above:
        complain(f"expected an RMSE of at most {fail_above:g}, got {found.rmse:.6g}")
        raise SystemExit(1)


def _compared(
    picture: str, truth: str, mask: str | None, cube: bool, srgb: bool, flip: bool
) -> Comparison:
    from ..io.cubemaps import load_cubemap
    from ..io.images import load_image
    from ..truth import compare as measured

    cube = cube or "{face}" in picture or "{face}" in truth
    if cube:
        first, second = load_cubemap(picture, srgb=srgb), load_cubemap(truth, srgb=srgb)
        counts = None if mask is None else _counting(load_cubemap(mask).faces)
        return measured(first, second, counts, flip=flip)
    one, other = load_image(picture, srgb=srgb), load_image(truth, srgb=srgb)
    if (one.dtype.kind == "u") != (other.dtype.kind == "u"):
        bits, floats = (picture, truth) if one.dtype.kind == "u" else (truth, picture)
        complain(
            f"{bits} holds whole numbers, which are not decoded, and {floats} holds floats; --srgb decodes sRGB",
            kind="warning",
        )
    counts = None if mask is None else _counting(load_image(mask))
    return measured(one, other, counts, flip=flip)


def _counting(pixels: Any) -> Any:
    """Give True where a colour, not the alpha, is above 0."""
    colors = pixels[..., :3] if pixels.shape[-1] == 4 else pixels
    return (colors > 0).any(axis=-1)


def _draw(found: Comparison, output: str) -> None:
    import io

    from ..io.writing import write_files

    try:
        import matplotlib
    except ImportError:
        raise ValueError(
            "-o needs matplotlib, which is not installed: pip install cubecam[plot]"
        ) from None
    matplotlib.use("Agg")  # a command needs no window
    kind = Path(output).suffix.lstrip(".").lower()
    if not kind:
        raise ValueError(f"-o: expected a name such as error.png or error.pdf, got {output}")
    held = io.BytesIO()
    found.plot().savefig(held, format=kind, dpi=150)
    write_files({Path(output): held.getvalue()})


def _finite(numbers: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity: a number that overflowed is null."""
    import math

    return {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in numbers.items()
    }
