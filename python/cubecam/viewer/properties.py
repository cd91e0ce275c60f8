"""The controls of any object of cubecam, read from its own properties.

The type that a property's signature and docstring state says which kind of control it gets; ranges and units come from
the docstring, too. A new kind of material has controls without a line here.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of
from .._core import Texture
from ..io.pixels import srgb_decode, srgb_encode
from .control import Control

__all__ = ["color_to_hex", "hex_to_color", "properties", "slider"]

_NUMBER = r"(-?\d+(?:\.\d+)?)"
_UNITS = ("degrees", "stops", "world units", "texels")
# A number counts from 1 to 1000 by powers rather than by steps if it is at least this large.
_LARGE = 10
_COLOR_DIGITS = re.compile(r"#[0-9a-f]{6}", re.IGNORECASE)


@checked_call
def properties(thing: object, *, leave_out: Collection[str] = ()) -> tuple[Control, ...]:
    """Make the controls of an object's properties.

    Properties that hold numbers, vectors, colours, flags, names or text have controls, and so have uniforms, which are
    numbers by name. A map that is there can be switched off, and a `Texture` has its place on the surface. Meshes,
    cubemaps, cameras, matrices and shader sources have no controls: a panel has no place to edit them.

    Parameters
    ----------
    thing : object
        An object of cubecam: a material, a light, a probe, a node, a camera, an effect, ...
    leave_out : collection of str, default ()
        Names of properties without a control.

    Returns
    -------
    tuple of Control
        The properties of the object's own class come first, those of its base classes follow. A property that may be
        None, for example ``MirrorMaterial.f0``, has a flag "f0 is None" and a control for the number; one that may be
        infinite has a flag such as "attenuation_distance is inf". A colour of four
        numbers has a colour picker and a number "color alpha".

    Raises
    ------
    TypeError
        If the object has no property that can be set.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam.viewer.panel import properties
    >>> light = cc.SpotLight((0, 2, 0), (0, -1, 0), angle=25)
    >>> controls = {control.name: control for control in properties(light)}
    >>> list(controls)
    ['position', 'direction', 'angle', 'penumbra', 'decay', 'shadow', 'color', 'intensity']
    >>> controls["angle"].kind, controls["angle"].unit, controls["angle"].get()
    ('number', 'degrees', 25.0)
    >>> controls["color"].set("#ff8000")
    >>> light.color.round(3).tolist()
    [1.0, 0.216..., 0.0]
    """
    found = [p for p in _settable(thing) if p.name not in leave_out]
    if not found and not leave_out:
        kind = type(thing).__name__
        raise TypeError(f"expected an object with properties that can be set, got {kind}")
    return tuple(control for one in found for control in _controls(one))


@checked_call
def color_to_hex(color: npt.ArrayLike) -> str:
    """Write linear RGB as the "#rrggbb" of a colour picker: clipped to 0..1, encoded as sRGB, rounded to 8 bits.

    Parameters
    ----------
    color : array_like (3,) or (4,)
        Linear RGB; a fourth number, the alpha, is left out.

    Examples
    --------
    >>> from cubecam.viewer.properties import color_to_hex
    >>> color_to_hex([1, 0.2158605, 0])
    '#ff8000'
    """
    linear = np.clip(np.asarray(color, np.float32)[:3], 0, 1)
    return "#" + "".join(f"{round(255 * float(c)):02x}" for c in srgb_encode(linear))


@checked_call
def hex_to_color(text: str) -> npt.NDArray[np.float32]:
    """Read "#rrggbb" as linear RGB: the numbers of a colour picker are sRGB, those of cubecam are linear.

    Returns
    -------
    ndarray (3,) float32

    Raises
    ------
    ValueError
        If the text is not "#" and six hexadecimal digits.

    Examples
    --------
    >>> from cubecam.viewer.properties import hex_to_color
    >>> hex_to_color("#ff8000").tolist()
    [1.0, 0.215..., 0.0]
    """
    if not isinstance(text, str) or not _COLOR_DIGITS.fullmatch(text):
        raise ValueError(f'expected a colour as "#rrggbb", got {text_of(text)}')
    values = [int(text[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return srgb_decode(np.array(values, np.float32))


@dataclass(frozen=True)
class _Property:
    """A property of one object, in words that its class states."""

    thing: Any
    name: str
    gives: tuple[str, ...]  # the types of its value
    takes: tuple[str, ...]  # the types that can be set
    doc: str

    def get(self) -> Any:
        return getattr(self.thing, self.name)

    def set(self, value: object) -> None:
        setattr(self.thing, self.name, value)

    def keep(self) -> Callable[[], object]:
        value = self.get()
        if isinstance(value, Mapping):
            value = dict(value)
        return lambda: None if _same(self.get(), value) else self.set(value)

    @property
    def optional(self) -> bool:
        return "None" in self.gives

    @property
    def kinds(self) -> tuple[str, ...]:
        """The types of the value besides None."""
        return tuple(word for word in self.gives if word != "None")

    @property
    def off(self) -> float | None:
        """The value that is switched on and off by a flag: None, or infinity where the docstring names it."""
        return np.inf if not self.optional and re.search(r"\binf:", self.doc) else None

    def control(self, kind: str, **fields: Any) -> Control:
        more = {"name": self.name, "get": self.get, "set": self.set, "keep": self.keep}
        return Control(kind=kind, **{**more, "help": self.doc, **fields})


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, Mapping):
        return isinstance(b, Mapping) and a.keys() == b.keys() and all(_same(a[k], b[k]) for k in a)
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.shape(a) == np.shape(b) and bool(np.array_equal(a, b))
    return a is b or bool(a == b)


def _settable(thing: object) -> Iterator[_Property]:
    """Yield the properties that can be set: those of the object's own class first."""
    seen: set[str] = set()
    for kind in type(thing).__mro__:
        for name, member in vars(kind).items():
            if name in seen or name.startswith("_"):
                continue
            seen.add(name)
            if isinstance(member, property) and member.fset is not None:
                doc = re.sub(r"\s+", " ", member.__doc__ or "").strip()
                reads = re.search(r"-> (.*)$", member.fget.__doc__ or "", re.MULTILINE)
                writes = re.search(r"arg1: (.*)\) -> None", member.fset.__doc__ or "")
                yield _Property(
                    thing,
                    name,
                    _types(reads[1]) if reads else _types_of_doc(doc),
                    _types(writes[1]) if writes else (),
                    doc,
                )


