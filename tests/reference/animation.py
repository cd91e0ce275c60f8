"""Values of animation channels at a time, written from glTF 2.0, appendix C "Animation Sampler Interpolation Modes"."""

import numpy as np


def _unit(q):
    return q / np.linalg.norm(q)


def slerp(v0, v1, t):
    """C.4: spherical linear interpolation of unit quaternions."""
    d = float(np.dot(v0, v1))
    a = np.arccos(min(abs(d), 1.0))
    s = np.sign(d) if d else 1.0
    if a < 1e-9:
        return _unit((1 - t) * v0 + s * t * v1)
    return (np.sin(a * (1 - t)) * v0 + s * np.sin(a * t) * v1) / np.sin(a)


def sample(path, interpolation, times, values, seconds):
    """The value at a time; quaternions may have any order of their numbers."""
    times, values = np.asarray(times, float), np.asarray(values, float)
    turns = path == "rotation"
    cubic = interpolation == "cubic"
    rows = values.reshape(len(times), 3, -1) if cubic else values
    keys = rows[:, 1] if cubic else rows
    if turns:
        keys = keys / np.linalg.norm(keys, axis=1, keepdims=True)
    if seconds <= times[0]:
        return keys[0]
    if seconds >= times[-1]:
        return keys[-1]
    k = np.searchsorted(times, seconds, side="right") - 1
    td = times[k + 1] - times[k]
    t = (seconds - times[k]) / td
    if interpolation == "step":
        return keys[k]
    if not cubic:
        return slerp(keys[k], keys[k + 1], t) if turns else (1 - t) * keys[k] + t * keys[k + 1]
    in_tangent, out_tangent = rows[k + 1, 0], rows[k, 2]
    v = (
        (2 * t**3 - 3 * t**2 + 1) * rows[k, 1]
        + td * (t**3 - 2 * t**2 + t) * out_tangent
        + (-2 * t**3 + 3 * t**2) * rows[k + 1, 1]
        + td * (t**3 - t**2) * in_tangent
    )
    return _unit(v) if turns else v
