"""The Phong model of document 000."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .lights import Ambient, Light, Point, Spot, falloff, way_to
from .vectors import Array, Numbers, dot, normalised, reflect


def phong(
    position: Array,
    normal: Array,
    eye: npt.ArrayLike,
    color: npt.ArrayLike,
    lights: Sequence[Light],
    ka: Numbers = 0.2,
    kd: Numbers = 0.7,
    ks: Numbers = 1.0,
    shininess: Numbers = 10.0,
    visibility: Sequence[Array | None] | None = None,
) -> Array:
    """The sum of ka color and, for each light, kd color max(N.L, 0) light + ks max(R.V, 0)^shininess light.

    The last term is left out where N.L <= 0.
    visibility: for each light the share (...) of it that arrives, or None if all light arrives.
    """
    color = np.asarray(color, float)
    view = normalised(np.asarray(eye, float) - position)
    total: Array = np.broadcast_to(ka * color, position.shape).copy()
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
        share = None if visibility is None else visibility[index]
        if share is not None:
            radiance = radiance * share[..., None]
        n_dot_l = dot(normal, to_light)
        diffuse = kd * color * np.maximum(n_dot_l, 0)
        r_dot_v = np.clip(dot(reflect(-to_light, normal), view), 0, 1)
        specular = np.where(n_dot_l > 0, ks * r_dot_v**shininess, 0.0)
        total = total + (diffuse + specular) * radiance
    return total