def _types(annotation: str) -> tuple[str, ...]:
    """Split a union at each bar outside brackets."""
    found, depth, word = [], 0, ""
    for sign in annotation:
        depth += (sign == "[") - (sign == "]")
        if sign == "|" and depth == 0:
            found.append(word.strip())
            word = ""
        else:
            word += sign
    return (*found, word.strip())


def _types_of_doc(doc: str) -> tuple[str, ...]:
    """Read "float or None: ..." where a property has no signature."""
    return tuple(re.split(r", | or ", doc.partition(":")[0]))


# ---- from a property to its controls


def _controls(one: _Property) -> Iterator[Control]:
    words = [word for kind in one.takes for word in re.findall(r'"([^"]+)"', kind)]
    literals = (re.fullmatch(r"typing\.Literal\[(\d[\d, ]*)\]", kind) for kind in one.takes)
    numbers = [number for found in literals if found for number in found[1].split(", ")]
    flags = one.kinds[0].count("bool") if one.kinds and one.kinds[0].startswith("tuple[") else 0
    if isinstance(value := one.get(), Mapping):
        yield from _of_mapping(one, value)
    elif words:
        yield _choice(one, {word: word for word in words})
    elif numbers:
        yield _choice(one, {number: int(number) for number in numbers})
    elif one.kinds == ("bool",):
        yield _choice(one, {"False": False, "True": True}) if one.optional else one.control("flag")
    elif flags:
        yield from _flags(one, flags)
    elif one.kinds in (("float",), ("int",)):
        yield from _or_none(one, _number(one), None)
    elif (count := _length(one)) is not None:
        if "RGB" in one.doc or "str" in one.takes:
            yield from _color(one, count)
        else:
            yield from _or_none(one, _vector(one, count), [0.0] * count)
    elif one.kinds == ("str",) and one.takes == ("str",):
        yield one.control("text")
    elif one.optional and any(kind.endswith("Image") for kind in one.kinds):
        if value is not None:
            yield from _map(one)
    elif one.optional and "bool" in one.takes:
        yield _switch(one)


