"""Lights and the environment as emitters of Mitsuba."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import AmbientLight, CubeMap, DirectionalLight, Light, PointLight, Scene, SpotLight
from ..._rotations import rotation_matrix
from ..left_out import LeftOut
from .files import Files

Array = npt.NDArray[Any]
Json = dict[str, Any]

#: Rows and columns of the picture of a spot light's fade.
_FADE_SIZE = 1024
#: How much narrower than its edge, in degrees, the full part of a sharp spot light is: 0 would divide by 0.
_EDGE = 1e-4


@dataclass
class Lamps:
    """Makes the emitters of lights.

    `factor` multiplies every light, and `center` is the point where a light of another decay than 2 keeps its strength.
    """

    files: Files
    left_out: LeftOut
    factor: float
    center: Array

    def emitter(self, light: Light, name: str) -> Json | None:
        """Return the emitter of a light; None for an ambient light, which is part of the environment."""
        if isinstance(light, AmbientLight):
            return None
        if isinstance(light, (PointLight, SpotLight, DirectionalLight)) and light.shadow is None:
            self.left_out.add(
                "every light of Mitsuba casts shadows; lights without shadow do, too", name
            )
        if isinstance(light, DirectionalLight):
            return {
                "type": "directional",
                "direction": [float(x) for x in light.world_direction],
                "irradiance": self._strength(light, 1.0),
            }
        if isinstance(light, SpotLight):
            return self._spot(light, name)
        if isinstance(light, PointLight):
            return {
                "type": "point",
                "position": [float(x) for x in light.world_position],
                "intensity": self._strength(light, self._at_center(light, name)),
            }
        self.left_out.add(f"lights of the kind {type(light).__name__} are left out", name)
        return None

    def _strength(self, light: Light, share: float) -> Json:
        color = np.asarray(light.color, float)[:3] * light.intensity * share * self.factor
        return {"type": "rgb", "value": color.tolist()}

    def _at_center(self, light: PointLight | SpotLight, name: str) -> float:
        """Return the factor that makes a light with Mitsuba's decay of 2 as strong as it is at the scene's centre."""
        if not math.isinf(light.range):
            self.left_out.add("lights of Mitsuba have no range, which is left out", name)
        if light.decay == 2:
            return 1.0
        self.left_out.add(
            "lights of Mitsuba have decay=2; a light of another decay is as strong only at the centre of the scene",
            name,
        )
        distance = float(np.linalg.norm(np.asarray(light.world_position) - self.center))
        return float(max(distance, 1e-6) ** (2 - light.decay))

    def _spot(self, light: SpotLight, name: str) -> Json:
        emitter: Json = {
            "type": "spot",
            "intensity": self._strength(light, self._at_center(light, name)),
            "cutoff_angle": float(light.angle),
            "beam_width": float(light.angle) * (1 - _EDGE),
            "to_world": _facing(
                np.asarray(light.world_position, float), np.asarray(light.world_direction, float)
            ),
        }
        if light.penumbra > 0:
            # Mitsuba's own fade is linear in the angle. A picture that the light throws has cubecam's.
            emitter["texture"] = {
                "type": "bitmap",
                "filename": self.files.picture(_fade(light.angle, light.penumbra)),
                "raw": False,
                "wrap_mode": "clamp",
                "format": "variant",
            }
        return emitter


def _fade(angle: float, penumbra: float) -> Array:
    """Return (N, N, 3): the share of a spot light's cone on a plane across its axis, up to the edge of the cone.

    The square of the share between the cosines, as KHR_lights_punctual recommends.
    """
    at = (np.arange(_FADE_SIZE) + 0.5) / _FADE_SIZE * 2 - 1
    tangent = np.hypot(*np.meshgrid(at, at)) * math.tan(math.radians(angle))
    cosine = 1 / np.sqrt(1 + tangent**2)
    edge, full = (math.cos(math.radians(angle * part)) for part in (1, 1 - penumbra))
    share = np.clip((cosine - edge) / (full - edge), 0, 1) ** 2
    return np.repeat(share[..., None], 3, axis=2)


def _facing(position: Array, direction: Array) -> Array:
    """Return the matrix (4, 4) of a light at a position that shines along its own +Z."""
    z = direction / np.linalg.norm(direction)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    matrix[:3, 3] = position
    return matrix


def sky(cube: CubeMap, rotation: Array, intensity: float, added: Array, files: Files) -> Json:
    """Return the emitter of a cubemap.

    Parameters
    ----------
    cube : CubeMap
        The light from all around; its numbers count as they are, and those that are not finite as 0.
    rotation : ndarray (4,)
        Unit quaternion (w, x, y, z) that turns the cube.
    intensity : float
        A factor.
    added : ndarray (3,)
        Radiance that is the same in all directions.

    Notes
    -----
    ``envmap`` has +Y up and +Z in the middle. Its columns lie at the middles of texels and its rows on the borders: the
    first and the last row are the poles. Therefore the cube is looked up for the direction of each texel.
    """
    width = max(4 * cube.size, min(8 * cube.size, 2048))
    height = width // 2
    phi = (np.arange(width) + 0.5) / width * 2 * np.pi
    theta = np.arange(height)[:, None] / (height - 1) * np.pi
    directions = np.stack(
        np.broadcast_arrays(
            np.sin(phi) * np.sin(theta), np.cos(theta), -np.cos(phi) * np.sin(theta)
        ),
        axis=-1,
    )
    # A row vector times the matrix is the inverse rotation: from the world to the cube.
    light = cube.sample((directions @ rotation_matrix(rotation)).reshape(-1, 3))
    light = np.asarray(light, np.float32).reshape(height, width, -1)
    light = light[..., :3] if light.shape[2] >= 3 else np.repeat(light[..., :1], 3, axis=2)
    light = np.where(np.isfinite(light), light, 0)
    if added.any():
        light, intensity = light * np.float32(intensity) + added.astype(np.float32), 1.0
    if not light.any() or intensity == 0:
        return darkness()  # Mitsuba chooses directions by their light
    return {"type": "envmap", "filename": files.picture(light), "scale": float(intensity)}


def even(radiance: Array) -> Json:
    """Return the emitter of light that is the same from all around."""
    return {"type": "constant", "radiance": {"type": "rgb", "value": radiance.tolist()}}


def darkness() -> Json:
    """Return the emitter of no light, at which no path is aimed."""
    return {**even(np.zeros(3)), "sampling_weight": 0.0}


def ambient_of(scene: Scene) -> Array:
    """Return the sum (3,) of the ambient lights of a scene."""
    lights = [light for light in scene.lights if isinstance(light, AmbientLight)]
    return sum((np.asarray(x.color, float)[:3] * x.intensity for x in lights), np.zeros(3))
