"""Reflection, refraction and reflectance in numpy: the same numbers as in the shaders.

Every incident direction points TOWARDS the surface, as in GLSL. Every normal points to the side that the light comes
from, so that the dot product of both is not above 0.
"""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._checks import check_room
from ._core import _brdf, _to_array

__all__ = ["brdf", "fresnel", "reflect", "refract", "schlick"]

Floats: TypeAlias = npt.NDArray[np.float32 | np.float64]


@checked_call
def reflect(incident: npt.ArrayLike, normal: npt.ArrayLike) -> Floats:
    """Mirror directions at a surface: GLSL's `reflect`.

    Parameters
    ----------
    incident : array_like (..., 3)
        Directions that point TOWARDS the surface, such as a surface point minus the eye. Any length.
    normal : array_like (..., 3)
        Normals of length 1, on either side of the surface.

    Returns
    -------
    ndarray (..., 3)
        ``incident - 2 dot(normal, incident) normal``: directions that point away from the surface, of the length of
        `incident`. float32 if the arrays are float32, else float64. Leading axes are broadcast.

    Raises
    ------
    ValueError
        For shapes that do not end in 3, or that cannot be broadcast.
    TypeError
        For values that are not real numbers.

    Notes
    -----
    The formula is that of The OpenGL Shading Language, version 4.60, section 8.5. A normal of 0, which the output
    "normal" has where nothing was drawn, leaves the direction as it is.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.reflect((1, -1, 0), (0, 1, 0)).tolist()
    [1.0, 1.0, 0.0]
    """
    towards, up = _directions(incident, normal)
    return np.asarray(towards - 2 * _dot(up, towards)[..., None] * up)


@checked_call
def refract(incident: npt.ArrayLike, normal: npt.ArrayLike, eta: npt.ArrayLike) -> Floats:
    """Bend directions at the surface of glass or water: GLSL's `refract`.

    Parameters
    ----------
    incident : array_like (..., 3)
        Directions of length 1 that point TOWARDS the surface.
    normal : array_like (..., 3)
        Normals of length 1, on the side that the light comes from.
    eta : array_like (...)
        ``n_outside / n_inside``: the refractive index on the side that the light comes from over the index on the
        side that it goes to, above 0. ``1 / 1.52`` from air into glass, ``1.52`` from glass into air.

    Returns
    -------
    ndarray (..., 3)
        Directions of length 1 that point into the surface, and 0 where all light is reflected. float32 if the arrays
        of directions are float32, else float64. Leading axes are broadcast, with those of `eta`.

    Raises
    ------
    ValueError
        For shapes that do not end in 3, or that cannot be broadcast, or an eta that is not a finite number above 0.
    TypeError
        For values that are not real numbers.

    Notes
    -----
    ``k = 1 - eta^2 (1 - dot(normal, incident)^2)``; 0 where ``k < 0``, else
    ``eta incident - (eta dot(normal, incident) + sqrt(k)) normal``: The OpenGL Shading Language, version 4.60, section
    8.5. It follows from Snell's law, ``n_outside sin_i = n_inside sin_t``.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.refract((0.6, -0.8, 0), (0, 1, 0), 1 / 1.5).round(3).tolist()
    [0.4, -0.917, 0.0]
    >>> cc.refract((0.8, -0.6, 0), (0, 1, 0), 1.5).tolist()  # from within: all light is reflected
    [0.0, 0.0, 0.0]
    """
    towards, up = _directions(incident, normal)
    ratio = _numbers(eta, "eta", towards.dtype)
    _check((ratio > 0) & np.isfinite(ratio), ratio, "eta: expected finite numbers above 0")
    cosine, ratio = _broadcast(_dot(up, towards), ratio, "eta")
    k = 1 - ratio * ratio * (1 - cosine * cosine)
    along = ratio * cosine + np.sqrt(np.maximum(k, 0))
    bent = ratio[..., None] * towards - along[..., None] * up
    return np.asarray(np.where(k[..., None] < 0, np.zeros((), bent.dtype), bent))