def _length(one: _Property) -> int | None:
    """Say how many numbers a vector or a colour has; None for everything else."""
    if one.kinds and one.kinds[0].startswith("tuple[int"):
        return one.kinds[0].count("int")
    array = re.match(r"ndarray \((\d+),\)", one.doc)
    return int(array[1]) if array else None


def _number(one: _Property, default: float = 1.0) -> Control:
    value = one.get()
    whole = one.kinds == ("int",)
    kept = [
        default if value is None else value
    ]  # the number that comes back when None is switched off
    if not np.isfinite(kept[0]):
        kept = [default]

    def get() -> float:
        today = one.get()
        if today is not None and np.isfinite(today):
            kept[0] = today
        # A float32 as a float shows digits that nobody wrote.
        return int(kept[0]) if whole else float(f"{kept[0]:.7g}")

    more = slider(one.doc, get(), whole=whole)
    return one.control("integer" if whole else "number", get=get, **more)


def slider(doc: str, value: float, *, whole: bool = False) -> dict[str, Any]:
    """Choose the range of a slider from what a docstring says, and from the present value where it says nothing.

    Returns
    -------
    dict
        The fields `low`, `high`, `step`, `logarithmic` and `unit` of a `Control`.
    """
    unit = next((unit for unit in _UNITS if re.search(rf"\b{unit}\b", doc)), "")
    between = re.search(rf"from {_NUMBER} to {_NUMBER}", doc)
    inside = re.search(rf"above {_NUMBER} and below {_NUMBER}", doc)
    if between or inside:
        low, high = (float(x) for x in (between or inside).groups())  # type: ignore[union-attr]
        if inside:  # the ends themselves are refused
            low, high = low + (high - low) / 180, high - (high - low) / 180
    elif whole:
        return {"step": 1, "unit": unit}  # a count without a limit: a field, no slider
    elif unit == "degrees":
        low, high = (0.0, 180.0) if value >= 0 else (-180.0, 180.0)
    elif value > 0 and (unit == "world units" or value >= _LARGE):
        low, high = float(f"{value / 100:.2g}"), float(f"{value * 100:.2g}")
        return {"low": low, "high": high, "logarithmic": True, "unit": unit}
    else:
        high = _round_up(max(2 * abs(value), 1.0))
        low = 0.0 if value >= 0 else -high
    # A range holds the present value in any case.
    low, high = min(low, value), max(high, value)
    return {"low": low, "high": high, "step": 1 if whole else None, "unit": unit}


def _round_up(value: float) -> float:
    """Give the next number of 1, 2, 5, 10, 20, ..."""
    power = 10.0 ** np.floor(np.log10(value))
    return next(float(k * power) for k in (1, 2, 5, 10) if k * power >= value * (1 - 1e-9))


def _or_none(one: _Property, control: Control, start: Any) -> Iterator[Control]:
    """Give a control, and a flag beside it where the property may be None or infinite."""
    if not one.optional and one.off is None:
        yield control
        return

    def is_off() -> bool:
        today = one.get()
        return today is None if one.off is None else bool(today == one.off)

    def set_off(value: bool) -> None:
        one.set(one.off if value else control.get())

    control.get()  # remembers the number
    yield one.control("flag", name=f"{one.name} is {one.off}", get=is_off, set=set_off)
    # The flag brings the value back, None included.
    yield Control(**{**vars(control), "keep": None})


