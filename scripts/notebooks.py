"""Run the notebooks and write their outputs into them.

    python scripts/notebooks.py [03 08]     these notebooks; without a number, all

Outputs are as small as they can be and equal from run to run: pictures become JPEG where that is smaller, and what
belongs to one run (times, the models of widgets) is left out. `notebooks/conftest.py` runs the notebooks as tests
and compares what they print and draw with the outputs that are committed (`differences`).
"""

from __future__ import annotations

import base64
import io
import os
import re
import sys
from importlib.metadata import version
from itertools import zip_longest
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
from nbclient import NotebookClient
from nbclient.exceptions import CellTimeoutError
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "notebooks"
#: The most bytes of a notebook's file, with its outputs.
MOST_BYTES = 500_000
#: Seconds that a cell may take.
TIMEOUT = 300
#: Seconds in which a cell's outputs arrive after its end.
OUTPUT_TIMEOUT = 20

_QUALITY = 80
#: The picture that stands for a live view is reduced by this factor.
_LIVE = 0.75
#: A picture of more colours than these is no drawing, and becomes JPEG.
_DRAWING = 8192
#: The largest change of a channel, of 255, with which a picture counts as a drawing of few colours.
_PALETTE = 8
#: Pictures are equal if they differ by this much of 255, on average over all pixels of one size; another version of
#: matplotlib may choose another size, and before 3.11 letters have other shapes; then both are compared as
#: `_COARSE` x `_COARSE` pixels.
_APART, _APART_COARSE, _COARSE = 1.0, 12.0, 24
#: Printed numbers are equal within this share, within 2 of the last digit, or where both are rounding errors.
_SHARE, _ROUNDING = 0.02, 2e-5
_NUMBER = re.compile(r"-?\d[\d,]*\.?\d*(?:e[+-]?\d+)?")


def execute(path: Path) -> nbformat.NotebookNode:
    """Run all cells of a notebook, and give it with its outputs, as `make notebooks` would write it."""
    try:
        return tidied(_run(path))
    except CellTimeoutError as error:
        # The kernel's sockets for outputs drop what a crowded machine does not take in time.
        if "IOPub" not in str(error):
            raise
        return tidied(_run(path))


def _run(path: Path) -> nbformat.NotebookNode:
    notebook: nbformat.NotebookNode = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    # The kernel's figures are pictures in the notebook, whatever the tests have set.
    environment = {key: value for key, value in os.environ.items() if key != "MPLBACKEND"}
    environment["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    client = NotebookClient(
        notebook, timeout=TIMEOUT, kernel_name="python3", record_timing=False,
        store_widget_state=False, iopub_timeout=OUTPUT_TIMEOUT, raise_on_iopub_timeout=True,
        extra_arguments=["--log-level=40"],
    )  # fmt: skip
    client.execute(cwd=str(path.parent), env=environment)
    return notebook


