"""Materials and views for the tests of the BSDF, and sums over all directions."""

from typing import Any

import numpy as np

from cubecam.truth.shading import normalised
from cubecam.truth.shading.standard.material import Parameters, Surface

UP = np.array([0.0, 0.0, 1.0])

#: Materials without mirrors. Few values of roughness, since tables are made for each.
ROUGH: dict[str, dict[str, Any]] = {
    "plastic": {"color": (0.8, 0.5, 0.2), "metallic": 0.0, "roughness": 0.4},
    "metal": {"color": (0.9, 0.6, 0.3), "roughness": 0.3},
    "half": {"color": (0.9, 0.6, 0.3), "metallic": 0.4, "roughness": 0.6, "ior": 1.9},
    "tinted": {"metallic": 0.0, "roughness": 0.4, "specular_color": (1, 0.4, 0.1), "ior": 2.2},
    "anisotropic": {"roughness": 0.4, "anisotropy": 0.7, "anisotropy_direction": (0.6, 0.8)},
    "sheen": {
        "color": (0.3, 0.1, 0.4),
        "metallic": 0.0,
        "roughness": 0.6,
        "sheen_color": (0.9, 0.5, 0.7),
        "sheen_roughness": 0.5,
    },
    "coat": {
        "color": (0.8, 0.1, 0.1),
        "metallic": 0.0,
        "roughness": 0.6,
        "clearcoat": 0.9,
        "clearcoat_roughness": 0.3,
    },
    "film": {
        "color": (0.5, 0.5, 0.5),
        "metallic": 0.5,
        "roughness": 0.4,
        "iridescence": 1.0,
        "iridescence_thickness": 320.0,
    },
    "glass": {"metallic": 0.0, "roughness": 0.4, "transmission": 0.7, "color": (0.7, 0.9, 1)},
    "black": {"color": (0, 0, 0), "metallic": 0.0, "roughness": 0.3},
}
ROUGH["all"] = {**ROUGH["half"], **ROUGH["sheen"], **ROUGH["coat"], **ROUGH["film"]}
ROUGH["all"] |= {"transmission": 0.3, "anisotropy": 0.5, "metallic": 0.3}


def random_unit(rng, count):
    return normalised(rng.normal(size=(count, 3)))


def view(cosine, turn=0.4):
    """The way to a viewer at an angle from +z."""
    sine = np.sqrt(1 - cosine**2)
    return np.array([sine * np.cos(turn), sine * np.sin(turn), cosine])


def surface_of(v, count, n=None, geometric_n=UP, coat_n=None):
    """The same surface at all of `count` points."""

    def rows(x):
        return np.broadcast_to(np.asarray(x, float), (count, 3)).copy()

    return Surface(
        rows((0, 0, 0)),
        rows(v),
        rows(geometric_n),
        None if n is None else rows(n),
        None if coat_n is None else rows(coat_n),
        tangent=np.broadcast_to((1.0, 0.0, 0.0, -1.0), (count, 4)),
    )


def parameters(name, **changes):
    return Parameters(**{**ROUGH[name], **changes})


def all_directions(steps=40, turns=640):
    """(l (N, 3), solid angles (N, 1)): Gauss and Legendre's points in z above and below 0, and even turns.

    There are many turns, since the density of a reflection below the surface, next to -v, is a narrow fan.
    """
    points, weights = np.polynomial.legendre.leggauss(steps)
    z = np.concatenate([(points - 1) / 2, (points + 1) / 2])
    weight = np.concatenate([weights, weights]) / 2
    phi = (np.arange(turns) + 0.5) / turns * 2 * np.pi
    z, phi = (x.ravel() for x in np.meshgrid(z, phi, indexing="ij"))
    flat = np.sqrt(1 - z**2)
    angle = np.repeat(weight, turns)[:, None] * 2 * np.pi / turns
    return np.stack([flat * np.cos(phi), flat * np.sin(phi), z], -1), angle
