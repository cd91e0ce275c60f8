"""A scene in the making: unlit things whose light is painted on them, so that exact rays have no noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import cubecam as cc

from .paint import Array, Color, in_bytes

Vector = Sequence[float]
#: The name of the empty node at the middle of the reflector.
PLACE = "place of the reflector"
#: Where the painted light comes from, how much is everywhere, and how much of it comes from there.
LAMP, AMBIENT, DIRECT = np.array((0.35, 0.85, 0.4)), 0.62, 0.42


class Stage:
    """Adds things to a scene.

    Parameters
    ----------
    linear : bool
        False: colours are numbers of a screen, as in the rooms. True: colours are decoded (IEC 61966-2-1), so that they
        are light, like a photograph of the sky beside them.
    """

    def __init__(self, *, linear: bool = False, background: Color = (0, 0, 0)) -> None:
        self.scene = cc.Scene(background=background)
        self._linear = linear
        toward = LAMP / np.linalg.norm(LAMP)
        self._toward = np.asarray(toward)
        self._maps: dict[bytes, cc.Image] = {}

    def material(self, color: Color | Array) -> cc.BasicMaterial:
        """Make a material of a colour or of a picture (H, W, 3)."""
        found = np.asarray(color, float)
        if found.ndim == 1:
            return cc.BasicMaterial(color=self._light(found), vertex_colors=True)
        pixels = in_bytes(found)
        key = pixels.tobytes()
        if key not in self._maps:
            self._maps[key] = (
                cc.Image(self._light(pixels / 255).astype(np.float16))
                if self._linear
                else cc.Image(pixels)
            )
        return cc.BasicMaterial(map=self._maps[key], vertex_colors=True)

    def _light(self, color: Array) -> Array:
        if not self._linear:
            return color
        return np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)

    def add(
        self,
        mesh: cc.Mesh,
        color: Color | Array,
        at: Vector = (0, 0, 0),
        *,
        turn: float = 0.0,
        axis: Vector = (0, 1, 0),
        name: str = "",
        even: bool = False,
        repeat: Vector = (1, 1),
    ) -> cc.Node:
        """Add a mesh, turned by degrees about an axis, with the light of the lamp painted on it, or `even` light.

        `repeat` tells how often the picture is repeated along u and v.
        """
        rotation = np.asarray(cc.axis_angle(axis, turn))
        return self.scene.add(
            self._painted(mesh, rotation, even=even, repeat=repeat),
            self.material(color),
            position=at,
            rotation=rotation,
            name=name,
        )

    def _painted(self, mesh: cc.Mesh, rotation: Array, *, even: bool, repeat: Vector) -> cc.Mesh:
        w, x, y, z = rotation
        r = np.array(
            (
                (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
                (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
                (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
            )
        )
        normals = np.asarray(mesh.normals, float) @ r.T
        # Half Lambert: light reaches round a body.
        light = AMBIENT + DIRECT * (0.5 + 0.5 * normals @ self._toward) ** 1.5
        shade = np.ones(len(normals)) if even else np.clip(light, 0, 1)
        colors = self._light(np.repeat(shade[:, None], 3, axis=1))
        uvs = mesh.uvs
        return cc.Mesh(
            mesh.positions,
            mesh.indices,
            normals=mesh.normals,
            uvs=None if uvs is None else np.asarray(uvs) * repeat,
            colors=colors.astype(np.float32),
        )

    def box(
        self,
        low: Vector,
        high: Vector,
        color: Color | Array,
        name: str = "",
        *,
        repeat: Vector = (1, 1),
    ) -> cc.Node:
        """Add a box between two corners."""
        a, b = np.asarray(low, float), np.asarray(high, float)
        return self.add(cc.Mesh.box(b - a), color, (a + b) / 2, name=name, repeat=repeat)

    def quad(
        self,
        corner: Vector,
        right: Vector,
        up: Vector,
        color: Color | Array,
        name: str = "",
        *,
        repeat: Vector = (1, 1),
    ) -> cc.Node:
        """Add a parallelogram with even light, seen from the side on which `up` is to the left of `right`."""
        a, u, v = (np.asarray(t, float) for t in (corner, right, up))
        middle = a + (u + v) / 2
        corners = np.array((a, a + u, a + u + v, a + v)) - middle
        normal = np.cross(u, v) / np.linalg.norm(np.cross(u, v))
        mesh = cc.Mesh(
            corners,
            ((0, 1, 2), (0, 2, 3)),
            normals=np.tile(normal, (4, 1)),
            uvs=((0, 0), (1, 0), (1, 1), (0, 1)),
        )
        return self.add(mesh, color, middle, name=name, even=True, repeat=repeat)

    def ground(
        self,
        low: Sequence[float],
        high: Sequence[float],
        color: Color | Array,
        name: str,
        cell: float,
    ) -> cc.Node:
        """Add a rectangle (x, z) of the ground, with a picture that is repeated every `cell` metres of the world."""
        (x, z), (a, b) = low, high
        corners = np.array(((x, 0, b), (a, 0, b), (a, 0, z), (x, 0, z)), float)
        mesh = cc.Mesh(
            corners,
            ((0, 1, 2), (0, 2, 3)),
            normals=np.tile((0.0, 1.0, 0.0), (4, 1)),
            uvs=corners[:, [0, 2]] * (1 / cell, -1 / cell),
        )
        return self.add(mesh, color, name=name, even=True)

    def walls(self, low: Vector, high: Vector, colors: Sequence[Array], repeat: Vector) -> None:
        """Add the six sides of a room, seen from inside: floor, ceiling, front (-Z), right (+X), back (+Z), left (-X).

        `repeat` is for the four walls; floor and ceiling show their pictures once.
        """
        (x, y, z), (a, b, c) = low, high
        w, h, d = a - x, b - y, c - z
        self.quad((x, y, c), (w, 0, 0), (0, 0, -d), colors[0], "floor")
        self.quad((x, b, z), (w, 0, 0), (0, 0, d), colors[1], "ceiling")
        for number, (corner, right, name) in enumerate(
            (
                ((x, y, z), (w, 0, 0), "wall in front"),
                ((a, y, z), (0, 0, d), "right wall"),
                ((a, y, c), (-w, 0, 0), "wall behind"),
                ((x, y, c), (0, 0, -d), "left wall"),
            )
        ):
            self.quad(corner, right, (0, h, 0), colors[2 + number], name, repeat=repeat)

    def finish(self, middle: Vector, eye: Vector, fov: float) -> cc.Scene:
        """Add the place of the reflector and the camera, and give the scene."""
        self.scene.add(position=middle, name=PLACE)
        self.scene.add(
            cc.PerspectiveCamera(fov=fov, position=eye, target=middle, near=0.05, far=400)
        )
        return self.scene


def shadowed(
    color: Array, low: Vector, high: Vector, spots: Sequence[tuple[float, float, float, float]]
) -> Array:
    """Darken a picture of a floor, which reaches from low to high (x, z), under things: (x, z, reach in x, in z)."""
    height, width = color.shape[:2]
    x = low[0] + (np.arange(width) + 0.5) / width * (high[0] - low[0])
    z = low[1] + (np.arange(height) + 0.5) / height * (high[1] - low[1])
    x, z = np.meshgrid(x, z)
    light = np.ones((height, width))
    for cx, cz, rx, rz in spots:
        away = np.maximum(np.abs(x - cx) / rx, np.abs(z - cz) / rz) * 0.5
        away = away + 0.5 * np.hypot((x - cx) / rx, (z - cz) / rz)
        light *= 1 - 0.5 * np.clip(1.6 - away, 0, 1) ** 1.5
    return np.asarray(color * light[..., None])


def in_corners(color: Array, depth: float = 0.25) -> Array:
    """Darken a picture of a wall near its edges."""
    height, width = color.shape[:2]
    u = np.minimum(np.arange(width) + 0.5, width - np.arange(width) - 0.5) / height
    v = np.minimum(np.arange(height) + 0.5, height - np.arange(height) - 0.5) / height
    light = (1 - depth * np.exp(-u / 0.12))[None, :] * (1 - depth * np.exp(-v / 0.12))[:, None]
    return np.asarray(color * light[..., None])


def model(name: str, size: float) -> cc.Mesh:
    """A mesh of the package's data that stands on y = 0, `size` metres high or wide, without its own uvs."""
    mesh = cc.load_mesh(cc.sample_data(name)).resized(size)
    positions = np.asarray(mesh.positions).copy()
    low, high = mesh.bounds
    positions -= ((low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2)
    return cc.Mesh(positions, mesh.indices, normals=mesh.normals)