def _vector(one: _Property, count: int) -> Control:
    whole = one.kinds[0].startswith("tuple[int")
    kept = [[0.0] * count]

    def get() -> list[float]:
        today = one.get()
        if today is not None:
            kept[0] = [float(f"{float(v):.7g}") for v in today]
        return [int(v) for v in kept[0]] if whole else list(kept[0])

    def set_(value: list[float]) -> None:
        if whole and any(v != int(v) for v in value):
            raise TypeError(f"{one.name}: expected whole numbers, got {text_of(value)}")
        one.set(tuple(int(v) for v in value) if whole else value)

    more = {"unit": "texels"} if "texels" in one.doc else {}
    return one.control("vector", get=get, set=set_, **more)


def _color(one: _Property, count: int) -> Iterator[Control]:
    """Give a colour picker, a number for the alpha, and a flag where the colour may be None."""
    kept = [np.ones(count, np.float32)]

    def today() -> npt.NDArray[np.float32]:
        value = one.get()
        if isinstance(value, np.ndarray):
            kept[0] = value
        return kept[0]

    def is_array() -> bool:
        return isinstance(one.get(), np.ndarray)

    def set_color(value: object) -> None:
        if isinstance(value, str) and _COLOR_DIGITS.fullmatch(value):
            # The picker shows 8 bits: the colour that it shows already keeps its exact numbers.
            if is_array() and value.lower() == color_to_hex(today()):
                return
            one.set(np.concatenate([hex_to_color(value), today()[3:]]))
        else:
            one.set(value)

    def set_alpha(value: float) -> None:
        one.set(np.concatenate([today()[:3], [np.float32(value)]]))

    def set_none(value: bool) -> None:
        one.set(None if value else today())

    today()
    if one.optional:
        yield one.control(
            "flag", name=f"{one.name} is None", get=lambda: one.get() is None, set=set_none
        )
    picker = f"{one.doc} The picker shows sRGB, clipped to 0..1."
    yield one.control("color", get=lambda: color_to_hex(today()), set=set_color, help=picker)
    if count == 4:
        yield one.control(
            "number",
            name=f"{one.name} alpha",
            get=lambda: float(f"{float(today()[3]):.7g}"),
            set=set_alpha,
            low=0.0,
            high=1.0,
            keep=None,
        )


def _choice(one: _Property, named: Mapping[str, object]) -> Control:
    """Give a choice of values by name. A value without a name, for example a Blend, is one more choice."""
    values: dict[str, object] = {"None": None, **named} if one.optional else dict(named)

    def word_of(value: object) -> str:
        found = next((w for w, v in values.items() if type(v) is type(value) and v == value), None)
        if found is None:
            found = str(value)
            values[found] = value
        return found

    word_of(one.get())
    return one.control(
        "choice",
        get=lambda: word_of(one.get()),
        set=lambda word: one.set(values[word]),
        choices=tuple(values),
    )


def _flags(one: _Property, count: int) -> Iterator[Control]:
    """Give a flag for each part of a tuple of bool; the docstring lists the names of the parts."""
    listed = re.search(r"which of ((?:\w+, )+\w+)", one.doc)
    names = listed[1].split(", ") if listed else []
    if len(names) != count:
        names = [str(i) for i in range(count)]
    for i, name in enumerate(names):

        def set_(value: bool, i: int = i) -> None:
            flags = list(one.get())
            flags[i] = value
            one.set(tuple(flags))

        yield one.control(
            "flag",
            name=f"{one.name} {name}",
            get=lambda i=i: bool(one.get()[i]),
            set=set_,
            keep=one.keep if i == 0 else None,
        )