@checked_call
def fresnel(incident: npt.ArrayLike, normal: npt.ArrayLike, eta: npt.ArrayLike) -> Floats:
    """Compute the share of light that a smooth surface of glass or water reflects, as `GlassMaterial` does.

    Parameters
    ----------
    incident : array_like (..., 3)
        Directions of length 1 that point TOWARDS the surface.
    normal : array_like (..., 3)
        Normals of length 1, on the side that the light comes from. A surface seen from behind counts as seen at a
        grazing angle.
    eta : array_like (...)
        ``n_outside / n_inside``, above 0, as in `refract`; `GlassMaterial` has ``1 / ior``.

    Returns
    -------
    ndarray (...)
        The share, from 0 to 1, of unpolarised light; 1 where `refract` gives 0. The surface lets the rest through.
        float32 if the arrays of directions are float32, else float64.

    Raises
    ------
    ValueError, TypeError
        As `refract`.

    See Also
    --------
    schlick : the approximation that `MirrorMaterial` and users' shaders have.

    Notes
    -----
    The mean of both polarisations, ``r_s = (eta cos_i - cos_t) / (eta cos_i + cos_t)`` and
    ``r_p = (cos_i - eta cos_t) / (cos_i + eta cos_t)``, squared: M. Born and E. Wolf, "Principles of Optics", section
    1.5.2, for materials that absorb nothing.

    Examples
    --------
    >>> import cubecam as cc
    >>> round(float(cc.fresnel((0, -1, 0), (0, 1, 0), 1 / 1.5)), 4)
    0.04
    >>> float(cc.fresnel((0.8, -0.6, 0), (0, 1, 0), 1.5))  # from within: all light is reflected
    1.0
    """
    towards, up = _directions(incident, normal)
    ratio = _numbers(eta, "eta", towards.dtype)
    _check((ratio > 0) & np.isfinite(ratio), ratio, "eta: expected finite numbers above 0")
    cos_i, ratio = _broadcast(_dot(up, towards), ratio, "eta")
    cos_i = np.clip(-cos_i, 0, 1)
    k = 1 - ratio * ratio * (1 - cos_i * cos_i)
    cos_t = np.sqrt(np.maximum(k, 0))
    # Both denominators are 0 only at a grazing angle where eta is 1: there is no surface, and it reflects nothing.
    none = (cos_i == 0) & (cos_t == 0)
    r_s = (ratio * cos_i - cos_t) / np.where(none, 1, ratio * cos_i + cos_t)
    r_p = (cos_i - ratio * cos_t) / np.where(none, 1, cos_i + ratio * cos_t)
    share = (r_s * r_s + r_p * r_p) / 2
    return np.asarray(np.where(k < 0, np.ones((), share.dtype), share))


@checked_call
def schlick(incident: npt.ArrayLike, normal: npt.ArrayLike, f0: npt.ArrayLike) -> Floats:
    """Approximate the share of light that a surface reflects, as `MirrorMaterial` and `schlick` in a shader do.

    Parameters
    ----------
    incident : array_like (..., 3)
        Directions of length 1 that point TOWARDS the surface.
    normal : array_like (..., 3)
        Normals of length 1, on the side that the light comes from. A surface seen from behind counts as seen at a
        grazing angle.
    f0 : array_like (...)
        The share at normal incidence, from 0 to 1: some 0.04 for glass, 0.5 to 1 for metals.

    Returns
    -------
    ndarray (...)
        ``f0 + (1 - f0) (1 - cos_i)^5``, from f0 to 1. float32 if the arrays of directions are float32, else float64.

    Raises
    ------
    ValueError
        For shapes that do not end in 3, or that cannot be broadcast, or an f0 outside 0 to 1.
    TypeError
        For values that are not real numbers.

    See Also
    --------
    fresnel : the exact share for glass.

    Notes
    -----
    C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994, equation 15.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.schlick([(0, -1, 0), (1, 0, 0)], (0, 1, 0), 0.04).tolist()
    [0.04, 1.0]
    """
    towards, up = _directions(incident, normal)
    share = _numbers(f0, "f0", towards.dtype)
    _check((share >= 0) & (share <= 1), share, "f0: expected numbers from 0 to 1")
    cosine, share = _broadcast(_dot(up, towards), share, "f0")
    rest = 1 - np.clip(-cosine, 0, 1)
    return np.asarray(share + (1 - share) * rest**5)


