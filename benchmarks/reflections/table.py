"""The rows of the table: which scene, reflector and method, and what is measured."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

import cubecam as cc

from . import measure
from .methods import METHODS, MissingError
from .reflectors import World

FACES = 256
SINGLE = (
    "plain", "box", "sphere", "distance 6", "distance 14", "distance 35", "layers 6", "layers 14", "layers 35",
)  # fmt: skip
SOME = ("plain", "box", "distance 14", "distance 35", "layers 35")
GLASS = (
    "plain", "box", "distance 14", "layers 35",
    "both sides, plain", "both sides, box", "both sides, distance 14", "both sides, layers 35",
)  # fmt: skip
SCREEN = ("screen, plain", "screen, distance 14", "screen, layers 14")
SHARED = ("plain, .5 m off", "layers 35, .5 m off")


@dataclass(frozen=True)
class Case:
    """One row: `bounces` is None where no mirror sees another one."""

    place: str
    reflector: str
    method: str
    faces: int = FACES
    bounces: int | None = None

    @property
    def baseline(self) -> Case:
        """The row of the plain probe that this one is compared with."""
        return replace(self, method="plain")


@dataclass
class Row:
    """What was measured of a case.

    Attributes
    ----------
    rmse, within, largest : float or None
        See `measure.Colors`.
    ratio : float or None
        `rmse` over that of the plain probe.
    p1 : float or None
        The share of hit points within 1 % of the ray's length, for a single mirror.
    ms, time : float or None
        CPU time of a frame of 512 x 512, rgba8, of which nothing but the camera moved, and its ratio to that of the
        plain probe.
    missing : str
        What this version of cubecam lacks; nothing is measured then.
    """

    case: Case
    rmse: float | None = None
    ratio: float | None = None
    within: float | None = None
    largest: float | None = None
    p1: float | None = None
    ms: float | None = None
    time: float | None = None
    missing: str = ""


def cases(*, quick: bool) -> list[Case]:
    """Give the rows of the table; the quick ones are those with a mark, without rough metal and glass."""
    found = [Case("room_a", "mirror", m) for m in (*SINGLE, *SCREEN, *SHARED)]
    found += [Case("room_b", "mirror", m) for m in (SOME if quick else SINGLE)]
    found += [Case("outdoor", "mirror", m) for m in (SOME if quick else SINGLE)]
    if not quick:
        found += [Case(p, "teapot", m) for p in ("room_a", "room_b") for m in SOME]
        found += [Case("room_a", "teapot", m) for m in SCREEN]
        for reflector in ("glossy .2", "glossy .4"):
            found += [Case("room_a", reflector, m) for m in SOME]
        found += [Case("outdoor", "glossy .2", m) for m in SOME]
        found += [Case(place, "glass", m) for place in ("room_a", "outdoor") for m in GLASS]
        for faces in (64, 128, 512, 1024):
            found += [
                Case("room_a", "mirror", m, faces) for m in ("plain", "distance 14", "layers 35")
            ]
    found += [Case("room_a", "plane", m) for m in ("plain", "box", "layers 35", *SCREEN, "planar")]
    found += [
        Case("room_a", "floor", m)
        for m in ("plain", "box", "distance 14", "layers 14", *SCREEN, "planar")
    ]
    for bounces in (1, 2) if quick else (1, 2, 3):
        found += [
            Case("room_a", "facing balls", m, bounces=bounces)
            for m in ("plain", "distance 14", "layers 35")
        ]
    for bounces in (4,) if quick else (1, 2, 3, 4):
        found += [
            Case("room_a", "facing planes", m, bounces=bounces)
            for m in ("plain", "layers 35", "planar")
        ]
    return found


@dataclass(frozen=True)
class _Truth:
    color: npt.NDArray[Any]
    position: npt.NDArray[Any]
    on: npt.NDArray[np.bool_]
    noise: float


@cache
def _truth(place: str, reflector: str, bounces: int, size: int, *, coded: bool) -> _Truth:
    """The exact picture, once for all methods."""
    world = World(place, reflector)
    kind = world.reflector
    if coded:
        measure.code_positions(world.scene, world.nodes)
    exact = cc.truth.render(
        world.scene,
        world.camera,
        (size, size),
        bounces=bounces,
        samples=kind.samples,
        self_hits=False,
        outputs=("id", "position"),
        progress=False,
    )
    on = np.isin(exact.outputs["id"], [node.id for node in world.nodes])
    if kind.samples > 1:  # pixels at the edge are mixed with what is behind
        on = measure.inner(on)
    return _Truth(exact.color, exact.outputs["position"], on, exact.noise)


class Bench:
    """Measures cases, one renderer for all.

    Parameters
    ----------
    renderer : Renderer
    rounds : int
        Frames of each method whose time is taken; 0: none is.
    pictures : Path, optional
        A folder for a PNG of each case, beside the truth.
    size : int, optional
        Pixels along an edge of the frames. None: as the reflector has it.
    """

    def __init__(
        self,
        renderer: cc.Renderer,
        rounds: int,
        pictures: Path | None = None,
        size: int | None = None,
    ) -> None:
        self._renderer, self._rounds, self._pictures = renderer, rounds, pictures
        self._size = size
        self._plain: dict[Case, float] = {}

    def run(
        self, chosen: Iterable[Case], tell: Callable[[Row], None] = lambda row: None
    ) -> list[Row]:
        """Measure cases in their order, the plain probe of a group first, and tell of each one that is done."""
        rows = []
        for case in chosen:
            row = Row(case)
            try:
                self._measure(row)
            except MissingError as error:
                row.missing = str(error)
            rows.append(row)
            tell(row)
        return rows

    def _measure(self, row: Row) -> None:
        case = row.case
        world, frame = self._prepared(case)
        bounces = world.reflector.bounces if case.bounces is None else case.bounces
        size = self._size or world.reflector.size
        truth = _truth(case.place, case.reflector, bounces, size, coded=False)
        linear = world.place.linear
        got, exact = (measure.shown(c, linear=linear) for c in (frame(0), truth.color))
        found = measure.compare(got, exact, truth.on)
        row.rmse, row.within, row.largest = found.rmse, found.within, found.largest
        if case.method == "plain":
            self._plain[case] = found.rmse
        base = self._plain.get(case.baseline)
        row.ratio = None if base is None else found.rmse / base
        if world.reflector.mirror:
            row.p1 = self._hits(case)
        if self._pictures is not None:
            _save(self._pictures / f"{_name(case)}.png", np.concatenate([exact, got], axis=1))
        if self._rounds and case.faces == FACES:
            _, full = self._prepared(case, timed=True)
            _, plain = self._prepared(case.baseline, timed=True)
            row.ms, row.time = measure.cpu_ratio(full, plain, self._rounds)

    def _prepared(
        self, case: Case, *, timed: bool = False
    ) -> tuple[World, Callable[[int], npt.NDArray[Any]]]:
        """Make a world with its environments, and what draws a frame of it; a number moves the camera a little."""
        world = World(case.place, case.reflector)
        options = _environments(world, case)
        pixels = 512 if timed else self._size or world.reflector.size
        texels: Literal["rgba8", "rgba32f"] = "rgba8" if timed else "rgba32f"
        eye = world.camera.position

        def frame(index: int) -> npt.NDArray[Any]:
            world.camera.position = np.add(eye, (1e-7 * index, 0, 0))
            drawn = self._renderer.render(
                world.scene, world.camera, (pixels, pixels), format=texels, **options
            )
            return np.asarray(drawn.color)

        return world, frame

    def _hits(self, case: Case) -> float:
        world = World(case.place, case.reflector)
        measure.code_positions(world.scene, world.nodes)
        options = _environments(world, case, texels="rgba32f")
        pixels = self._size or world.reflector.size
        truth = _truth(case.place, case.reflector, 1, pixels, coded=True)
        drawn = self._renderer.render(
            world.scene, world.camera, (pixels, pixels), format="rgba32f", **options
        )
        return measure.hits_found(np.asarray(drawn.color), truth.color, truth.position, truth.on)


def _environments(world: World, case: Case, **options: Any) -> dict[str, Any]:
    # One bounce is the default, and needs no option.
    bounces = None if case.bounces == 1 else case.bounces
    return METHODS[case.method].prepare(world, size=case.faces, bounces=bounces, **options)


def _name(case: Case) -> str:
    text = f"{case.place} {case.reflector} {case.faces} {case.method}"
    if case.bounces is not None:
        text += f" {case.bounces} bounces"
    return text.replace(" ", "_").replace(",", "").replace(".", "")


def _save(path: Path, picture: npt.NDArray[Any]) -> None:
    cc.save_image(path, np.asarray(np.rint(255 * picture), np.uint8))


def markdown(rows: Iterable[Row]) -> str:
    """Give the table as Markdown."""
    columns = (
        "scene reflector faces bounces method RMSE over_plain within_4/255 hits_within_1_% CPU_time"
    )
    lines = [
        "| " + columns.replace(" ", " | ").replace("_", " ") + " |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        c = row.case
        names = [
            c.place,
            c.reflector,
            str(c.faces),
            "" if c.bounces is None else str(c.bounces),
            c.method,
        ]
        if row.missing:
            lines.append(
                "| " + " | ".join([*names, f"not yet: {row.missing}", "", "", "", ""]) + " |"
            )
            continue
        numbers = [
            _text(row.rmse, ".4f"),
            _text(row.ratio, ".2f"),
            _text(row.within, ".1%"),
            _text(row.p1, ".1%"),
            "" if row.time is None else f"{row.time:.1f} x ({row.ms:.0f} ms)",
        ]
        lines.append("| " + " | ".join([*names, *numbers]) + " |")
    return "\n".join(lines) + "\n"


def _text(value: float | None, form: str) -> str:
    return "" if value is None else format(value, form)


def as_json(rows: Iterable[Row], machine: dict[str, Any]) -> str:
    """Give the table as JSON: the machine, and an object for each row."""
    found = []
    for row in rows:
        data = asdict(row)
        found.append({**data.pop("case"), **data})
    return json.dumps({"machine": machine, "rows": found}, indent=1) + "\n"
