"""What a browser may send: JSON of the events of rendercanvas, checked field by field."""

from __future__ import annotations

import json
import math
from typing import Any

__all__ = ["LARGEST_SIDE", "read_message", "to_event", "to_size"]

LARGEST_SIDE = 4096  # pixels; what a browser wants beyond that is stretched from a smaller picture

_POINTER = {"x": float, "y": float, "button": int, "buttons": list, "modifiers": list}
#: The events that a view gets, and the kind of each field.
_FIELDS: dict[str, dict[str, type]] = {
    "pointer_down": _POINTER,
    "pointer_up": _POINTER,
    "pointer_move": _POINTER,
    "pointer_enter": _POINTER,
    "pointer_leave": _POINTER,
    "double_click": _POINTER,
    "wheel": {"x": float, "y": float, "dx": float, "dy": float, "buttons": list, "modifiers": list},
    "key_down": {"key": str, "modifiers": list},
    "key_up": {"key": str, "modifiers": list},
}


def read_message(text: str) -> dict[str, Any] | None:
    """Return the JSON object of a message with a `type`; None for anything else."""
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        return None
    if isinstance(message, dict) and isinstance(message.get("type"), str):
        return message
    return None


def to_event(message: dict[str, Any]) -> dict[str, Any] | None:
    """Turn a message of the page into an event of rendercanvas; None if it is none."""
    fields = _FIELDS.get(message["type"])
    if fields is None:
        return None
    event: dict[str, Any] = {"event_type": message["type"]}
    for name, kind in fields.items():
        value = _checked(message.get(name), kind)
        if value is None:
            return None
        event[name] = value
    if "x" in event and "dx" not in event:
        event["touches"] = touches = _touches(message.get("touches"))
        event["ntouches"] = len(touches)
    return event


def to_size(message: dict[str, Any]) -> tuple[int, int, float] | None:
    """Return (width, height, pixel ratio) of a "resize", in pixels of the screen; None for wrong numbers."""
    width, height, ratio = (
        _checked(message.get(name), float) for name in ("pwidth", "pheight", "ratio")
    )
    if width is None or height is None or ratio is None or min(width, height) < 1:
        return None
    if not 0.1 <= ratio <= 10:
        return None
    scale = min(1.0, LARGEST_SIDE / max(width, height))
    return max(1, round(width * scale)), max(1, round(height * scale)), ratio * scale


def _checked(value: Any, kind: type) -> Any:
    """Return the value as that kind; None if it is of another one."""
    if kind in (int, float):
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return kind(value) if math.isfinite(value) and abs(value) < 1e9 else None
        return None
    if kind is list:
        fits = isinstance(value, list) and len(value) <= 16
        if fits and all(isinstance(item, (int, str)) for item in value):
            return tuple(value)
        return None
    return value if isinstance(value, str) and len(value) <= 32 else None


def _touches(sent: Any) -> dict[str, dict[str, float]]:
    """Return the fingers on the picture: {id: {"x", "y", "pressure"}}."""
    touches: dict[str, dict[str, float]] = {}
    for key, value in list(sent.items())[:10] if isinstance(sent, dict) else ():
        if isinstance(value, dict) and len(key) < 20:
            x, y = _checked(value.get("x"), float), _checked(value.get("y"), float)
            if x is not None and y is not None:
                touches[key] = {"x": x, "y": y, "pressure": 1.0}
    return touches