@checked_call
def brdf(n_dot_v: npt.ArrayLike, roughness: npt.ArrayLike) -> npt.NDArray[np.float32]:
    """Look up what rough metal reflects of uniform light: GLSL's `brdf` of cubecam's shaders.

    Parameters
    ----------
    n_dot_v : array_like (...)
        Cosines between the normal and the direction to the eye; clamped to 0 to 1.
    roughness : array_like (...)
        The roughness of glTF, whose square is GGX's alpha; clamped to 0 to 1.

    Returns
    -------
    ndarray (..., 2) float32
        (scale, bias): a surface with the reflectance f0 at normal incidence reflects the share
        ``f0 * scale + bias`` of light that comes evenly from all sides. Axes are broadcast.

    Raises
    ------
    ValueError
        For shapes that cannot be broadcast, or numbers that are not finite.
    TypeError
        For values that are not real numbers.

    See Also
    --------
    CubeMap.prefilter : the other factor of the split sum.

    Notes
    -----
    The integral of the specular term of glTF 2.0, appendix B: GGX, separable Smith, Schlick's Fresnel (B. Karis,
    "Real Shading in Unreal Engine 4", 2013). It is looked up bilinearly in a table of 64 x 64 integrals, which is made
    at the first use, some 30 ms; the shaders have the same table.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.brdf(1, 0).tolist()  # a mirror, seen from the front: f0
    [1.0, 0.0]
    >>> cc.brdf([1, 0.5], 1).round(2)
    array([[0.31, 0.  ],
           [0.41, 0.  ]], dtype=float32)
    """
    cosine = _numbers(n_dot_v, "n_dot_v", np.dtype(np.float32))
    rough = _numbers(roughness, "roughness", np.dtype(np.float32))
    _check(np.isfinite(cosine), cosine, "n_dot_v: expected finite numbers")
    _check(np.isfinite(rough), rough, "roughness: expected finite numbers")
    cosine, rough = _broadcast(cosine, rough, "roughness")
    return np.asarray(_brdf(cosine, rough))


def _directions(incident: npt.ArrayLike, normal: npt.ArrayLike) -> tuple[Any, Any]:
    """Check both, and convert them to one type: float32 if what has a type of its own has this one."""
    given = [value.dtype for value in (incident, normal) if isinstance(value, np.ndarray)]
    kind = np.float32 if given and all(dtype == np.float32 for dtype in given) else np.float64
    towards = _numbers(incident, "incident", kind)
    up = _numbers(normal, "normal", kind)
    for array, name in ((towards, "incident"), (up, "normal")):
        if array.ndim == 0 or array.shape[-1] != 3:
            raise ValueError(f"{name}: expected shape (..., 3), got {array.shape}")
    return _broadcast(towards, up, "normal")


def _numbers(value: npt.ArrayLike, name: str, kind: npt.DTypeLike) -> Any:
    array = _to_array(value, name)
    if array.dtype.kind not in "iuf":
        got = f"dtype {array.dtype}" if array.dtype.kind in "bc" else type(value).__name__
        raise TypeError(f"{name}: expected real numbers, got {got}")
    # An array of strides 0 is larger than its memory; formulas keep a few numbers for each of it.
    check_room(32.0 * array.size, f"numbers of shape {array.shape}", name)
    return array.astype(kind, copy=False)


def _broadcast(one: Any, other: Any, name: str) -> tuple[Any, Any]:
    try:
        first, second = np.broadcast_arrays(one, other)
    except ValueError as error:
        raise ValueError(
            f"{name}: expected a shape that can be broadcast with {one.shape}, got {other.shape}"
        ) from error
    check_room(32.0 * first.size, f"numbers of shape {first.shape}", name)
    return first, second


def _check(sound: Any, values: Any, expected: str) -> None:
    if not np.all(sound):
        raise ValueError(f"{expected}, got {float(np.asarray(values)[~np.asarray(sound)].flat[0])}")


def _dot(a: Any, b: Any) -> Any:
    return np.einsum("...i,...i->...", a, b)
