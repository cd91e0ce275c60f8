"""The gallery: a short program for each example, which sphinx-gallery runs, and the pictures that it leaves.

The modules of `cubecam.examples` are no scripts, and their pictures are arrays. So each gets a script that draws its
still and, if it moves, its loop, with the module's own docstring as text and its own source below. `scrape` turns the
names `still` and `loop` of a script into files: a PNG, and an animated WebP of at most `MOST` bytes.
"""

from __future__ import annotations

import inspect
import io
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
from PIL import Image

from cubecam import examples

from .repository import DOCS, write_changed

if TYPE_CHECKING:  # the functions are tested without Sphinx
    from sphinx.application import Sphinx
    from sphinx.config import Config

SCRIPTS = DOCS / "_build" / "gallery"
PAGES = DOCS / "gallery"
#: Bytes of a loop, and the scales and qualities that are tried until it is as small.
MOST = 400_000
SCALES, QUALITIES = (1.0, 0.8, 0.65), (70, 50, 32)
#: Pictures of a loop at most, and pixels of its longer edge.
FRAMES, EDGE = 50, 420
RATE = 25  # frames a second, of the programs' animations

_HEAD = """\
Gallery: eighteen programs
==========================

Those of a graphics course, from a textured cube to dynamic refraction, and rough metal. Each page has a still, a loop
of what moves, and the whole program. ``cubecam example NAME --live`` opens one with its mouse and its keys, and
``cubecam example NAME -o FILE`` draws its pictures; the :ref:`command line <cubecam-example>` has the options.
"""


def script_of(name: str) -> str:
    """Write the program of one example."""
    module: Any = examples.load(name)
    first, _, rest = inspect.cleandoc(module.__doc__).partition("\n\n")
    program = module.build()
    title = f"{module.PROGRAM} {name.replace('_', ' ').capitalize()}"
    lines = [
        'r"""',
        title,
        "=" * len(title),
        "",
        f"{module.TITLE}.",
        "",
        *first.partition("\n")[2].splitlines(),
        "",
        rest,
        '"""',
        "import cubecam as cc",
        f"from cubecam.examples import {name}",
        "",
        f"program = {name}.build()",
        "with cc.Renderer() as renderer:",
        f"    still = {name}.draw(program, renderer, {examples.still_of(module, program)}, samples=4)",
    ]
    length = examples.length_of(module, program)
    if length > 1:
        step = -(-length // FRAMES)
        width, height = small(examples.size_of(module, program))
        lines += [
            "",
            "# %%",
            _words(name, length, step),
            "",
            f"frames = range(0, {length}, {step})" if step > 1 else f"frames = range({length})",
            "with cc.Renderer() as renderer:",
            "    loop = [",
            f"        {name}.draw(program, renderer, frame, size=({width}, {height}), samples=4)",
            "        for frame in frames",
            "    ]",
        ]
    lines += [
        "",
        "# %%",
        "# The program",
        "# -----------",
        "#",
        f"# .. literalinclude:: /../python/cubecam/examples/{name}.py",
        "#    :language: python",
        "#    :start-at: from __future__",  # after the docstring, which stands above
        "",
    ]
    return "\n".join(lines)


def _words(name: str, length: int, step: int) -> str:
    seconds = f"{length / RATE:.3g} seconds"
    which = (
        "all its pictures"
        if step == 1
        else f"every {step}{'nd' if step == 2 else 'rd' if step == 3 else 'th'} picture"
    )
    words = [f"# Its animation: {which} of {seconds}."]
    if examples.is_live(name):
        words.append(f"# ``cubecam example {name} --live`` lets you use mouse and keys.")
    return "\n".join(words)


def small(size: tuple[int, int]) -> tuple[int, int]:
    """Give the size of a loop's pictures."""
    scale = min(1.0, EDGE / max(size))
    return round(size[0] * scale), round(size[1] * scale)


def write_scripts(app: Sphinx, config: Config) -> None:
    """Write all scripts; with another cubecam, forget what the last one drew."""
    stamp = SCRIPTS / "cubecam.txt"
    if not stamp.exists() or stamp.read_text() != config.cubecam_hash:
        shutil.rmtree(PAGES, ignore_errors=True)
        shutil.rmtree(SCRIPTS, ignore_errors=True)
    SCRIPTS.mkdir(parents=True, exist_ok=True)
    write_changed(SCRIPTS / "GALLERY_HEADER.rst", _HEAD)
    for index, name in enumerate(examples.NAMES, 1):
        write_changed(SCRIPTS / f"plot_{index:02}_{name}.py", script_of(name))
    stamp.write_text(config.cubecam_hash)


def scrape(block: Any, block_vars: dict[str, Any], conf: dict[str, Any]) -> str:
    """Save what a block left in `still` and `loop`, and show it."""
    names = block_vars["example_globals"]
    paths = block_vars["image_path_iterator"]
    example = Path(block_vars["src_file"]).stem[len("plot_01_") :]
    shown = []
    for name in ("still", "loop"):
        if name not in names:
            continue
        path = Path(next(paths))
        pictures = names.pop(name)
        if name == "still":
            Image.fromarray(opaque(pictures)).save(path)
        else:
            path = path.with_suffix(".webp")
            path.write_bytes(animation([opaque(one) for one in pictures], names["frames"].step))
        place = path.relative_to(DOCS).as_posix()
        shown.append(
            f".. image:: /{place}\n   :alt: {example}, {name}\n   :class: sphx-glr-single-img {name}\n"
        )
    return "\n".join(shown)


def opaque(picture: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Leave out alpha, as the files of `cubecam example` do."""
    return np.ascontiguousarray(picture[..., :3])


def animation(pictures: list[npt.NDArray[np.uint8]], step: int) -> bytes:
    """Encode a WebP that repeats, of at most `MOST` bytes; each picture stands for so many of the animation."""
    milliseconds = 1000 * step // RATE
    for scale in SCALES:
        height, width, _ = pictures[0].shape
        size = (round(width * scale), round(height * scale))
        frames = [Image.fromarray(one).resize(size, Image.Resampling.LANCZOS) for one in pictures]
        for quality in QUALITIES:
            buffer = io.BytesIO()
            frames[0].save(
                buffer, "webp", save_all=True, append_images=frames[1:], duration=milliseconds,
                loop=0, quality=quality, method=4,
            )  # fmt: skip
            if buffer.tell() <= MOST:
                return buffer.getvalue()
    raise ValueError(f"expected an animation of {MOST} bytes at most, got {buffer.tell()}")


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the scripts before sphinx-gallery looks for them."""
    app.connect("config-inited", write_scripts, priority=400)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
