"""Plays the animations of a viewer's scene: which one, its time, and whether time runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._checks import finite_number, one_of

if TYPE_CHECKING:
    from .._core import Scene

__all__ = ["Player"]


class Player:
    """The time of one animation of a scene; at the end it begins again.

    Parameters
    ----------
    scene : Scene
        Its `Scene.set_time` is called whenever the time changes.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.player import Player
    >>> Player(cc.Scene()).duration  # no animation
    0.0
    """

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._index = 0
        self._time = 0.0
        self._last: float | None = None  # when the running time was looked at
        self.playing = False
        self.speed = 1.0

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the animations; two of one name get numbers, and so do those without."""
        names = [animation.name for animation in self._scene.animations]
        return tuple(
            name if name and names.count(name) == 1 else f"{name} {i}".strip()
            for i, name in enumerate(names)
        )

    @property
    def animation(self) -> str:
        """The animation that plays, one of `names`; empty if there is none."""
        names = self.names
        return names[self._index] if self._index < len(names) else ""

    @animation.setter
    def animation(self, value: str) -> None:
        names = self.names
        name = one_of(value, "animation", names)
        self._index, self._time, self._last = names.index(name), 0.0, None
        self._apply()

    @property
    def duration(self) -> float:
        """The seconds that the animation lasts; 0 if there is none."""
        known = self._scene.animations
        return float(known[self._index].duration) if self._index < len(known) else 0.0

    @property
    def time(self) -> float:
        """The seconds since the beginning of the animation."""
        return self._time

    @time.setter
    def time(self, value: float) -> None:
        seconds = finite_number(value, "time")
        self._time, self._last = min(max(seconds, 0.0), self.duration), None
        self._apply()

    def tick(self, now: float) -> bool:
        """Let time run; say whether the scene has moved. `now` is a clock in seconds."""
        if not self.playing or not self.duration > 0:
            self._last = None
            return False
        before, self._last = self._last, now
        if before is None:
            return False
        self._time = (self._time + (now - before) * self.speed) % self.duration
        self._apply()
        return True

    def _apply(self) -> None:
        if self.names:
            self._scene.set_time(self._time, self._index)
