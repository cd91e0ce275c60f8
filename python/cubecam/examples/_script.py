"""Scripts of a visitor: the drags and keys of the documents 001 and 000, written down."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TypeAlias

#: "w", "s", or a drag (angleX, angleY) in degrees.
Event: TypeAlias = str | tuple[float, float]
#: Events, or the text of `parse_script`.
Script: TypeAlias = str | Sequence[Event]

#: Degrees that a drag over the height of the picture adds to an angle.
DRAG = 100.0
#: A drag of a text is played in pieces of so many pixels at most, as a hand makes it.
PIECE = 16.0
#: More events than anybody watches: a number with too many digits is an error, not a full memory.
MOST = 100_000

_EXPECTED = 'script: expected parts such as "drag 30 10", "w 5" or "s", divided by ";", got'


def events(script: Script, height: float = 512) -> tuple[Event, ...]:
    """Return the events of a script, which is a text or already a sequence of events.

    height : of the picture in which the pixels of a text are counted.
    """
    if isinstance(script, str):
        return parse_script(script, height)
    for event in script:
        if event not in ("w", "s") and (isinstance(event, str) or len(event) != 2):
            raise ValueError(f'script: expected "w", "s" or a drag of two angles, got {event!r}')
    return tuple(script)


def parse_script(text: str, height: float) -> tuple[Event, ...]:
    """Read a script such as ``"drag 30 10; w 5; s"``.

    ``drag DX DY`` moves the mouse by so many pixels to the right and down, in a picture of `height` pixels; ``w N`` and
    ``s N`` press a key N times, once without N.
    """
    found: list[Event] = []
    parts = [part.strip() for part in text.split(";") if part.strip()]
    if not parts:
        raise ValueError(f"{_EXPECTED} {text!r}")
    for part in parts:
        word, *numbers = part.split()
        if word == "drag" and len(numbers) == 2:
            dx, dy = (_number(number, part) for number in numbers)
            pieces = max(1, math.ceil(max(abs(dx), abs(dy)) / PIECE))
            _check_count(len(found) + pieces, part)
            share = DRAG / height / pieces
            found += [(dx * share, dy * share)] * pieces
        elif word in ("w", "s") and len(numbers) <= 1:
            count = numbers[0] if numbers else "1"
            if not re.fullmatch(r"\d+", count, re.ASCII):
                raise ValueError(f"{_EXPECTED} {part!r}")
            _check_count(len(found) + (int(count) if len(count) < 10 else math.inf), part)
            found += [word] * int(count)
        else:
            raise ValueError(f"{_EXPECTED} {part!r}")
    return tuple(found)


def _number(text: str, part: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise ValueError(f"{_EXPECTED} {part!r}")
    return number


def _check_count(count: float, part: str) -> None:
    if count > MOST:
        raise ValueError(f"script: expected at most {MOST:,} events, got {part!r}")
