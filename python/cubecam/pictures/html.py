"""Cards as HTML for notebooks: inline styles, no script, every text escaped, readable on light and dark pages.

The colours are those of the page around it (`currentColor`), so that nothing has to know which theme is in use. The
pictures are PNG files in data URIs, of a bounded number of bytes all together.
"""

from __future__ import annotations

import base64
import functools
import io
from html import escape
from typing import TYPE_CHECKING

from .cards import Card, Fact, Row, Shot

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = ["card_html"]

# Bytes of all data URIs of a card: a notebook keeps every output in its file. Pictures after that are left out.
_MOST_BYTES = 130_000
# Opaque pictures narrower than this, of which a card has many, and those of more bytes get a palette of 256 colours,
# which makes a file a third as large; the tiniest ones get 64.
_NARROW, _TINY, _LARGE_PNG = 96, 64, 24_000

_LINE = "rgba(128,128,128,.32)"
_FONT = "font:13px/1.45 system-ui,-apple-system,'Segoe UI',sans-serif"
_MONO = "font-family:ui-monospace,Menlo,Consolas,monospace;font-size:12px"


class _Pictures:
    """Data URIs within the bytes that a card may have."""

    def __init__(self) -> None:
        self._left = _MOST_BYTES

    def img(self, shot: Shot, width: int, alt: str) -> str:
        """Give an <img>, or "" if there is no picture or no room for it."""
        if shot.pixels is None:
            return ""
        data = _data_uri(shot.pixels.tobytes(), shot.pixels.shape)
        if len(data) > self._left:
            return ""
        self._left -= len(data)
        return (
            f'<img src="{data}" alt="{escape(alt)}" width="{width}" '
            f'style="display:block;margin:0;border-radius:{min(8, width // 6)}px">'
        )


@functools.lru_cache(maxsize=64)
def _data_uri(pixels: bytes, shape: tuple[int, ...]) -> str:
    """Write pixels as a PNG; a notebook that shows the same objects again does not pay again."""
    import numpy as np

    return "data:image/png;base64," + base64.b64encode(
        _png(np.frombuffer(pixels, np.uint8).reshape(shape))
    ).decode("ascii")


def _png(pixels: npt.NDArray[np.uint8]) -> bytes:
    from PIL import Image

    opaque = bool((pixels[..., 3] == 255).all())
    picture = Image.fromarray(pixels[..., :3] if opaque else pixels)
    data = _encoded(picture)
    if opaque and (pixels.shape[1] < _NARROW or len(data) > _LARGE_PNG):
        colors = 64 if pixels.shape[1] < _TINY else 256
        data = _encoded(picture.quantize(colors, Image.Quantize.MEDIANCUT))
    return data


def _encoded(picture: object) -> bytes:
    file = io.BytesIO()
    picture.save(file, "PNG", optimize=True)  # type: ignore[attr-defined]
    return file.getvalue()


def card_html(card: Card) -> str:
    """Write a card as one <div>."""
    pictures = _Pictures()
    note = card.note
    picture = card.diagram
    if card.picture is not None:
        shot = card.picture()
        large = shot.pixels is not None and shot.pixels.shape[1] > 128
        picture = pictures.img(shot, 256 if large else 96, f"picture of {card.title}")
        note = note or shot.problem
    parts = [_head(card.title)]
    columns = [f'<div style="flex:none">{picture}</div>'] if picture else []
    columns.append(
        f'<div style="flex:0 1 auto;min-width:0">{_table(card.facts)}{_note(note)}</div>'
    )
    parts.append(
        f'<div style="display:flex;flex-wrap:wrap;gap:14px;align-items:flex-start">{"".join(columns)}</div>'
    )
    if card.tiles:
        tiles = "".join(_tile(tile, pictures) for tile in card.tiles)
        parts.append(_section(card.tiles_title))
        parts.append(f'<div style="display:flex;flex-wrap:wrap;gap:10px">{tiles}</div>')
    for title, rows in card.lists:
        parts.append(_section(title))
        pictured = any(row.picture is not None for row in rows)
        lines = "".join(_row(row, pictures, pictured) for row in rows)
        parts.append(f'<div style="overflow-wrap:anywhere">{lines}</div>')
    return (
        f'<div style="color-scheme:light dark;color:inherit;background:none;{_FONT};text-align:left;'
        f"display:inline-block;box-sizing:border-box;max-width:100%;padding:10px 14px 12px;margin:2px 0;"
        f'border:1px solid {_LINE};border-radius:10px">{"".join(parts)}</div>'
    )


