"""Draws the diagram of `ReflectionView`: the plane with its rays, the cross, the words."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._core import CubeMap
from ..io.screen import to_screen
from ..viewer.cube_drawing import THEMES, Painter, face_places, pixel_middles
from ..viewer.cube_maps import Cross
from ..viewer.lettering import Lettering
from ..viewer.texels import CONVENTIONS
from ._optics import Facts, Plane, turned

if TYPE_CHECKING:
    from ..typing import Tonemap

Array = npt.NDArray[Any]
Color = tuple[int, int, int]

#: The width of the band of texels around the room, in units of half the cube's edge.
BAND = 0.16
#: How far from the middle the eye stands, and half the length of the surface.
EYE, SURFACE = 0.86, 0.52


@dataclass(frozen=True)
class Rays:
    """The colours of the vectors."""

    incident: Color
    normal: Color
    reflected: Color
    refracted: Color
    glass: tuple[int, int, int, int]


RAYS = {
    "dark": Rays(
        (236, 239, 243), (92, 204, 120), (255, 99, 88), (86, 168, 255), (86, 168, 255, 46)
    ),
    "light": Rays((28, 32, 38), (24, 138, 60), (212, 40, 36), (20, 96, 205), (40, 120, 230, 34)),
}


@dataclass(frozen=True)
class Layout:
    """Where everything stands in a picture of some size, in pixels; `ratio` of them make a logical pixel."""

    size: tuple[float, float]
    ratio: float
    room: tuple[float, float, float]  # left, top, edge of the square with the plane
    cross: tuple[int, int, int, int]  # left, top, width, height; width 0: there is none
    words: tuple[float, float, float, float]  # left, top, width, height

    @classmethod
    def of(cls, size: tuple[float, float], ratio: float = 1.0) -> Layout:
        """Place the plane on the left and the rest on its right, or below it in a picture that is not wide."""
        width, height = size
        if width >= 1.25 * height:
            edge = min(height, 0.62 * width)
            left, rest = edge, width - edge
            across = round(rest * 0.94)
            high = min(round(across * 0.75), round(height * 0.46))
            return cls(
                size, ratio, (0, (height - edge) / 2, edge),
                (round(left), round(height * 0.03), across, high),
                (left + 0.02 * rest, height * 0.04 + high, rest * 0.94, height * 0.96 - high),
            )  # fmt: skip
        edge = min(width, 0.62 * height)
        rest = height - edge
        across = round(min(width * 0.45, rest * 1.25))
        return cls(
            size, ratio, ((width - edge) / 2, 0, edge),
            (round(width * 0.02), round(edge), across, round(rest * 0.96)),
            (width * 0.04 + across, edge + 0.02 * rest, width * 0.94 - across, rest * 0.96),
        )  # fmt: skip

    @property
    def unit(self) -> float:
        """The height of letters in pixels."""
        width, height = (side / self.ratio for side in self.size)
        wide = width >= 1.25 * height
        fitting = min(width / 56, height / 35) if wide else min(width / 40, height / 50)
        return self.ratio * max(9.0, min(fitting, 30.0))

    @property
    def has_cross(self) -> bool:
        """Whether the cross is large enough to be drawn."""
        return self.cross[2] / self.ratio >= 80

    def scale(self, plane: Plane) -> float:
        """Pixels for a unit of the diagram: half the edge of the cube."""
        return self.room[2] / 2 * 0.96 / (max(plane.reach) + BAND)

    def pixel(self, flat: npt.ArrayLike, plane: Plane) -> Array:
        """Convert (..., 2) of the diagram, y up, to pixels."""
        left, top, edge = self.room
        at = np.asarray(flat, float) * (1, -1) * self.scale(plane)
        return np.asarray(at + np.array([left + edge / 2, top + edge / 2]))

    def flat(self, x: npt.ArrayLike, y: npt.ArrayLike, plane: Plane) -> Array:
        """Convert pixels to (..., 2) of the diagram."""
        left, top, edge = self.room
        across = (np.asarray(x, float) - left - edge / 2) / self.scale(plane)
        up = (top + edge / 2 - np.asarray(y, float)) / self.scale(plane)
        return np.stack(np.broadcast_arrays(across, up), axis=-1)

    def of_cross(self) -> Cross:
        """Give the map of the small cross, whose pixels start at its own corner."""
        return Cross(self.cross[2:], "inside")


def in_band(flat: Array, plane: Plane) -> Array:
    """Whether places (..., 2) of the diagram lie in the band of texels around the room."""
    reach = np.asarray(plane.reach)
    size = np.abs(flat)
    return np.asarray((size <= reach + BAND).all(axis=-1) & (size > reach).any(axis=-1))


class Ground:
    """What does not change while the surface turns: the band of texels and the cross. Two pictures are kept."""

    def __init__(self, environment: CubeMap) -> None:
        self._painter = Painter(environment)
        self._kept: dict[Any, Array] = {}

    def fresh(self) -> bool:
        """Whether the environment still has the faces that were drawn."""
        return self._painter.fresh()

    def picture(
        self, layout: Layout, plane: Plane, theme: str, exposure: float, tonemap: Tonemap | None
    ) -> Array:
        """Draw paper, band and cross, (height, width, 3), a new array."""
        key = (layout, plane, theme, exposure, tonemap)
        # A moving view and one at rest take turns at two sizes.
        if key not in self._kept:
            last = list(self._kept.items())[-1:]
            self._kept = {**dict(last), key: self._draw(layout, plane, theme, exposure, tonemap)}
        return np.array(self._kept[key])

    def _draw(
        self, layout: Layout, plane: Plane, theme: str, exposure: float, tonemap: Tonemap | None
    ) -> Array:
        inks, cube = THEMES[theme], self._painter.cube
        width, height = (round(side) for side in layout.size)
        picture = np.empty((height, width, 3), np.uint8)
        picture[:] = inks.paper
        flat = layout.flat(*pixel_middles((width, height)), plane)
        band = in_band(flat, plane)
        # Each pixel of the band shows the texel in its direction, so that a ray ends at the texel that it hits.
        face, s, t = face_places(plane.world(flat[band]))
        n = cube.size
        row, column = (np.minimum((place * n).astype(np.intp), n - 1) for place in (t, s))
        colors = shown(cube, cube.faces[face, row, column][:, None], exposure, tonemap)[:, 0]
        picture[band] = colors
        left, top, across, high = layout.cross
        if layout.has_cross:
            small = self._painter.paint(
                layout.of_cross(), (across, high), exposure=exposure, tonemap=tonemap,
                smooth=False, paper=inks.paper,
            )  # fmt: skip
            part = picture[top : top + high, left : left + across]
            part[:] = small[: part.shape[0], : part.shape[1]]
        return picture


def shown(cube: CubeMap, pixels: Array, exposure: float, tonemap: Tonemap | None) -> Array:
    """Turn numbers (H, W, C) of a cube into 8 bits (H, W, 3), as `to_screen` would the cube."""
    from ..io.screen import Clipping, screen_pixels

    mappable = pixels.dtype.kind == "f" and cube.encoding == "linear"
    with Clipping().gathered():
        done = screen_pixels(pixels, cube.encoding, exposure, tonemap if mappable else None, True)
    return np.repeat(done, 3, axis=-1) if done.shape[-1] == 1 else done[..., :3]


def light_on_screen(light: Array, exposure: float, tonemap: Tonemap | None) -> Color:
    """Turn one linear colour of 1, 3 or 4 channels into 8 bits."""
    from ..io.screen import Clipping

    with Clipping().gathered():
        pixel = to_screen(
            np.asarray(light, np.float32)[None, None], exposure=exposure, tonemap=tonemap
        )[0, 0]
    r, g, b = (pixel.tolist() * 3)[:3] if len(pixel) == 1 else pixel.tolist()[:3]
    return r, g, b


class Diagram:
    """One drawing; everything is in pixels of a picture that may be larger than the one that is shown."""

    def __init__(
        self,
        ground: Array,
        layout: Layout,
        plane: Plane,
        facts: Facts,
        theme: str,
        color: Color,
    ) -> None:
        self.layout, self.plane, self.facts = layout, plane, facts
        inks = THEMES[theme]
        self.inks, self.rays, self.color = inks, RAYS[theme], color
        self.unit = layout.unit
        self.letters = Lettering(ground, inks.ink, inks.paper, self.unit)
        self.pen = self.letters.draw
        self.scale = layout.scale(plane)

    # Lines ----------------------------------------------------------------------------------------------------

    def at(self, flat: npt.ArrayLike) -> tuple[float, float]:
        x, y = self.layout.pixel(flat, self.plane).tolist()
        return x, y

    def line(self, a: npt.ArrayLike, b: npt.ArrayLike, color: Any, width: float) -> None:
        self.pen.line([self.at(a), self.at(b)], fill=color, width=max(1, round(width)))

    def dashes(self, a: npt.ArrayLike, b: npt.ArrayLike, color: Any, width: float) -> None:
        a, b = np.asarray(a, float), np.asarray(b, float)
        count = max(1, round(float(np.linalg.norm(b - a)) * self.scale / (0.8 * self.unit)))
        for k in range(count):
            self.line(a + (b - a) * k / count, a + (b - a) * (k + 0.55) / count, color, width)

    def arrow(self, a: npt.ArrayLike, b: npt.ArrayLike, color: Color, width: float = 0.2) -> None:
        """Draw a line with a head at b; the width is in units of the letters' height."""
        a, b = np.asarray(a, float), np.asarray(b, float)
        along = (b - a) / max(float(np.linalg.norm(b - a)), 1e-9)
        head = (0.5 + 2.2 * width) * self.unit / self.scale
        neck = b - along * head
        self.line(a, neck + along * head * 0.3, color, width * self.unit)
        across = np.array([-along[1], along[0]]) * head * 0.42
        self.pen.polygon([self.at(b), self.at(neck + across), self.at(neck - across)], fill=color)

    def label(self, text: str, flat: npt.ArrayLike, color: Color, scale: float = 1.25) -> None:
        """Write a vector's name with an edge of paper, so that lines behind it do not disturb."""
        x, y = self.at(flat)
        font = self.letters._font(scale)
        self.pen.text(
            (round(x), round(y)), text, color, font, anchor="mm",
            stroke_width=max(1, round(self.unit * 0.18)), stroke_fill=self.inks.paper,
        )  # fmt: skip

    # Parts ----------------------------------------------------------------------------------------------------

    def draw(self) -> Array:
        """Draw all parts over the ground."""
        self.room()
        self.body()
        self.lobe()
        self.vectors()
        self.cross()
        self.words()
        return self.letters.picture

    def room(self) -> None:
        reach = np.asarray(self.plane.reach)
        for grown in (reach, reach + BAND):
            (l, t), (r, b) = self.at(grown * (-1, 1)), self.at(grown * (1, -1))  # noqa: E741
            self.pen.rectangle(
                (l, t, r, b), outline=self.inks.faint, width=max(1, round(self.unit / 12))
            )
        # The names of the faces stand inside the room, in the middle of each side.
        names = {"+Y": (0.0, 1.0), "-Y": (0.0, -1.0)}
        for sign in (1, -1):
            x, _, z = (sign * self.plane.axes[0]).tolist()
            name = ("+X" if x > 0 else "-X") if abs(x) >= abs(z) else ("+Z" if z > 0 else "-Z")
            names[name] = (sign * reach[0], 0.0)
        inwards = 0.9 * self.unit / self.scale
        for name, middle in names.items():
            edge = np.asarray(middle)
            self.label(name, edge - np.sign(edge) * inwards * (1.1, 1), self.inks.faint, 1.0)

    def body(self) -> None:
        normal = self.plane.flat(self.facts.normal)
        along = np.array([normal[1], -normal[0]])
        if self.facts.mode == "refraction":
            x, y = self.at((0, 0))
            r = SURFACE * self.scale
            # Pillow counts degrees clockwise from the right; the half disc lies behind the surface.
            start = math.degrees(math.atan2(-along[1], along[0]))
            self.pen.pieslice(
                (x - r, y - r, x + r, y + r), start, start + 180, fill=self.rays.glass
            )
        thick = 0.5 * self.unit
        ends = SURFACE * along
        back = -normal * thick / self.scale / 2
        self.line(-ends + back, ends + back, self.inks.ink, thick + 0.22 * self.unit)
        inner = ends * (1 - 0.11 * self.unit / self.scale / SURFACE)
        self.line(-inner + back, inner + back, self.color, thick)

    def lobe(self) -> None:
        facts = self.facts
        if not len(facts.spread):
            return
        color = self.rays.refracted if facts.main is facts.refracted else self.rays.reflected
        long = 0.62
        for direction in self.plane.flat(facts.spread)[:: max(1, len(facts.spread) // 128)]:
            self.line((0, 0), direction * long, (*color, 40), 0.07 * self.unit)
        outline = self.layout.pixel(facts.outline(self.plane) * long, self.plane)
        points = [tuple(p) for p in outline.tolist()]
        self.pen.polygon(points, fill=(*color, 44))
        self.pen.line(
            [*points, points[0]], fill=(*color, 200), width=max(1, round(0.09 * self.unit))
        )

    def vectors(self) -> None:
        facts, rays, flat = self.facts, self.rays, self.plane.flat
        incident, normal = flat(facts.incident), flat(facts.normal)
        reflected = flat(facts.reflected)
        eye = -EYE * incident
        long = 0.62
        if facts.mode == "reflection":
            # The formula as a path: I goes on behind the surface, and -2 (N.I) N leads from its tip to R's.
            self.dashes((0, 0), long * incident, rays.incident, 0.1 * self.unit)
            self.dashes(long * incident, long * reflected, rays.normal, 0.1 * self.unit)
        else:
            self.dashes((0, 0), -0.5 * flat(facts.facing), self.inks.faint, 0.08 * self.unit)
        self.angles()
        self.arrow((0, 0), 0.5 * normal, rays.normal)
        if float(normal @ reflected) > 0.99:  # R lies on N, and would hide its name
            self.name_of("N", 0.36 * normal, reflected, rays.normal, normal)
        else:
            self.label("N", 0.58 * normal, rays.normal)
        self.arrow(eye, (0, 0), rays.incident)
        through = facts.refracted
        if facts.mode == "reflection" or through is None:
            self.ray(reflected, rays.reflected, 0.2)
        else:
            self.ray(reflected, rays.reflected, 0.04 + 0.2 * math.sqrt(facts.share))
            self.ray(flat(through), rays.refracted, 0.04 + 0.2 * math.sqrt(1 - facts.share))
        self.eye(eye, incident)
        self.name_of("I", -0.58 * EYE * incident, incident, rays.incident, normal)
        self.name_of("R", 0.72 * reflected, reflected, rays.reflected, normal)
        if through is not None:
            bent = flat(through)
            self.name_of("T", 0.72 * bent, bent, rays.refracted, -normal)

    def ray(self, direction: Array, color: Color, width: float) -> None:
        """Draw a ray from the surface into the band."""
        reach = np.asarray(self.plane.reach) + 0.25 * BAND
        with np.errstate(divide="ignore"):
            far = float((reach / np.abs(direction)).min())
        self.arrow((0, 0), direction * far, color, width)

    def name_of(self, name: str, place: Array, direction: Array, color: Color, away: Array) -> None:
        """Write a vector's name beside it, on the side that lies away from the normal."""
        across = np.array([-direction[1], direction[0]])
        across = across if float(across @ away) < 0 else -across
        self.label(name, place + across * 0.95 * self.unit / self.scale, color)

    def angles(self) -> None:
        """Mark the angles between the normal and the rays."""
        facts, flat = self.facts, self.plane.flat
        facing = flat(facts.facing)
        pairs = [
            (facing, -flat(facts.incident), self.rays.incident),
            (facing, flat(facts.reflected), self.rays.reflected),
        ]
        if facts.refracted is not None:
            pairs = [pairs[0], (-facing, flat(facts.refracted), self.rays.refracted)]
        for a, b, color in pairs:
            self.angle(a, b, color)

    def angle(self, a: Array, b: Array, color: Color) -> None:
        between = math.degrees(math.acos(min(1.0, max(-1.0, float(a @ b)))))
        if between < 1:
            return
        radius = 0.23
        first, second = (math.degrees(math.atan2(-v[1], v[0])) for v in (a, b))
        start, end = (first, second) if (second - first) % 360 < 180 else (second, first)
        x, y = self.at((0, 0))
        r = radius * self.scale
        self.pen.arc(
            (x - r, y - r, x + r, y + r),
            start,
            end,
            fill=color,
            width=max(1, round(0.1 * self.unit)),
        )
        middle = (a + b) / max(float(np.linalg.norm(a + b)), 1e-9)
        if between > 12:
            self.label(
                f"{between:.1f}°", middle * (radius + 1.1 * self.unit / self.scale), color, 0.8
            )

    def eye(self, place: Array, incident: Array) -> None:
        x, y = self.at(place)
        r = 0.62 * self.unit
        self.pen.ellipse(
            (x - r, y - r, x + r, y + r),
            fill=self.inks.paper,
            outline=self.inks.ink,
            width=max(1, round(0.13 * self.unit)),
        )
        px, py = self.at(place + incident * 0.28 * self.unit / self.scale)
        s = 0.26 * self.unit
        self.pen.ellipse((px - s, py - s, px + s, py + s), fill=self.inks.ink)

    def cross(self) -> None:
        if not self.layout.has_cross:
            return
        corner = np.array(self.layout.cross[:2])
        cross = self.layout.of_cross()
        edge = cross.sheet.scale
        for cell in cross.cells:
            x, y = cross.sheet.pixels(cell.column, cell.row) + corner
            self.letters.write(
                cell.name, (x + 0.06 * edge, y + 0.05 * edge), scale=min(0.9, edge / 60)
            )
        # On a photograph the colours of the dark paper are the ones that can be seen.
        rays = RAYS["dark"]
        color = rays.refracted if self.facts.main is self.facts.refracted else rays.reflected
        dot = max(1.0, 0.08 * self.unit)
        if len(self.facts.spread):
            for x, y in (cross.places(self.facts.spread) + corner).tolist():
                self.pen.ellipse((x - dot, y - dot, x + dot, y + dot), fill=(*color, 190))
        x, y = (cross.places(self.facts.main) + corner).tolist()
        self.target(x, y, color)

    def target(self, x: float, y: float, color: Color) -> None:
        """Mark the texel that is hit: a ring in the ray's colour between dark and white ones."""
        for radius, ink, width in (
            (0.78, (20, 24, 30), 0.46),
            (0.78, (255, 255, 255), 0.3),
            (0.78, color, 0.18),
        ):
            r = (radius + width / 2) * self.unit
            self.pen.ellipse(
                (x - r, y - r, x + r, y + r), outline=ink, width=max(1, round(width * self.unit))
            )

    # Words ----------------------------------------------------------------------------------------------------

    def words(self) -> None:
        left, top, width, height = self.layout.words
        step = 1.4 * self.unit
        y = top + 0.4 * self.unit
        for line in sentences(self.facts):
            pieces = self.letters.wrapped(line.text, width - (1.2 * self.unit if line.color else 0))
            if y + len(pieces) * step > top + height:
                return
            x = left
            if line.color is not None:
                paint = {"texel": self.texel_color, "surface": self.color}.get(line.color)
                if paint is not None:
                    self.pen.rectangle(
                        (x, y + 0.12 * self.unit, x + 0.9 * self.unit, y + 1.02 * self.unit),
                        fill=paint, outline=self.inks.ink, width=max(1, round(self.unit / 14)),
                    )  # fmt: skip
                    x += 1.3 * self.unit
            inks = {**vars(self.rays), "faint": self.inks.faint}
            ink = inks[line.ink] if line.ink else None
            for piece in pieces:
                self.letters.write(piece, (x, y), plain=True, ink=ink)
                y += step
            y += line.gap * self.unit

    texel_color: Color = (0, 0, 0)


@dataclass(frozen=True)
class Line:
    """One line of the words: its ink, the colour of a box before it, the gap after it."""

    text: str
    ink: str = ""
    color: str | None = None
    gap: float = 0.0


def vector_words(v: Array) -> str:
    """Write a vector with two digits; no minus stands before a 0."""
    return (
        "(" + ", ".join(f"{0.0 if abs(x) < 0.005 else x:.2f}" for x in np.asarray(v).tolist()) + ")"
    )


def sentences(facts: Facts) -> list[Line]:
    """Say what the diagram shows."""
    inward = math.degrees(math.acos(min(1.0, abs(facts.cosine))))
    lines = [
        Line(f"I = {vector_words(facts.incident)}", "incident"),
        Line(f"N = {vector_words(facts.normal)}", "normal"),
    ]
    if facts.mode == "reflection":
        lines += [
            Line(f"N·I = {facts.cosine:.3f}"),
            Line(f"R = I - 2 (N·I) N = {vector_words(facts.reflected)}", "reflected", gap=0.5),
        ]
    else:
        if facts.refracted is None:
            assert facts.critical is not None
            lines += [
                Line(
                    f"total internal reflection: {inward:.1f}° is beyond {facts.critical:.1f}°",
                    "reflected",
                ),
                Line(f"R = {vector_words(facts.reflected)}: 100 %", "reflected", gap=0.5),
            ]
        else:
            outward = math.degrees(
                math.acos(min(1.0, float(np.abs(facts.normal @ facts.refracted))))
            )
            lines += [
                Line(f"eta = {facts.eta:.3f}: sin {outward:.1f}° = eta sin {inward:.1f}°"),
                Line(
                    f"T = {vector_words(facts.refracted)}: {100 * (1 - facts.share):.1f} %",
                    "refracted",
                ),
                Line(
                    f"R = {vector_words(facts.reflected)}: {100 * facts.share:.1f} %",
                    "reflected",
                    gap=0.5,
                ),
            ]
    name = "R" if facts.main is facts.reflected else "T"
    places = facts.hit.places
    value = ", ".join(f"{v:.3g}" for v in facts.hit.value)
    lines += [
        Line(f"{name} hits {places['gl']}", color="texel"),
        Line(f"its light: ({value})"),
        Line("light that the eye gets", color="surface", gap=0.5),
    ]
    if facts.roughness:
        lines.append(Line(f"lobe: GGX (Walter 2007), roughness {facts.roughness:.2f}", gap=0.5))
    lines += [Line(f'"{other}": {places[other]}', "faint") for other in CONVENTIONS[1:]]
    return lines


__all__ = ["Diagram", "Ground", "Layout", "in_band", "light_on_screen", "shown", "turned"]
