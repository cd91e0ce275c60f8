"""Cards for terminals, by rich: a picture of half blocks where the terminal has colours, a table, and a tree."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Group, RenderableType
from rich.style import Style
from rich.table import Table
from rich.text import Text
from rich.tree import Tree

from .cards import Card, Fact, Row, Shot

if TYPE_CHECKING:
    from rich.console import Console

__all__ = ["card_text", "colorful", "half_blocks"]

#: The widest picture of a mesh or a material, and of a scene, characters.
_BALL_WIDTH, _SCENE_WIDTH = 24, 48


def card_text(card: Card, console: Console, width: int) -> RenderableType:
    """Arrange a card for a console of a width in characters."""
    body = _table(card.facts)
    note = card.note
    columns: list[RenderableType] = [body]
    if card.picture is not None and colorful(console) and width >= 60:
        shot = card.picture()
        note = note or shot.problem
        if shot.pixels is not None:
            wide = _SCENE_WIDTH if shot.pixels.shape[1] > 128 else _BALL_WIDTH
            columns.insert(0, half_blocks(shot, min(wide, width // 2)))
    parts: list[RenderableType] = [Text(card.title, style="bold")]
    grid = Table.grid(padding=(0, 2))
    grid.add_row(*columns)
    parts.append(grid)
    if note:
        parts.append(Text(note, style="dim"))
    if card.tiles:
        tiles = [
            Row(tile.title, "", swatch=tile.facts[0].swatch if tile.facts else "")
            for tile in card.tiles
        ]
        parts.append(_tree(card.tiles_title, tiles))
    parts += [_tree(title, rows) for title, rows in card.lists]
    return Group(*parts)


def half_blocks(shot: Shot, width: int) -> Text:
    """Draw pixels as characters of two pixels each, one above the other, mixed down to `width` columns."""
    assert shot.pixels is not None
    height = max(2, round(shot.pixels.shape[0] * width / shot.pixels.shape[1]) // 2 * 2)
    small = _shrunk(shot.pixels, width, height)
    text = Text(no_wrap=True)
    for upper, lower in zip(small[::2], small[1::2], strict=True):
        for above, below in zip(upper, lower, strict=True):
            text.append("▀", Style(color=_hex(above), bgcolor=_hex(below)))
        text.append("\n")
    text.right_crop(1)
    return text


def _shrunk(pixels: np.ndarray, width: int, height: int) -> np.ndarray:
    """Average the pixels of each cell, numbers of the screen, over black where they are translucent."""
    colors = pixels[..., :3] * (pixels[..., 3:] / 255)
    rows = np.linspace(0, pixels.shape[0], height + 1).astype(int)
    columns = np.linspace(0, pixels.shape[1], width + 1).astype(int)
    sums = np.add.reduceat(np.add.reduceat(colors, rows[:-1], axis=0), columns[:-1], axis=1)
    cells = np.diff(rows)[:, None, None] * np.diff(columns)[None, :, None]
    return np.asarray((sums / cells).round().astype(np.uint8))


def _hex(color: Iterable[int]) -> str:
    return "#" + "".join(f"{value:02x}" for value in color)


def colorful(console: Console) -> bool:
    """Say whether half blocks in colours can be seen: not in files, without colours, or in ASCII."""
    return (
        console.color_system in ("256", "truecolor", "windows")
        and not console.no_color
        and console.encoding.lower().startswith("utf")
    )


def _line(label: str, text: str, swatch: str, faint: bool = False) -> Text:
    line = Text(style="dim" if faint else "")
    if swatch:
        line.append("● ", Style(color=swatch))
    line.append(label, "bold")
    line.append(("  " if label and text else "") + text)
    return line


def _table(facts: list[Fact]) -> Table:
    table = Table.grid(padding=(0, 2))
    table.add_column(no_wrap=True)
    table.add_column(overflow="fold")
    for fact in facts:
        value = Text()
        if fact.swatch:
            value.append("● ", Style(color=fact.swatch))
        table.add_row(Text(fact.name, style="cyan"), value.append(fact.value))
    return table


def _tree(title: str, rows: list[Row]) -> Tree:
    tree = Tree(Text(title, style="cyan"), guide_style="dim")
    branches = [tree]
    for row in rows:
        del branches[row.depth + 1 :]
        branches.append(branches[-1].add(_line(row.label, row.text, row.swatch, row.faint)))
    return tree
