"""`reflection`: the diagram of a ray at a surface inside a cube, which is turned by hand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._core import CubeMap
from ..typing import Place, Theme, Tonemap
from ..viewer.live import LiveView, shown_at
from ..viewer.panel import Control, Section
from ..viewer.settings import choice, number
from ..viewer.texels import Texel, texel_of
from ._diagram import BAND, EYE, Diagram, Ground, Layout, in_band, light_on_screen, shown
from ._optics import Facts, Plane, facts_of, turned

if TYPE_CHECKING:
    Mode = Literal["reflection", "refraction"]

__all__ = ["ReflectionView", "reflection"]

_HELP = (
    "drag  turn the surface; at the eye, move the eye\n"
    "left, right  turn the surface\n"
    "up, down  turn the plane\n"
    "wheel  roughness\n"
    "m  reflection, refraction\n"
    "r  as at first\n"
    "h  this list"
)
#: How near to the eye, in units of half the cube's edge, a drag begins that moves the eye.
_NEAR_THE_EYE = 0.16


class ReflectionView(LiveView):
    """The diagram of `cubecam.explore.reflection`, which makes it.

    The properties can be set in Python, by the panel and by hand; the picture follows.
    """

    mode = choice(
        '{"reflection", "refraction"}: a mirror, or a body of glass.', ("reflection", "refraction")
    )
    angle = number(
        "float: degrees by which the normal N is turned from straight up, counter-clockwise in the diagram.",
        -180.0, 180.0, unit="°", step=0.5, wraps=True,
    )  # fmt: skip
    eye = number(
        "float: degrees by which the eye stands from straight up, counter-clockwise in the diagram.",
        -180.0, 180.0, unit="°", step=0.5, wraps=True,
    )  # fmt: skip
    azimuth = number(
        "float: degrees by which the plane of the diagram is turned about +Y; at 0 it holds +X and +Y.",
        -180.0, 180.0, unit="°", step=0.5, wraps=True,
    )  # fmt: skip
    ior = number(
        "float: the refractive index behind the surface, 0.25 to 4; 1 is in front of it. See `GlassMaterial`.",
        0.25, 4.0, slider=(1.0, 2.5), step=0.01,
    )  # fmt: skip
    roughness = number(
        "float: 0 (a mirror) to 1; the width of the GGX lobe is its square.", 0.0, 1.0, step=0.01
    )
    exposure = number(
        "float: stops; the light is multiplied by ``2**exposure``.",
        -64.0, 64.0, slider=(-10.0, 10.0), step=0.1, unit="stops",
    )  # fmt: skip
    tonemap = choice(
        '{"neutral", "reinhard", "aces"} or None: the curve for linear floats, see `to_screen`.',
        ("neutral", "reinhard", "aces", None),
    )
    background = choice('{"dark", "light"}: the colour of the paper.', ("dark", "light"))

    _SETTINGS: ClassVar[dict[str, Any]] = {
        "mode": "reflection", "angle": 20.0, "eye": 55.0, "azimuth": 0.0, "ior": 1.5, "roughness": 0.0,
        "exposure": 0.0, "tonemap": "neutral", "background": "dark",
    }  # fmt: skip

    @checked_call
    def __init__(
        self,
        environment: CubeMap | None = None,
        *,
        size: tuple[int, int] = (960, 600),
        **settings: Any,
    ) -> None:
        super().__init__(title="reflection", size=size)
        if environment is None:
            environment = default_environment()
        if not isinstance(environment, CubeMap):
            raise TypeError(
                f"environment: expected a CubeMap or None, got {type(environment).__name__}"
            )
        self.environment = environment
        self._ground = Ground(environment)
        self._logical: tuple[float, float] = (
            self.size
        )  # the size of the canvas on which something happened last
        self._grabbed: tuple[str, float] | None = None
        for name, value in {**self._SETTINGS, **settings}.items():
            if name not in self._SETTINGS:
                from .._calls import unknown_name

                raise TypeError(unknown_name("ReflectionView()", name, list(self._SETTINGS)))
            setattr(self, name, value)
        self._say()

    # Numbers --------------------------------------------------------------------------------------------------

    @property
    def facts(self) -> Facts:
        """All numbers of the diagram at once."""
        return facts_of(
            self.environment, self.plane, self.angle, self.eye, self.ior, self.roughness, self.mode
        )

    @property
    def plane(self) -> Plane:
        """The plane of the diagram."""
        return Plane(self.azimuth)

    @property
    def incident(self) -> npt.NDArray[np.float64]:
        """ndarray (3,): I, in the world, of length 1; it points TOWARDS the surface."""
        return self.facts.incident

    @property
    def normal(self) -> npt.NDArray[np.float64]:
        """ndarray (3,): N, in the world, of length 1. The body lies on the other side."""
        return self.facts.normal

    @property
    def reflected(self) -> npt.NDArray[np.float64]:
        """ndarray (3,): R = ``cc.reflect(I, N)``."""
        return self.facts.reflected

    @property
    def refracted(self) -> npt.NDArray[np.float64] | None:
        """ndarray (3,): T = ``cc.refract(I, N, eta)``; None for a mirror and where all light is reflected."""
        return self.facts.refracted

    @property
    def share(self) -> float:
        """float: the share of light that glass of this `ior` reflects here, ``cc.fresnel(I, N, eta)``."""
        return self.facts.share

    @property
    def hit(self) -> Texel:
        """Texel: what R hits, or T where light is refracted: `face`, `row`, `column`, `direction`, `value`."""
        return self.facts.hit

    @property
    def color(self) -> npt.NDArray[np.float64]:
        """ndarray (C,): the linear light that the eye gets: a bilinear lookup, or the mean over the lobe.

        Glass mixes both: ``share`` of the light comes along R, the rest along T.
        """
        return self.facts.color

    @checked_call
    def at(self, x: float, y: float) -> Texel | None:
        """Find the texel under a place of the picture: of the band around the room, or of the small cross.

        `x` and `y` count logical pixels from the top left corner. None elsewhere.
        """
        layout = self._layout
        left, top, across, high = layout.cross
        if layout.has_cross and 0 <= x - left < across and 0 <= y - top < high:
            direction = layout.of_cross().directions(x - left, y - top)
            return texel_of(self.environment, direction) if np.isfinite(direction).all() else None
        flat = layout.flat(x, y, self.plane)
        if in_band(flat, self.plane):
            return texel_of(self.environment, self.plane.world(flat))
        return None

    @property
    def help(self) -> str:
        """What mouse and keys do, one line each."""
        return _HELP

    @property
    def _layout(self) -> Layout:
        return Layout.of(self._logical)

    # Drawing --------------------------------------------------------------------------------------------------

    def _picture(self, size: tuple[int, int], moving: bool) -> npt.NDArray[np.uint8]:
        if not self._ground.fresh():
            self._ground = Ground(self.environment)
        # Lines are drawn twice as large and averaged at rest, which makes them smooth.
        times = 1 if moving else 2
        large = (size[0] * times, size[1] * times)
        ratio = math.sqrt(size[0] * size[1] / (self._logical[0] * self._logical[1]))
        small, layout, facts = Layout.of(size, ratio), Layout.of(large, ratio * times), self.facts
        ground = self._ground.picture(
            small, self.plane, self.background, self.exposure, self.tonemap
        )
        ground = np.repeat(np.repeat(ground, times, axis=0), times, axis=1)
        color = light_on_screen(facts.color, self.exposure, self.tonemap)
        diagram = Diagram(ground, layout, self.plane, facts, self.background, color)
        texel = np.asarray(facts.hit.stored).astype(self.environment.dtype)[None, None]
        r, g, b = shown(self.environment, texel, self.exposure, self.tonemap)[0, 0].tolist()
        diagram.texel_color = (r, g, b)
        picture = diagram.draw()
        if times > 1:
            sums = (
                picture.reshape(size[1], times, size[0], times, 3)
                .astype(np.uint16)
                .sum(axis=(1, 3))
            )
            picture = ((sums + times * times // 2) // (times * times)).astype(np.uint8)
        opaque = np.full((*picture.shape[:2], 1), 255, np.uint8)
        return np.concatenate([picture, opaque], axis=-1)

    def _say(self) -> None:
        self.text = f"{'R' if self.refracted is None else 'T'} hits {self.hit}"

    # Events ---------------------------------------------------------------------------------------------------

    def changed(self, moving: bool = True) -> None:
        """Draw soon, and say what is hit now."""
        if "_background" in vars(self):  # all properties are set
            self._say()
        super().changed(moving)

    def _handle(self, event: dict[str, Any]) -> None:
        kind = event.get("event_type", "")
        if "size" in event:
            self._logical = tuple(event["size"])
        if kind in ("pointer_down", "pointer_move", "pointer_up"):
            self._point(kind, event)
        elif kind == "pointer_leave":
            self._say()
        elif kind == "wheel":
            self.roughness = min(1.0, max(0.0, self.roughness + event.get("dy", 0.0) / 4000))
        elif kind == "key_down":
            self._key(str(event.get("key", "")))
        if kind in ("pointer_up", "wheel", "key_down"):
            self._tell("panel", None)

    def _point(self, kind: str, event: dict[str, Any]) -> None:
        x, y = float(event["x"]), float(event["y"])
        flat = self._layout.flat(x, y, self.plane)
        if kind == "pointer_down":
            if float(np.abs(flat).max()) > max(self.plane.reach) + BAND:
                return
            apart = float(np.linalg.norm(flat - EYE * turned(self.eye)))
            self._grabbed = ("eye" if apart < _NEAR_THE_EYE else "angle", _degrees(flat))
        elif kind == "pointer_up" or event.get("buttons") == ():  # the button may be let go outside
            self._grabbed = None
        elif self._grabbed is not None:
            # The surface turns as far as the pointer goes round the middle.
            name, before = self._grabbed
            setattr(self, name, getattr(self, name) + _degrees(flat) - before)
            self._grabbed = (name, _degrees(flat))
        else:
            texel = self.at(x, y)
            if texel is None:
                self._say()
            else:
                self.text = str(texel)

    def _key(self, key: str) -> None:
        turns = {
            "ArrowLeft": ("angle", 5),
            "ArrowRight": ("angle", -5),
            "ArrowUp": ("azimuth", 5),
            "ArrowDown": ("azimuth", -5),
        }
        if key in turns:
            name, degrees = turns[key]
            setattr(self, name, getattr(self, name) + degrees)
        elif key == "m":
            self.mode = "refraction" if self.mode == "reflection" else "reflection"
        elif key == "r":
            self.reset()

    def reset(self) -> None:
        """Set everything as at first, except the mode and the background."""
        for name, value in self._SETTINGS.items():
            if name not in ("mode", "background"):
                setattr(self, name, value)

    def panel(self) -> list[Section]:
        """List what can be set."""

        def controls(*names: str) -> tuple[Control, ...]:
            return tuple(vars(type(self))[name].control(self) for name in names)

        reset = Control(
            "reset",
            "button",
            lambda: None,
            lambda _: self.reset(),
            help="Set everything as at first.",
        )
        return [
            Section("surface", (*controls("mode", "angle", "ior", "roughness"), reset)),
            Section("view", controls("eye", "azimuth", "exposure", "tonemap", "background")),
        ]


def _degrees(flat: npt.NDArray[Any]) -> float:
    """Give the angle of a place, from straight up, counter-clockwise."""
    return math.degrees(math.atan2(-float(flat[0]), float(flat[1])))


def default_environment() -> CubeMap:
    """Give a sample photograph with texels that are large enough to be seen."""
    from ..data import sample_data
    from ..io.cubemaps import load_environment

    return load_environment(sample_data("sunset.exr"), size=32)


@checked_call
def reflection(
    environment: CubeMap | None = None,
    *,
    mode: Mode = "reflection",
    angle: float = 20.0,
    eye: float = 55.0,
    azimuth: float = 0.0,
    ior: float = 1.5,
    roughness: float = 0.0,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    background: Theme = "dark",
    size: tuple[int, int] = (960, 600),
    where: Place | None = None,
    browser: bool = True,
    block: bool | None = None,
) -> ReflectionView:
    """Show live how a surface reflects or refracts a cubemap: the rays I and R or T, the normal N, and the texel hit.

    The diagram is a section through the middle of the cube. The band around the room shows the texels of the faces that
    the plane cuts, each in its direction: a ray ends at the texel that it hits. A drag turns the surface; a drag that
    starts at the eye moves the eye. The small cross shows the same texel on the six faces, seen from inside.

    Parameters
    ----------
    environment : CubeMap, optional
        None: the sample photograph "sunset.exr" with 32 x 32 texels a face.
    mode : {"reflection", "refraction"}
        A mirror, or a body of glass behind the surface. From within the glass all light is reflected beyond the
        critical angle.
    angle, eye : float
        Degrees by which N is turned, and by which the eye stands, from straight up, counter-clockwise.
    azimuth : float
        Degrees by which the plane is turned about +Y; at 0 it holds +X (to the right) and +Y.
    ior : float
        The refractive index of the glass, 0.25 to 4.
    roughness : float
        0 to 1. Above 0 the diagram shows the lobe of GGX with ``alpha = roughness**2``: some of the directions in which
        the facets of the surface send the light, and how densely these lie in the plane.
    exposure, tonemap
        As in `to_screen`.
    background : {"dark", "light"}
        The colour of the paper.
    size : (int, int)
        Width and height of the picture in logical pixels.
    where : {"notebook", "page", "window", "terminal", "offscreen"}, optional
        Default: the notebook in Jupyter, a window where there is a screen and Qt, the terminal over SSH, else a page
        for a browser on this machine.
    browser : bool
        Whether a page is opened in the browser.
    block : bool, optional
        Whether the call returns only after the view was closed or Ctrl-C was typed. Default: in scripts yes, in
        notebooks and in Python's prompt no.

    Returns
    -------
    ReflectionView
        The live view. Its properties have the names of these options; `hit` is the texel, `reflected`, `refracted`,
        `share` and `color` are the numbers of the diagram.

    Raises
    ------
    TypeError, ValueError
        For an option of another type, an unknown name or a number out of range.
    ImportError
        If a package is missing; the message names the extra of cubecam that has it.

    Notes
    -----
    Directions and shares are those of `cubecam.reflect`, `cubecam.refract` and `cubecam.fresnel`. The lobe is that of
    B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007. After "WebGL Environment Maps" of
    webglfundamentals.org.

    Examples
    --------
    >>> import cubecam as cc
    >>> with cc.explore.reflection(where="offscreen", angle=20, eye=55) as diagram:
    ...     print(diagram.hit.places["gl"], diagram.reflected.round(3).tolist())
    +Y row 16 column 20 [0.259, 0.966, 0.0]
    """
    view = ReflectionView(
        environment, mode=mode, angle=angle, eye=eye, azimuth=azimuth, ior=ior, roughness=roughness,
        exposure=exposure, tonemap=tonemap, background=background, size=size,
    )  # fmt: skip
    return shown_at(view, where, browser, block)
