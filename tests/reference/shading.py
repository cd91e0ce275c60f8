"""Reflection, refraction, Fresnel, the Phong model of document 000, tone curves and the sRGB curve.

Incident directions point TOWARDS the surface; normals point to the side the light came from.
"""

from dataclasses import dataclass

import numpy as np

from .transforms import normalised


def dot(a, b):
    return (np.asarray(a) * np.asarray(b)).sum(-1, keepdims=True)


def reflect(incident, normal):
    """GLSL reflect: I - 2 (N.I) N."""
    return incident - 2 * dot(normal, incident) * normal


def refract(incident, normal, eta):
    """GLSL refract (4.50 section 8.5) of unit vectors; eta = n_outside / n_inside; 0 where all light is reflected."""
    cos_i = dot(normal, incident)
    k = 1 - eta**2 * (1 - cos_i**2)
    bent = eta * incident - (eta * cos_i + np.sqrt(np.maximum(k, 0))) * normal
    return np.where(k < 0, 0.0, bent)


def schlick(f0, cos_theta):
    """Fresnel by Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994."""
    return f0 + (1 - f0) * (1 - np.clip(cos_theta, 0, 1)) ** 5


def fresnel_dielectric(cos_i, eta):
    """Unpolarised reflectance by Fresnel's equations; eta = n_outside / n_inside; 1 beyond the critical angle."""
    cos_i = np.clip(cos_i, 0, 1)
    sin_t2 = eta**2 * (1 - cos_i**2)
    cos_t = np.sqrt(np.maximum(1 - sin_t2, 0))
    parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    return np.where(sin_t2 >= 1, 1.0, (parallel**2 + perpendicular**2) / 2)


@dataclass
class Point:
    position: tuple
    color: tuple = (1, 1, 1)
    intensity: float = 1.0
    decay: float = 0.0
    range: float = np.inf


@dataclass
class Directional:
    """A directional light; `travels` is the direction in which its light goes, from the lamp to the scene."""

    travels: tuple
    color: tuple = (1, 1, 1)
    intensity: float = 1.0


@dataclass
class Spot:
    """A spot light of KHR_lights_punctual.

    `angle` is half the cone's opening in degrees; `penumbra` is the share of it over which the light fades.
    """

    position: tuple
    travels: tuple = (0, -1, 0)
    angle: float = 30.0
    penumbra: float = 0.0
    color: tuple = (1, 1, 1)
    intensity: float = 1.0
    decay: float = 0.0
    range: float = np.inf

    def share(self, to_light):
        """The share of light along unit vectors to the lamp: the square of what lies between the cosines of the edge
        and of the inner cone."""
        cosine = dot(-to_light, normalised(self.travels))
        edge = np.cos(np.radians(self.angle))
        full = np.cos(np.radians(self.angle * (1 - self.penumbra)))
        if full == edge:
            return np.where(cosine > edge, 1.0, 0.0)
        t = np.clip((cosine - edge) / (full - edge), 0, 1)
        return t * t


@dataclass
class Ambient:
    color: tuple = (1, 1, 1)
    intensity: float = 1.0


def falloff(light, distance):
    """The share of light at a distance: distance^-decay, and the window of KHR_lights_punctual's range."""
    window = np.clip(1 - (distance / light.range) ** 4, 0, 1)
    return window / distance**light.decay


def way_to(light, position):
    """Unit vectors from points to a light, and the distances, which are infinite for a light that is far away."""
    if isinstance(light, Directional):
        return np.broadcast_to(-normalised(light.travels), position.shape), np.full(
            (*position.shape[:-1], 1), np.inf
        )
    offset = np.asarray(light.position, float) - position
    distance = np.linalg.norm(offset, axis=-1, keepdims=True)
    return offset / distance, distance


def phong(
    position, normal, eye, color, lights, ka=0.2, kd=0.7, ks=1.0, shininess=10.0, visibility=None
):
    """The sum of ka color and, for each light, kd color max(N.L, 0) light + ks max(R.V, 0)^shininess light.

    The last term is left out where N.L <= 0.
    visibility: for each light the share (...) of it that arrives, or None if all light arrives.
    """
    color = np.asarray(color, float)
    view = normalised(np.asarray(eye, float) - position)
    total = np.broadcast_to(ka * color, position.shape).copy()
    for index, light in enumerate(lights):
        radiance = np.asarray(light.color, float) * light.intensity
        if isinstance(light, Ambient):
            total = total + ka * color * radiance
            continue
        to_light, distance = way_to(light, position)
        if isinstance(light, (Point, Spot)):
            radiance = radiance * falloff(light, distance)
        if isinstance(light, Spot):
            radiance = radiance * light.share(to_light)
        if visibility is not None and visibility[index] is not None:
            radiance = radiance * visibility[index][..., None]
        n_dot_l = dot(normal, to_light)
        diffuse = kd * color * np.maximum(n_dot_l, 0)
        r_dot_v = np.clip(dot(reflect(-to_light, normal), view), 0, 1)
        specular = np.where(n_dot_l > 0, ks * r_dot_v**shininess, 0.0)
        total = total + (diffuse + specular) * radiance
    return total


def reinhard(c):
    """Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, equation 3, per channel."""
    return c / (1 + c)


def aces(c):
    """Narkowicz, "ACES Filmic Tone Mapping Curve", 2015."""
    return np.clip(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0, 1)


def neutral(color):
    """Khronos PBR Neutral Tone Mapper (2024), by the steps of its specification."""
    color = np.asarray(color, float)
    start, desaturation = 0.8 - 0.04, 0.15
    low = color.min(-1, keepdims=True)
    offset = np.where(low < 0.08, low - 6.25 * low * low, 0.04)
    color = color - offset
    peak = color.max(-1, keepdims=True)
    d = 1 - start
    new_peak = 1 - d * d / (peak + d - start)
    squeezed = color * new_peak / np.where(peak == 0, 1, peak)
    g = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    return np.where(peak < start, color, squeezed * (1 - g) + new_peak * g)


TONE_CURVES = {"reinhard": reinhard, "aces": aces, "neutral": neutral}


def srgb_encode(c):
    """IEC 61966-2-1, linear to stored."""
    c = np.clip(c, 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def srgb_decode(c):
    """IEC 61966-2-1, stored to linear."""
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
