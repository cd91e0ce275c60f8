"""A cube shown live: as a cross, as a panorama, or as the view of a person inside who looks around."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of, whole_number
from .._core import CubeMap, _to_array
from ..typing import Center, Convention, CubeMode, Place, Theme, Tonemap
from .cube_drawing import THEMES, Painter, draw_legend, draw_names, outline
from .cube_maps import Cross, Look, Panorama
from .lettering import Lettering
from .live import LiveView, shown_at
from .panel import Control, Section
from .settings import choice, flag, number
from .texels import Texel, levels_of, texel_of

__all__ = ["CubeView", "show_cube"]

MODES = ("cross", "panorama", "look")
_HELP = (
    "1 2 3  cross, panorama, look\n"
    "drag  move, or turn the look\n"
    "wheel, pinch  nearer, farther\n"
    "double click  look there\n"
    "arrows  turn the look\n"
    "+ -  exposure\n"
    "s  seams\n"
    "n  names of the faces\n"
    "r  show everything\n"
    "h  this list"
)
#: After these events a panel shows what they changed.
_ENDS = ("pointer_up", "wheel", "double_click", "key_down")
_HIGHEST_ZOOM = 256.0
#: What a wheel reports for twice the zoom: four notches of 100.
_DOUBLES = 400


class CubeView(LiveView):
    """A cubemap shown live: cross, panorama, or a look around. `CubeMap.show` makes one.

    Dragging moves the cross and the panorama and turns the look; the wheel zooms. The text under the picture says what
    is under the pointer: face, row and column in all three conventions, direction and value. A double click looks at
    the place that was clicked. The key h lists the keys.

    Parameters
    ----------
    cube : CubeMap or sequence of CubeMap
        A sequence is shown as levels, the first one first. A cube with mipmaps has its own levels.
    mode, convention, center, level, exposure, tonemap, seams, names, smooth, yaw, pitch, fov, zoom, background
        The properties of these names, which can be set later, too.
    size : (int, int)
        Width and height of the picture in logical pixels.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.cube_view import CubeView
    >>> cube = cc.load_environment(cc.sample_data("studio.exr"), size=64)
    >>> view = CubeView(cube, mode="panorama", size=(400, 200))
    >>> view.at(200, 100).face
    <Face.NEG_Z: 5>
    >>> view.draw().shape
    (200, 400, 4)
    """

    mode = choice('{"cross", "panorama", "look"}: how the cube is shown.', MODES)
    convention = choice(
        '{"inside", "gl", "three"}: the convention of the faces in the cross.',
        ("inside", "gl", "three"),
    )
    center = choice(
        '{"-z", "+z", "+x", "-x"}: the direction in the middle of the panorama.',
        ("-z", "+z", "+x", "-x"),
    )
    exposure = number(
        "float: stops; the light is multiplied by ``2**exposure``.",
        -64.0, 64.0, slider=(-10.0, 10.0), step=0.1, unit="stops",
    )  # fmt: skip
    tonemap = choice(
        '{"neutral", "reinhard", "aces"} or None: the curve for linear floats, see `to_screen`.',
        ("neutral", "reinhard", "aces", None),
    )
    seams = flag(
        "bool: whether the edges show how much the cube changes over them: the steps of `cc.plot.seam_steps`."
    )
    names = flag(
        "bool: whether the faces show their names and, except in the cross, their outlines."
    )
    smooth = flag(
        "bool: True shows bilinear lookups, as a shader's; False shows each texel. The cross always shows texels."
    )
    background = choice('{"dark", "light"}: the colour around the faces.', tuple(THEMES))
    yaw = number(
        "float: degrees by which the look is turned to the left; 0 is along -Z.",
        -180.0, 180.0, unit="°", step=0.5, wraps=True,
    )  # fmt: skip
    pitch = number(
        "float: degrees by which the look is turned up, -90 to 90.", -90.0, 90.0, unit="°", step=0.5
    )
    fov = number(
        "float: the vertical field of view of the look in degrees, 1 to 150.",
        1.0, 150.0, unit="°", step=0.5,
    )  # fmt: skip
    zoom = number(
        "float: how much the cross or the panorama is enlarged; at 1 it fits into the picture.",
        1.0, _HIGHEST_ZOOM, step=0.01,
    )  # fmt: skip

    _SETTINGS: ClassVar[dict[str, Any]] = {
        "convention": "inside", "center": "-z", "exposure": 0.0, "tonemap": "neutral", "seams": False,
        "names": True, "smooth": True, "background": "dark", "yaw": 0.0, "pitch": 0.0, "fov": 75.0,
        "zoom": 1.0,
    }  # fmt: skip

    @checked_call
    def __init__(
        self,
        cube: CubeMap | Sequence[CubeMap],
        *,
        mode: CubeMode = "cross",
        level: int = 0,
        size: tuple[int, int] = (800, 600),
        title: str = "cubemap",
        **settings: Any,
    ) -> None:
        super().__init__(title=title, size=size)
        self._level = 0
        self._take(cube)
        self._middle = (
            0.5,
            0.5,
        )  # the place of the sheet in the middle of the picture, as shares of the sheet
        self._logical: tuple[float, float] = (
            self.size
        )  # the size of the canvas on which something happened last
        self._grabbed: tuple[float, float] | None = None
        self._touches: dict[Any, tuple[float, float]] = {}
        for name, value in {"mode": mode, **self._SETTINGS, **settings}.items():
            if name not in self._SETTINGS and name != "mode":
                from .._calls import unknown_name

                raise TypeError(unknown_name("CubeView()", name, list(self._SETTINGS)))
            setattr(self, name, value)
        self.level = level

    # What is shown --------------------------------------------------------------------------------------------

    @property
    def cube(self) -> CubeMap | Sequence[CubeMap]:
        """CubeMap or sequence of CubeMap: what is shown. Setting it keeps the view; a level that is gone becomes 0."""
        return self._cube

    @cube.setter
    def cube(self, value: CubeMap | Sequence[CubeMap]) -> None:
        with self._lock:
            self._take(value)
        self.changed()
        self._tell("panel", None)

    def _take(self, cube: CubeMap | Sequence[CubeMap]) -> None:
        levels = levels_of(cube)
        self._cube = cube
        self._mipmapped = isinstance(cube, CubeMap) and cube.mipmaps
        self._source = Painter(cube if isinstance(cube, CubeMap) else levels[0])
        self._painters = [Painter(found) for found in levels]
        if self._level >= len(levels):
            self._level = 0

    @property
    def levels(self) -> int:
        """int: how many levels the cube has; 1 without mipmaps."""
        return len(self._painters)

    @property
    def level(self) -> int:
        """int: the level that is shown, 0 to ``levels - 1``; each level of mipmaps has half the size of the last."""
        return self._level

    @level.setter
    def level(self, value: int) -> None:
        level = whole_number(value, "level", 0, self.levels - 1)
        if level != self._level:
            self._level = level
            self.changed()

    @property
    def shown(self) -> CubeMap:
        """CubeMap: the level that is shown."""
        return self._painter().cube

    @property
    def help(self) -> str:
        """What mouse and keys do, one line each."""
        return _HELP

    def projection(self, size: tuple[float, float] | None = None) -> Cross | Panorama | Look:
        """Give the map between the pixels of a picture and directions, for a size in pixels (None: the canvas's)."""
        size = self._logical if size is None else size
        if self.mode == "look":
            return Look(size, self.yaw, self.pitch, self.fov)
        x, y = self._middle
        if self.mode == "panorama":
            return Panorama(size, self.center, self.zoom, (2 * x, y))
        return Cross(size, self.convention, self.zoom, (4 * x, 3 * y))

    @checked_call
    def at(self, x: float, y: float) -> Texel | None:
        """Find the texel at a place of the picture.

        Parameters
        ----------
        x, y : float
            Pixels from the top left corner of a picture of the view's `size`; the middle of the first pixel is
            (0.5, 0.5). On a canvas of another size, logical pixels of the canvas that had the last event.

        Returns
        -------
        Texel or None
            The texel of the level that is shown: `face`, `row` and `column` in "gl", `places` in all three conventions,
            `direction`, `value` as linear floats. None beside the faces.

        Examples
        --------
        >>> import cubecam as cc
        >>> from cubecam.viewer.cube_view import CubeView
        >>> view = CubeView(cc.CubeMap(np.ones((6, 4, 4, 1), np.float32)), size=(400, 300))
        >>> texel = view.at(200 - 1, 150 + 1)
        >>> {name: str(place) for name, place in texel.places.items()}["inside"]
        '-Z row 2 column 3'
        >>> view.at(5, 5) is None
        True
        """
        direction = self.projection().directions(float(x), float(y))
        if not np.isfinite(direction).all():
            return None
        return texel_of(self.shown, direction, level=self.level)

    def look_at(self, direction: npt.ArrayLike) -> None:
        """Turn the look along a direction of the world, of any length but 0; straight up and down are possible.

        Raises
        ------
        ValueError
            For anything but three finite numbers that are not all 0.
        """
        given = _to_array(direction, "direction")
        if given.dtype.kind not in "iuf":
            raise TypeError(f"direction: expected three finite numbers, got {text_of(direction)}")
        r = given.astype(float)
        if r.shape != (3,) or not np.isfinite(r).all() or not r.any():
            raise ValueError(
                f"direction: expected three finite numbers, not all 0, got {text_of(direction)}"
            )
        x, y, z = r / np.abs(r).max()
        if x or z:
            self.yaw = math.degrees(math.atan2(-x, -z))
        self.pitch = math.degrees(math.atan2(y, math.hypot(x, z)))

    # Drawing --------------------------------------------------------------------------------------------------

    def _painter(self) -> Painter:
        """Give the painter of this level; where the cube's faces were replaced, its levels are made again."""
        if self._mipmapped:
            if not self._source.fresh():
                self._source = Painter(self._source.cube)
                self._painters = [Painter(found) for found in levels_of(self._source.cube)]
        elif not self._painters[self._level].fresh():
            self._painters[self._level] = Painter(self._painters[self._level].cube)
        return self._painters[self._level]

    def _picture(self, size: tuple[int, int], moving: bool) -> npt.NDArray[np.uint8]:
        return self._lettered(self._painted(size), size)

    def _painted(self, size: tuple[int, int]) -> npt.NDArray[np.uint8]:
        inks, painter, projection = THEMES[self.background], self._painter(), self.projection(size)
        picture = painter.paint(
            projection, size, exposure=self.exposure, tonemap=self.tonemap, smooth=self.smooth,
            paper=inks.paper,
        )  # fmt: skip
        if self.names and self.mode != "cross":
            edge = outline(projection, size)
            picture[edge] = (picture[edge] // 2 + 110).astype(np.uint8)
        if self.seams and painter.cube.size > 1:
            colors, near = painter.seam_band(projection, size)
            picture[near] = colors[near]
        return picture

    def _lettered(
        self, picture: npt.NDArray[np.uint8], size: tuple[int, int]
    ) -> npt.NDArray[np.uint8]:
        inks = THEMES[self.background]
        legend = self.seams and self.shown.size > 1
        if self.names or legend:
            letters = Lettering(picture, inks.ink, inks.paper, unit=self._unit(size))
            if self.names:
                draw_names(letters, self.projection(size))
            if legend:
                # The cross at zoom 1 has no face at the bottom right.
                projection = self.projection(size)
                left = 0.0
                if isinstance(projection, Cross) and self.zoom == 1:
                    left = float(projection.sheet.pixels(2, 0)[0])
                draw_legend(letters, self.shown, left)
            picture = letters.picture
        opaque = np.full((*picture.shape[:2], 1), 255, np.uint8)
        return np.concatenate([picture, opaque], axis=-1)

    def _unit(self, size: tuple[int, int]) -> float:
        """Give the height of letters: a small picture that stands in for a large one has smaller letters."""
        ratio = math.sqrt(size[0] * size[1] / (self._logical[0] * self._logical[1]))
        return ratio * max(11.0, min(min(size) / ratio / 32, 40.0))

    # Events ---------------------------------------------------------------------------------------------------

    def _handle(self, event: dict[str, Any]) -> None:
        kind = event.get("event_type", "")
        if "size" in event:
            self._logical = tuple(event["size"])
        if kind.startswith("pointer"):
            self._point(kind, event)
        elif kind == "wheel":
            self._zoom_by(event["x"], event["y"], 2 ** (-event.get("dy", 0.0) / _DOUBLES))
            self._say(event["x"], event["y"])
        elif kind == "double_click":
            texel = self.at(event["x"], event["y"])
            if texel is not None:
                self.look_at(texel.direction)
                self.mode = "look"
        elif kind == "key_down":
            self._key(str(event.get("key", "")))
        if kind in _ENDS:
            self._tell("panel", None)

    def _point(self, kind: str, event: dict[str, Any]) -> None:
        if kind == "pointer_leave":
            self.text = ""
            return
        here = (float(event["x"]), float(event["y"]))
        touches = {
            k: (float(t["x"]), float(t["y"])) for k, t in (event.get("touches") or {}).items()
        }
        if len(touches) >= 2:
            self._pinch(touches)
            return
        self._touches = {}
        if kind == "pointer_down":
            self._grabbed = here
        elif kind == "pointer_up" or event.get("buttons") == ():  # the button may be let go outside
            self._grabbed = None
        elif self._grabbed is not None:
            self._drag(here[0] - self._grabbed[0], here[1] - self._grabbed[1])
            self._grabbed = here
        self._say(*here)

    def _pinch(self, touches: dict[Any, tuple[float, float]]) -> None:
        """Zoom as far as two fingers part, about the middle between them."""
        both = [key for key in touches if key in self._touches][:2]
        before, after = ([found[key] for key in both] for found in (self._touches, touches))
        self._touches, self._grabbed = touches, None
        if len(both) == 2 and math.dist(*before) > 0 and math.dist(*after) > 0:
            x, y = np.mean(after, axis=0).tolist()
            self._zoom_by(x, y, math.dist(*after) / math.dist(*before))

    def _say(self, x: float, y: float) -> None:
        texel = self.at(x, y)
        self.text = "" if texel is None else str(texel)

    def _drag(self, dx: float, dy: float) -> None:
        """Move what is shown along with the pointer."""
        if self.mode == "look":
            # The middle of the picture follows the pointer.
            degrees = math.degrees(2 * math.tan(math.radians(self.fov) / 2) / self._logical[1])
            self.yaw += dx * degrees
            self.pitch = min(90.0, max(-90.0, self.pitch + dy * degrees))
            return
        sheet = self._sheet()
        self._move_to(
            self._middle[0] - dx / sheet.scale / sheet.wide,
            self._middle[1] - dy / sheet.scale / sheet.high,
        )

    def _zoom_by(self, x: float, y: float, factor: float) -> None:
        if self.mode == "look":
            self.fov = min(150.0, max(1.0, self.fov / factor))
            return
        before = self._sheet().units(x, y)
        self.zoom = min(_HIGHEST_ZOOM, max(1.0, self.zoom * factor))
        if self.zoom == 1:
            self._move_to(0.5, 0.5)
            return
        # What is under the pointer stays there.
        sheet = self._sheet()
        after = sheet.units(x, y)
        self._move_to(
            self._middle[0] + float(before[0] - after[0]) / sheet.wide,
            self._middle[1] + float(before[1] - after[1]) / sheet.high,
        )

    def _sheet(self) -> Any:
        projection = self.projection()
        assert not isinstance(projection, Look)
        return projection.sheet

    def _move_to(self, x: float, y: float) -> None:
        middle = (min(1.0, max(0.0, x)), min(1.0, max(0.0, y)))
        if middle != self._middle:
            self._middle = middle
            self.changed()

    def _key(self, key: str) -> None:
        turns = {
            "ArrowLeft": (5, 0),
            "ArrowRight": (-5, 0),
            "ArrowUp": (0, 5),
            "ArrowDown": (0, -5),
        }
        if key in ("1", "2", "3"):
            self.mode = MODES[int(key) - 1]
        elif key in turns:
            self.yaw += turns[key][0]
            self.pitch = min(90.0, max(-90.0, self.pitch + turns[key][1]))
        elif key in ("+", "="):
            self.exposure = min(64.0, self.exposure + 0.5)
        elif key == "-":
            self.exposure = max(-64.0, self.exposure - 0.5)
        elif key == "s":
            self.seams = not self.seams
        elif key == "n":
            self.names = not self.names
        elif key == "r":
            self.reset()

    def reset(self) -> None:
        """Show everything again: zoom 1, the look along -Z with a field of view of 75 degrees, exposure 0."""
        for name in ("yaw", "pitch", "fov", "zoom", "exposure"):
            setattr(self, name, self._SETTINGS[name])
        self._move_to(0.5, 0.5)

    # Panel ----------------------------------------------------------------------------------------------------

    def panel(self) -> list[Section]:
        """List what can be set; the level is there if the cube has more than one."""

        def controls(*names: str) -> tuple[Control, ...]:
            return tuple(vars(type(self))[name].control(self) for name in names)

        picture = controls("mode", "exposure", "tonemap", "background")
        if self.levels > 1:
            picture += (
                Control(
                    "level", "integer", lambda: self.level, lambda v: setattr(self, "level", v),
                    low=0, high=self.levels - 1, step=1, help="int: the level that is shown.",
                ),
            )  # fmt: skip
        reset = Control(
            "reset", "button", lambda: None, lambda _: self.reset(), help="Show everything."
        )
        return [
            Section("picture", (*picture, reset)),
            Section("faces", controls("names", "seams", "smooth", "convention", "center")),
            Section("look", controls("yaw", "pitch", "fov"), open=self.mode == "look"),
        ]


@checked_call
def show_cube(
    cube: CubeMap,
    where: Place | None = None,
    *,
    mode: CubeMode = "cross",
    size: tuple[int, int] = (800, 600),
    convention: Convention = "inside",
    center: Center = "-z",
    level: int = 0,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    seams: bool = False,
    names: bool = True,
    smooth: bool = True,
    background: Theme = "dark",
    browser: bool = True,
    block: bool | None = None,
) -> CubeView:
    """Show the cube live: as a cross, as a panorama, or from inside. The method `CubeMap.show`.

    Dragging moves the cross and the panorama and turns the look; the wheel zooms; a double click looks at the place
    that was clicked; the key h lists the keys. The text under the picture says what is under the pointer: face, row and
    column in the three conventions "gl", "inside" and "three", direction, and value as linear floats.

    Parameters
    ----------
    where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
        Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
        for a browser on this machine.
    mode : {"cross", "panorama", "look"}
        How the cube is shown first; a control of the panel and the keys 1, 2 and 3 change it.
    size : (int, int)
        Width and height of the picture in logical pixels.
    convention : {"inside", "gl", "three"}
        The convention of the faces in the cross.
    center : {"-z", "+z", "+x", "-x"}
        The direction in the middle of the panorama.
    level : int
        The level that is shown first. A cube with ``mipmaps=True`` has levels.
    exposure : float
        Stops: the light is multiplied by ``2**exposure``.
    tonemap : {"neutral", "reinhard", "aces"} or None
        The curve for linear floats, see `to_screen`.
    seams : bool
        Whether the edges show how much the cube changes over them: blue where the step over the edge is no more than
        the steps beside it, red from 2.5 times as much (`cc.plot.seams`).
    names : bool
        Whether the faces show their names.
    smooth : bool
        True shows bilinear lookups in the panorama and the look, as a shader's; False shows each texel.
    background : {"dark", "light"}
        The colour around the faces.
    browser : bool
        Whether a page is opened in the browser.
    block : bool, optional
        Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
        notebooks and in Python's prompt no.

    Returns
    -------
    CubeView
        The live view, whose properties have the names of these options.

    Raises
    ------
    ValueError
        For an unknown name, or a level that the cube does not have.
    TypeError
        For a value of another type.
    ImportError
        If a package is missing; the message names the extra of cubecam that has it.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=64)
    >>> with cube.show("offscreen", mode="look") as view:
    ...     view.yaw, view.exposure = 30, 1
    ...     picture = view.draw()
    >>> picture.shape
    (600, 800, 4)
    """
    view = CubeView(
        cube, mode=mode, size=size, convention=convention, center=center, level=level,
        exposure=exposure, tonemap=tonemap, seams=seams, names=names, smooth=smooth,
        background=background,
    )  # fmt: skip
    return shown_at(view, where, browser, block)
