"""Names of layouts and of the six files of a cubemap."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias, get_args

from .._checks import text_of
from ..typing import Center, Convention, FileLayout, Layout
from .files import PathLike, as_path

Source: TypeAlias = PathLike | Sequence[PathLike]

# The texts that replace {face} in a name, in the order of the faces. The first row is written; all rows are read, in
# this order, also in capitals.
FACE_NAMES = (
    ("px", "nx", "py", "ny", "pz", "nz"),
    ("posx", "negx", "posy", "negy", "posz", "negz"),
    ("pos-x", "neg-x", "pos-y", "neg-y", "pos-z", "neg-z"),
    ("pos_x", "neg_x", "pos_y", "neg_y", "pos_z", "neg_z"),
    ("xpos", "xneg", "ypos", "yneg", "zpos", "zneg"),
    ("+x", "-x", "+y", "-y", "+z", "-z"),
    ("right", "left", "top", "bottom", "front", "back"),
    ("right", "left", "up", "down", "front", "back"),
    ("rt", "lf", "up", "dn", "ft", "bk"),
    ("0", "1", "2", "3", "4", "5"),
    ("1", "2", "3", "4", "5", "6"),
)
CONVENTIONS: tuple[Convention, ...] = get_args(Convention)
CENTERS: tuple[Center, ...] = get_args(Center)
LAYOUTS: tuple[FileLayout, ...] = (*get_args(Layout), "faces")


def layout_name(layout: str | None) -> FileLayout | None:
    if layout is None:
        return None
    name = str(layout).lower().replace("-", "_").replace(" ", "_")
    name = "cross" if name == "horizontal_cross" else name
    for known in LAYOUTS:
        if name == known:
            return known
    raise ValueError(f"layout: expected one of {', '.join(LAYOUTS)}, got {text_of(layout)}")


def picture_layout(
    layout: FileLayout | None, six: Sequence[object] | None, path: Source
) -> Layout | None:
    """Return the layout of the one picture, None for six files; raise ValueError if layout and number do not agree."""
    if six is not None:
        if layout not in (None, "faces"):
            raise ValueError(
                f'layout: expected "faces" or None for six files, got {text_of(layout)}'
            )
        return None
    if layout == "faces":
        raise ValueError(
            f'layout "faces": expected six paths or a name with {{face}}, got {text_of(path)}'
        )
    return layout


def check_names(convention: str | None, center: str | None) -> None:
    """Raise ValueError for unknown names, also for names that the call does not need, since they are typos."""
    if convention is not None and str(convention).lower() not in CONVENTIONS:
        raise ValueError(
            f"convention: expected one of {', '.join(CONVENTIONS)}, got {text_of(convention)}"
        )
    if center is not None and str(center).lower() not in CENTERS:
        raise ValueError(f"center: expected one of {', '.join(CENTERS)}, got {text_of(center)}")


def check_openexr(convention: str | None) -> None:
    if convention not in (None, "inside"):
        raise ValueError(
            f'an OpenEXR environment cube is "inside" by definition, got convention {text_of(convention)}'
        )


def six_paths(path: Source, for_reading: bool) -> list[Path] | None:
    """Return the six files of a list or of a name with {face}; None for a single path."""
    if isinstance(path, Sequence) and not isinstance(path, (str, bytes)):
        if len(path) != 6:
            raise ValueError(f"expected six paths in the order +X -X +Y -Y +Z -Z, got {len(path)}")
        return [as_path(item) for item in path]
    name = str(as_path(path))
    if "{face}" not in name:
        return None
    if not for_reading:
        return _replaced(name, FACE_NAMES[0])
    best: list[Path] = []
    most = 0
    for row in spellings():
        paths = _replaced(name, row)
        found = sum(path.exists() for path in paths)
        if found > most:
            best, most = paths, found
        if found == 6:
            break
    if best:
        return best
    tried = ", ".join(dict.fromkeys(names[0] for names in FACE_NAMES))
    told = f"no such files; {{face}} was tried as {tried} (for +X), also in capitals"
    raise FileNotFoundError(2, told, name)


def by_their_names(files: Sequence[str]) -> list[str]:
    """Put six files in the order of the faces if their names tell it, such as neg-x.jpg; else leave them as they are.

    A shell lists the files of a pattern in the order of the alphabet.
    """
    folder, name = os.path.split(files[0])
    for row in spellings():
        for face in row:
            start = name.find(face)
            while start >= 0:
                ends = name[:start], name[start + len(face) :]
                ordered = [os.path.join(folder, one.join(ends)) for one in row]  # noqa: PTH118
                if set(ordered) == set(files):
                    return ordered
                start = name.find(face, start + 1)
    return list(files)


def spellings() -> list[tuple[str, ...]]:
    """List all rows of names that {face} stands for when files are read: each as it is, and in capitals."""
    forms = (
        str,
        str.upper,
        str.capitalize,  # Right, Posx
        lambda text: text[:-1] + text[-1:].upper(),  # posX
        lambda text: text[:1].upper() + text[1:-1] + text[-1:].upper(),  # PosX
    )
    rows = [tuple(form(text) for text in names) for form in forms for names in FACE_NAMES]
    return list(dict.fromkeys(rows))


def _replaced(name: str, row: Sequence[str]) -> list[Path]:
    return [Path(name.replace("{face}", face)) for face in row]
