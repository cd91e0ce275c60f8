"""Line drawings of cameras, lights and probes as SVG, in the colour of the text around them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

__all__ = ["cross", "eyes", "frustum", "lamp", "ray", "slab"]

_ACCENT = "#5b8def"
_SHADE = "#5b8def33"


def _svg(width: int, height: int, *parts: str) -> str:
    return (
        f'<svg width="{width}" height="{height}" viewBox="0 0 {width} {height}" fill="none" '
        f'stroke="currentColor" stroke-width="1.4" stroke-linejoin="round" stroke-linecap="round" '
        f'style="display:block" role="img">{"".join(parts)}</svg>'
    )


def _path(points: Sequence[tuple[float, float]], more: str = "", close: bool = True) -> str:
    text = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path d="M{text}{"Z" if close else ""}" {more}></path>'


def _text(x: float, y: float, text: str, anchor: str = "middle") -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="10" font-family="system-ui,sans-serif" '
        f'text-anchor="{anchor}" fill="currentColor" stroke="none">{text}</text>'
    )


def _body(x: float, y: float) -> str:
    """Draw a small camera whose lens is at (x, y) and looks to the right."""
    body = [(x - 17, y - 6), (x - 5, y - 6), (x - 5, y + 6), (x - 17, y + 6)]
    lens = [(x - 5, y - 2), (x, y - 5), (x, y + 5), (x - 5, y + 2)]
    fill = 'fill="currentColor" fill-opacity=".85" stroke="none"'
    return _path(body, fill) + _path(lens, fill)


def frustum(fov: float, shift: float = 0.0) -> str:
    """Draw what a perspective camera sees, from the side: the true vertical angle, not the true distances."""
    half = math.tan(math.radians(min(max(fov, 1), 165) / 2))
    eye, middle, reach = 22.0, 48.0, min(140.0, 40 / half)
    up, down = half * (1 + 2 * shift), half * (1 - 2 * shift)
    largest = max(abs(up), abs(down), 1e-6)
    reach = min(reach, 44 / largest)
    near = max(reach * 0.28, 2)

    def at(distance: float) -> tuple[tuple[float, float], tuple[float, float]]:
        return (eye + distance, middle - up * distance), (eye + distance, middle + down * distance)

    (a, b), (c, d) = at(near), at(reach)
    inside = _path([a, c, d, b], f'fill="{_SHADE}" stroke="{_ACCENT}"')
    rays = _path([(eye, middle), a], 'stroke-dasharray="2 3"', close=False)
    rays += _path([(eye, middle), b], 'stroke-dasharray="2 3"', close=False)
    axis = _path([(eye, middle), (eye + reach + 10, middle)], 'stroke-opacity=".35"', close=False)
    label = _text(eye + reach + 6, middle - 4, f"{fov:.4g}°", "start")
    return _svg(round(eye + reach) + 54, 96, axis, inside, rays, _body(eye, middle), label)


def slab(height: float) -> str:
    """Draw what an orthographic camera sees, from the side: parallel rays."""
    inside = _path(
        [(44, 20), (168, 20), (168, 76), (44, 76)], f'fill="{_SHADE}" stroke="{_ACCENT}"'
    )
    rays = "".join(
        _path([(30, y), (44, y)], 'stroke-dasharray="2 3"', close=False) for y in (20, 48, 76)
    )
    edge = _path([(178, 20), (178, 76)], 'stroke-opacity=".5"', close=False)
    label = _text(184, 51, f"{height:.4g}", "start")
    return _svg(220, 96, inside, rays, edge, _body(24, 48), label)


def eyes() -> str:
    """Draw two cameras and what both see."""
    cones = "".join(
        _path([(22, y), (150, y - 40), (150, y + 40)], f'fill="{_SHADE}" stroke="{_ACCENT}"')
        for y in (40, 56)
    )
    return _svg(220, 112, cones, _body(22, 40), _body(22, 56))


def cross(size: int) -> str:
    """Draw the six faces of a probe's cube, unfolded."""
    cells = [(1, 0), (0, 1), (1, 1), (2, 1), (3, 1), (1, 2)]
    parts = [
        _path(
            [
                (x * 26 + 2, y * 26 + 2),
                (x * 26 + 28, y * 26 + 2),
                (x * 26 + 28, y * 26 + 28),
                (x * 26 + 2, y * 26 + 28),
            ],
            f'fill="{_SHADE}" stroke="{_ACCENT}"' if (x, y) == (1, 1) else 'stroke-opacity=".6"',
        )
        for x, y in cells
    ]
    return _svg(108, 82, *parts, _text(41, 44.5, str(size)))


