"""What can be set of a live view, as data: controls in sections, for widgets, a page, or a test.

A control knows how to read and to set one value; it draws nothing. `widgets` draws controls in notebooks, `page` in a
browser. `properties.properties` makes the controls of an object from the object's own properties.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from .._calls import checked_call
from .._checks import text_of
from .control import KINDS, Control, Section
from .properties import properties

__all__ = ["Control", "Memory", "Section", "panel_to_json", "properties", "set_control"]


@checked_call
def panel_to_json(sections: Iterable[Section]) -> list[dict[str, Any]]:
    """Describe a panel and its present values in numbers, words and lists that JSON knows.

    Parameters
    ----------
    sections : iterable of Section

    Returns
    -------
    list of dict
        For each section "title", "open" and "controls"; each control has "value" and the attributes of `Control` except
        `get`, `set` and `keep`.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.panel import Section, panel_to_json, properties
    >>> glass = Section("glass", properties(cc.GlassMaterial(ior=1.5)))
    >>> first = panel_to_json([glass])[0]["controls"][0]
    >>> first["name"], first["kind"], first["value"]
    ('ior', 'number', 1.5)
    """
    return [
        {
            "title": section.title,
            "open": section.open,
            "controls": [_control_to_json(control) for control in section.controls],
        }
        for section in sections
    ]


def _control_to_json(control: Control) -> dict[str, Any]:
    return {
        "name": control.name,
        "kind": control.kind,
        "value": control.get(),
        "low": control.low,
        "high": control.high,
        "step": control.step,
        "logarithmic": control.logarithmic,
        "choices": list(control.choices),
        "unit": control.unit,
        "help": control.help,
    }


@checked_call
def set_control(sections: Sequence[Section], section: int, index: int, value: object) -> None:
    """Set the value of one control of a panel; widgets and the page change values only here.

    Parameters
    ----------
    sections : sequence of Section
    section, index : int
        Which section, and which of its controls; both count from 0.
    value : object
        As `Control.get` gives it. A colour may be a CSS name or numbers, too, where the property takes them.

    Raises
    ------
    IndexError
        If there is no such control.
    TypeError, ValueError
        If the value does not fit the control's kind, or as the property raises them. Nothing has changed then.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.panel import Section, properties, set_control
    >>> ball = cc.MirrorMaterial()
    >>> panel = [Section("ball", properties(ball))]
    >>> names = [control.name for control in panel[0].controls]
    >>> set_control(panel, 0, names.index("env_weight"), 0.25)
    >>> ball.env_weight
    0.25
    """
    if not 0 <= section < len(sections):
        raise IndexError(f"expected a section from 0 to {len(sections) - 1}, got {section}")
    controls = sections[section].controls
    if not 0 <= index < len(controls):
        raise IndexError(f"expected a control from 0 to {len(controls) - 1}, got {index}")
    control = controls[index]
    control.set(_checked(control, value))


def _checked(control: Control, value: Any) -> Any:
    """Give the value if it fits the control's kind; a page may send anything."""
    kind = control.kind
    if kind == "number":
        fits = _is_number(value)
    elif kind == "integer":
        fits = _is_number(value) and value == int(value)
        value = int(value) if fits else value
    elif kind == "flag":
        fits = isinstance(value, bool)
    elif kind == "choice":
        if value not in control.choices and value != control.get():
            words = ", ".join(f'"{word}"' for word in control.choices)
            raise ValueError(f"{control.name}: expected {words}, got {text_of(value)}")
        fits = True
    elif kind == "color":
        fits = isinstance(value, str) or _is_numbers(value)
    elif kind == "vector":
        count = len(control.get())
        if _is_numbers(value) and len(value) != count:
            raise ValueError(f"{control.name}: expected {count} numbers, got {len(value)}")
        fits = _is_numbers(value)
    elif kind == "text":
        fits = isinstance(value, str)
    else:
        fits, value = True, None
    if not fits:
        raise TypeError(f"{control.name}: expected {KINDS[kind]}, got {text_of(value)}")
    return value


def _is_number(value: object) -> bool:
    numeric = isinstance(value, (int, float)) and not isinstance(value, bool)
    return numeric and math.isfinite(value)  # type: ignore[arg-type]


def _is_numbers(value: object) -> bool:
    return isinstance(value, (list, tuple)) and all(_is_number(one) for one in value)


class Memory:
    """The controls of objects, and the values that these objects had when a panel first showed them.

    A panel is read often, so that controls are made once for each object. Their ranges follow from the first values and
    stay, so that a slider does not change while someone drags it.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.panel import Memory, properties
    >>> memory, light = Memory(), cc.AmbientLight(intensity=0.5)
    >>> controls = memory.controls(light, lambda: properties(light))
    >>> light.intensity = 3
    >>> memory.reset()
    >>> light.intensity
    0.5
    """

    def __init__(self) -> None:
        self._known: dict[object, _Known] = {}
        self._seen: set[object] = set()

    def controls(
        self, owner: object, make: Callable[[], tuple[Control, ...]], *, shape: object = None
    ) -> tuple[Control, ...]:
        """Give the controls that `make` made for an object at first.

        Controls are made again when `shape` differs from the last one: it says which controls there are.
        """
        key = owner if isinstance(owner, str) else id(owner)
        self._seen.add(key)
        known = self._known.get(key)
        if known is None or known.shape != shape:
            controls = make()
            back = {} if known is None else known.back
            for control in controls:
                if control.keep is not None and control.name not in back:
                    back[control.name] = control.keep()
            # The owner is held, so that no other object gets its id.
            self._known[key] = known = _Known(owner, shape, controls, back)
        return known.controls

    def forget_unseen(self) -> None:
        """Let go of objects whose controls nobody wanted since the last call."""
        self._known = {key: known for key, known in self._known.items() if key in self._seen}
        self._seen = set()

    def reset(self) -> None:
        """Bring back the values of all objects.

        Some values allow each other only in one order, for example near and far: what fails is tried again after the
        rest. The first error that remains is raised.
        """
        waiting = [back for known in self._known.values() for back in known.back.values()]
        while waiting:
            failed: list[Callable[[], object]] = []
            errors: list[Exception] = []
            for back in waiting:
                try:
                    back()
                except (TypeError, ValueError) as error:
                    failed.append(back)
                    errors.append(error)
            if len(failed) == len(waiting):
                raise errors[0]
            waiting = failed


@dataclass(frozen=True)
class _Known:
    owner: object
    shape: object
    controls: tuple[Control, ...]
    back: dict[str, Callable[[], object]]