def _head(title: str) -> str:
    return f'<div style="font-weight:600;margin:0 0 8px">{escape(title)}</div>'


def _section(title: str) -> str:
    return (
        f'<div style="opacity:.7;margin:12px 0 6px;padding-top:8px;border-top:1px solid {_LINE}">'
        f"{escape(title)}</div>"
    )


def _note(text: str) -> str:
    if not text:
        return ""
    return f'<div style="opacity:.75;margin-top:6px;overflow-wrap:anywhere">{escape(text)}</div>'


def _dot(color: str) -> str:
    """Draw a colour as a small square, which a page of the same colour does not hide."""
    if not color:
        return ""
    return (
        f'<span style="display:inline-block;width:.8em;height:.8em;margin-right:.45em;border-radius:3px;'
        f'vertical-align:-.05em;background:{color};box-shadow:0 0 0 1px rgba(128,128,128,.6)"></span>'
    )


def _table(facts: list[Fact]) -> str:
    """Write names and values as two columns; <div>s, since pages have styles of their own for tables."""
    lines = "".join(
        f'<div style="opacity:.65;white-space:nowrap">{escape(fact.name)}</div>'
        f'<div style="overflow-wrap:anywhere;font-variant-numeric:tabular-nums">'
        f"{_dot(fact.swatch)}{escape(fact.value)}</div>"
        for fact in facts
    )
    if not lines:
        return ""
    return f'<div style="display:grid;grid-template-columns:max-content 1fr;gap:1px 14px">{lines}</div>'


def _tile(tile: Card, pictures: _Pictures) -> str:
    shot = tile.picture() if tile.picture is not None else Shot(None)
    image = pictures.img(shot, 72, f"picture of {tile.title}")
    swatch = tile.facts[0].swatch if tile.facts else ""
    if not image:
        image = (
            f'<div style="width:72px;height:72px;box-sizing:border-box;border:1px dashed {_LINE};border-radius:8px;'
            f"background:{swatch or 'none'};font-size:9px;line-height:1.2;padding:3px;overflow:hidden;"
            f'overflow-wrap:anywhere">{escape(shot.problem[:90])}</div>'
        )
    name, _, kind = tile.title.partition(" ")
    return (
        f'<div style="width:84px;text-align:center;font-size:11px;line-height:1.3">'
        f'<div style="display:flex;justify-content:center">{image}</div>'
        f'<div style="margin-top:3px;overflow-wrap:anywhere"><b>{escape(name)}</b> {escape(kind)}</div></div>'
    )


def _row(row: Row, pictures: _Pictures, pictured: bool) -> str:
    """Write a row; `pictured`: the rows of this list have a column of thumbnails."""
    image = ""
    if row.picture is not None:
        image = pictures.img(row.picture(), 32, row.label)
    column = f'<span style="flex:none;width:32px">{image}</span>' if pictured else ""
    pad = 18 * min(row.depth, 12)
    place = f"margin-left:{pad}px;border-left:1px solid {_LINE};padding:2px 0 2px 8px;"
    look = (place if pad else "padding:2px 0;") + ("opacity:.6;" if row.faint else "")
    return (
        f'<div style="{look}display:flex;gap:10px;align-items:center">{column}'
        f'<b style="flex:none;font-weight:600">{_dot(row.swatch)}{escape(row.label)}</b>'
        f'<span style="{_MONO};opacity:.8">{escape(row.text)}</span></div>'
    )