def _seen(vector: Iterable[float]) -> tuple[float, float]:
    """Project a vector as the thumbnails of meshes are seen: from above and from the right."""
    x, y, z = (float(v) for v in vector)
    turn, tilt = math.radians(34), math.radians(25)
    across = x * math.cos(turn) - z * math.sin(turn)
    towards = x * math.sin(turn) + z * math.cos(turn)
    return across, y * math.cos(tilt) - towards * math.sin(tilt)


def _axes(x: float, y: float, length: float) -> str:
    parts = []
    for name, axis in (("x", (1, 0, 0)), ("y", (0, 1, 0)), ("z", (0, 0, 1))):
        across, up = _seen(axis)
        end = (x + length * across, y - length * up)
        parts.append(_path([(x, y), end], 'stroke-opacity=".4"', close=False))
        parts.append(_text(x + (length + 8) * across, y - (length + 8) * up + 3, name))
    return "".join(parts)


def ray(direction: Iterable[float], color: str, angle: float | None = None) -> str:
    """Draw the way that light travels, with the axes of the world; a spot light has a cone of its angle."""
    across, up = _seen(direction)
    middle, reach = (56.0, 52.0), 38.0
    start = (middle[0] - reach * across, middle[1] + reach * up)
    end = (middle[0] + reach * across, middle[1] - reach * up)
    flat = np.array([across, -up])
    length = float(np.hypot(*flat))
    parts = [_axes(*middle, 30)]
    if length < 0.08:  # the light comes out of the picture or goes into it
        ring = f'<circle cx="{middle[0]}" cy="{middle[1]}" r="7" fill="{color}"></circle>'
        return _svg(112, 104, *parts, ring)
    along = flat / length
    side = np.array([-along[1], along[0]])
    if angle is not None:
        spread = min(math.tan(math.radians(angle)), 1.2) * 2 * reach * length
        corners = [start, *(tuple(np.array(end) + sign * spread * side) for sign in (-1, 1))]
        parts.append(_path(corners, f'fill="{color}" fill-opacity=".45" stroke-opacity=".5"'))
    tip = np.array(end)
    head = [
        tuple(tip),
        tuple(tip - 10 * along + 5 * side),
        tuple(tip - 10 * along - 5 * side),
    ]
    parts.append(_path([start, end], 'stroke-width="2.4"', close=False))
    parts.append(_path(head, 'fill="currentColor"'))
    parts.append(f'<circle cx="{start[0]:.1f}" cy="{start[1]:.1f}" r="6" fill="{color}"></circle>')
    return _svg(112, 104, *parts)


def lamp(color: str, rays: bool = True) -> str:
    """Draw a light that shines in all directions; without rays it is the light that is everywhere."""
    spokes = []
    for step in range(12):
        turn = step * math.pi / 6
        across, up = math.cos(turn), math.sin(turn)
        inner, outer = (18, 30) if rays else (15, 18)
        spokes.append(
            _path(
                [(40 + inner * across, 40 + inner * up), (40 + outer * across, 40 + outer * up)],
                close=False,
            )
        )
    return _svg(80, 80, *spokes, f'<circle cx="40" cy="40" r="12" fill="{color}"></circle>')
