"""What the reader of a scene leaves out: collected while it reads, told once at the end."""

from __future__ import annotations

from pathlib import Path

from .._warnings import SceneWarning, warn_user

#: How many places of one kind a warning names.
_NAMED = 3


class LeftOut:
    """The parts of a file that are left out, by reason.

    A file may have the same fault in thousands of places: each reason gives one warning.
    """

    def __init__(self) -> None:
        self._places: dict[str, list[str]] = {}

    def add(self, reason: str, place: str = "") -> None:
        """Note that what stands at a place is left out; the reason says what it is."""
        places = self._places.setdefault(reason, [])
        if place and place not in places[:_NAMED]:
            places.append(place)

    def warn(self, path: Path | str) -> None:
        """Give one `SceneWarning` for each reason."""
        for reason, places in self._places.items():
            named = ", ".join(places[:_NAMED])
            more = len(places) - _NAMED
            told = f" ({named}{f' and {more} more' if more > 0 else ''})" if named else ""
            warn_user(f"{path}: {reason}{told}", SceneWarning)