def _switch(one: _Property) -> Control:
    """Give a flag for an object that may be there or not, for example a light's Shadow."""
    kept: list[Any] = [True]

    def get() -> bool:
        today = one.get()
        if today is not None:
            kept[0] = today
        return today is not None

    get()
    return one.control("flag", get=get, set=lambda value: one.set(kept[0] if value else None))


def _map(one: _Property) -> Iterator[Control]:
    """Give a flag for a picture that may be switched off, and its place where the property takes a Texture."""
    kept: list[Any] = [one.get()]

    def today() -> Any:
        value = one.get()
        if value is not None:
            kept[0] = value
        return value

    def set_shown(value: bool) -> None:
        one.set((today() or kept[0]) if value else None)

    # Comparing the pixels of two pictures takes long, so a picture counts as unchanged only if it is the same object.
    first = one.get()
    yield one.control(
        "flag",
        get=lambda: today() is not None,
        set=set_shown,
        keep=lambda: lambda: None if one.get() is first else one.set(first),
    )
    if not any(kind.endswith("Texture") and "Render" not in kind for kind in one.kinds):
        return

    def place() -> Texture:
        value = today() or kept[0]
        return value if isinstance(value, Texture) else Texture(value)

    def put(**fields: Any) -> None:
        was = place()
        names = ("uv_set", "offset", "rotation", "scale")
        changed = Texture(was.source, **{**{name: getattr(was, name) for name in names}, **fields})
        kept[0] = changed
        if one.get() is not None:
            one.set(changed)

    for name in ("offset", "scale"):
        yield one.control(
            "vector",
            name=f"{one.name} {name}",
            get=lambda name=name: [float(f"{float(v):.7g}") for v in getattr(place(), name)],
            set=lambda value, name=name: put(**{name: value}),
            keep=None,
        )
    yield one.control(
        "number",
        name=f"{one.name} rotation",
        get=lambda: float(f"{place().rotation:.7g}"),
        set=lambda value: put(rotation=value),
        keep=None,
        low=-180.0,
        high=180.0,
        unit="degrees",
    )
    yield one.control(
        "choice",
        name=f"{one.name} uv_set",
        get=lambda: str(place().uv_set),
        set=lambda value: put(uv_set=int(value)),
        keep=None,
        choices=("0", "1"),
    )


def _of_mapping(one: _Property, mapping: Mapping[str, Any]) -> Iterator[Control]:
    """Give a control for each number or vector of a mapping, for example the uniforms of a ShaderMaterial."""
    keep: Callable[[], Callable[[], object]] | None = one.keep
    for name, value in mapping.items():
        if np.ndim(value) > 1 or np.asarray(value).dtype.kind not in "iuf":
            continue
        entry = _Entry(one, name)
        if np.ndim(value) == 0:
            yield one.control(
                "number",
                name=name,
                get=entry.number,
                set=entry.set,
                keep=keep,
                **slider("", float(value)),
            )
        elif len(value) in (3, 4) and "color" in name.lower():
            colored = _Property(entry, "value", ("ndarray",), (), f"{one.doc} RGB.")
            for control in _color(colored, len(value)):
                label = control.name.replace("value", name, 1)
                yield Control(**{**vars(control), "name": label, "keep": keep})
                keep = None
        else:
            yield one.control("vector", name=name, get=entry.numbers, set=entry.set, keep=keep)
        keep = None  # the first control brings all entries back


class _Entry:
    """One number or vector of a mapping, as a property."""

    def __init__(self, owner: _Property, name: str) -> None:
        self._owner = owner
        self._name = name

    @property
    def value(self) -> npt.NDArray[Any]:
        return np.asarray(self._owner.get()[self._name])

    @value.setter
    def value(self, value: object) -> None:
        self.set(value)

    def set(self, value: object) -> None:
        self._owner.get()[self._name] = value

    def number(self) -> float:
        return float(f"{float(self.value):.7g}")

    def numbers(self) -> list[float]:
        return [float(v) for v in self.value]