def tidied(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Leave out what differs from run to run, and make the outputs small. The notebook itself is changed."""
    notebook.metadata = nbformat.from_dict(  # type: ignore[no-untyped-call]
        {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
        }
    )
    count = 0
    for cell in notebook.cells:
        cell.metadata = {key: cell.metadata[key] for key in ("tags",) if key in cell.metadata}
        if cell.cell_type == "code":
            count += 1
            cell.execution_count = count
            cell.outputs = [_tidied_output(output, count) for output in _joined(cell.outputs)]
    return notebook


def _joined(outputs: list[Any]) -> list[Any]:
    """Join texts that follow each other: a kernel sends them in pieces of any length."""
    joined: list[Any] = []
    for output in outputs:
        before = joined[-1] if joined else {}
        if output["output_type"] == "stream" == before.get("output_type") and (
            output["name"] == before["name"]
        ):
            before["text"] += output["text"]
        else:
            joined.append(output)
    return joined


def _tidied_output(output: Any, count: int) -> Any:
    data = output.get("data")
    if data is None:
        return output
    # The model of a widget lives as long as its kernel; the picture beside it is what a reader sees.
    live = data.pop("application/vnd.jupyter.widget-view+json", None) is not None
    if "image/png" in data:
        scale = _LIVE if live else 1.0
        kind, encoded = _small_picture(base64.b64decode(data.pop("image/png")), scale)
        data[kind] = encoded
    output["metadata"] = {}
    if "execution_count" in output:
        output["execution_count"] = count
    return output


def _small_picture(png: bytes, scale: float = 1.0) -> tuple[str, str]:
    """Give the kind and the text of a picture's small file: PNG for drawings, JPEG for photographs.

    scale : the factor of the picture's edges.
    """
    picture = Image.open(io.BytesIO(png)).convert("RGBA")
    ground = Image.new("RGBA", picture.size, "white")
    opaque = Image.alpha_composite(ground, picture).convert("RGB")
    if scale != 1:
        size = (round(opaque.width * scale), round(opaque.height * scale))
        opaque = opaque.resize(size, Image.Resampling.BOX)
    files = [("image/jpeg", _encoded(opaque, "jpeg", quality=_QUALITY))]
    colors = opaque.getcolors(_DRAWING)  # None: more
    if colors is not None:
        files.insert(0, ("image/png", _encoded(_with_palette(opaque, len(colors)), "png")))
    kind, small = files[0]
    # Letters and lines are sharper in a PNG, which is kept where it is hardly larger.
    if len(files[-1][1]) < 0.7 * len(small):
        kind, small = files[-1]
    return kind, base64.b64encode(small).decode("ascii")


def _with_palette(drawing: Image.Image, colors: int) -> Image.Image:
    """Give a drawing a palette of 256 colours, which halves its file, if that changes no channel visibly."""
    few = drawing.quantize(
        min(colors, 256), Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE
    )
    apart = np.abs(np.asarray(few.convert("RGB"), int) - np.asarray(drawing, int))
    return few if apart.max() <= _PALETTE else drawing


def _encoded(picture: Image.Image, kind: str, **options: Any) -> bytes:
    buffer = io.BytesIO()
    picture.save(buffer, kind, optimize=True, **options)
    return buffer.getvalue()


def differences(
    got: nbformat.NotebookNode, committed: nbformat.NotebookNode, *, numbers: bool = True
) -> list[str]:
    """List what is not equal in the outputs of two runs of a notebook: empty if nothing is.

    numbers : whether printed numbers count, which may differ a little on another driver.
    """
    found = []
    for index, (one, other) in enumerate(zip_longest(got.cells, committed.cells)):
        if one is None or other is None or one.source != other.source:
            return [f"cell {index}: another source"]
        if one.cell_type == "code":
            pairs = zip_longest(one.outputs, other.outputs)
            for new, old in pairs:
                wrong = _apart(new, old, numbers)
                if wrong:
                    found.append(f"cell {index} ({one.source.splitlines()[0][:50]}): {wrong}")
    return found


def _apart(new: Any, old: Any, numbers: bool) -> str:
    """Say how an output differs from an older one; an empty text if it does not."""
    if new is None or old is None:
        return "an output more" if old is None else "an output less"
    texts = [
        output.get("text", output.get("data", {}).get("text/plain", "")) for output in (new, old)
    ]
    if not _same_text(texts[0], texts[1], numbers):
        return f"the text was {texts[1]!r} and is {texts[0]!r}"
    pictures = [_picture_of(output) for output in (new, old)]
    if (pictures[0] is None) != (pictures[1] is None):
        return "only one of the outputs has a picture"
    if pictures[0] is not None and pictures[1] is not None:
        return _pictures_apart(pictures[0], pictures[1])
    return ""


def _same_text(one: str, other: str, numbers: bool) -> bool:
    if one == other:
        return True
    # The size of a figure in pixels is matplotlib's affair.
    if one.startswith("<Figure size") and other.startswith("<Figure size"):
        return True
    if " ".join(_NUMBER.sub("#", one).split()) != " ".join(_NUMBER.sub("#", other).split()):
        return False
    pairs = zip(_NUMBER.findall(one), _NUMBER.findall(other), strict=True)
    return not numbers or all(_same_number(a, b) for a, b in pairs)


def _same_number(one: str, other: str) -> bool:
    a, b = (float(text.replace(",", "").rstrip(".")) for text in (one, other))
    mantissa, _, exponent = one.partition("e")
    digits = len(mantissa.partition(".")[2])
    last = 10.0 ** (int(exponent or 0) - digits)
    apart = abs(a - b)
    return apart <= max(_SHARE * abs(b), 2 * last) or max(abs(a), abs(b)) < _ROUNDING


def _picture_of(output: Any) -> Image.Image | None:
    for kind in ("image/png", "image/jpeg"):
        encoded = output.get("data", {}).get(kind)
        if encoded is not None:
            return Image.open(io.BytesIO(base64.b64decode(encoded))).convert("RGB")
    return None


def _letters_are_new() -> bool:
    return tuple(int(part) for part in version("matplotlib").split(".")[:2]) >= (3, 11)


def _pictures_apart(new: Image.Image, old: Image.Image) -> str:
    limit = _APART
    if new.size != old.size or not _letters_are_new():
        coarse = (_COARSE, _COARSE)
        new, old = (p.resize(coarse, Image.Resampling.BOX) for p in (new, old))
        limit = _APART_COARSE
    apart = float(np.abs(np.asarray(new, float) - np.asarray(old, float)).mean())
    return f"the picture differs by {apart:.1f} of 255" if apart > limit else ""


def write(path: Path) -> int:
    """Run a notebook and write it with its outputs; give the bytes of the file."""
    notebook = execute(path)
    text = nbformat.writes(notebook, version=4) + "\n"  # type: ignore[no-untyped-call]
    path.write_text(text, encoding="utf-8")
    return len(text.encode())


def main(arguments: list[str]) -> int:
    paths = sorted(NOTEBOOKS.glob("*.ipynb"))
    if arguments:
        paths = [path for path in paths if path.name.startswith(tuple(arguments))]
    if not paths:
        print(f"expected the number of a notebook, such as 03, got {arguments}", file=sys.stderr)
        return 2
    worst = 0
    for path in paths:
        size = write(path)
        worst = max(worst, size)
        print(f"{path.name}: {size / 1000:.0f} KB", flush=True)
    if worst > MOST_BYTES:
        print(f"expected at most {MOST_BYTES / 1000:.0f} KB for each notebook", file=sys.stderr)
    return int(worst > MOST_BYTES)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
