"""The marks of reflections for `python -m benchmarks --only reflections`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import cubecam as cc

from ..results import Mark, Section
from .table import Bench, Case, Row


@dataclass(frozen=True)
class _Limit:
    work: str
    case: Case
    limit: float
    figure: Callable[[Row], float | None] = lambda row: row.ratio
    unit: str = "x"


def _mirror(place: str, method: str) -> Case:
    return Case(place, "mirror", method)


OWN, SHARED = _mirror("room_a", "layers 35"), _mirror("room_a", "layers 35, .5 m off")
BALLS = Case("room_a", "facing balls", "layers 35", bounces=2)
PLANES = Case("room_a", "facing planes", "planar", bounces=4)

LIMITS = (
    _Limit(
        "room A, one layer, 35 fetches, RMSE over plain", _mirror("room_a", "distance 35"), 0.32
    ),
    _Limit("room A, one layer, 14 fetches", _mirror("room_a", "distance 14"), 0.36),
    _Limit("room A, two layers, 35 fetches", OWN, 0.20),
    _Limit(
        "  its hit points that are more than 1 % off",
        OWN,
        3.0,
        lambda row: 100 * (1 - row.p1) if row.p1 is not None else None,
        "%",
    ),
    _Limit("room B, box", _mirror("room_b", "box"), 0.34),
    _Limit("room B, one layer, 35 fetches", _mirror("room_b", "distance 35"), 0.27),
    _Limit("room B, one layer, 14 fetches", _mirror("room_b", "distance 14"), 0.28),
    _Limit("room B, two layers, 35 fetches", _mirror("room_b", "layers 35"), 0.24),
    _Limit(
        "room A, glass, both sides, over a single refract",
        Case("room_a", "glass", "both sides, layers 35"),
        0.45,
    ),
    _Limit(
        "room A, facing balls, 2 bounces, two layers, RMSE", BALLS, 0.035, lambda row: row.rmse, ""
    ),
    _Limit(
        "room A, facing planes, 4 bounces, largest error",
        PLANES,
        1.0,
        lambda row: None if row.largest is None else 255 * row.largest,
        "/ 255",
    ),
    _Limit(
        "room A, one layer, 14 fetches, CPU time over plain",
        _mirror("room_a", "distance 14"),
        7.0,
        lambda row: row.time,
    ),
)


def run(quick: bool) -> list[Section]:
    """Measure what has a mark; `quick` leaves out glass, whose exact picture takes most of the time."""
    section = Section("reflections", "reflections: RMSE against exact rays, 256 faces")
    limits = [one for one in LIMITS if not (quick and one.case.reflector == "glass")]
    wanted = [one.case for one in limits] + [SHARED]
    # The plain probe of each group comes first: ratios are over its error.
    wanted = list(dict.fromkeys([case.baseline for case in wanted] + wanted))
    with cc.Renderer() as renderer:
        timed = Bench(renderer, 3 if quick else 7)
        rows = {row.case: row for row in timed.run(wanted)}
    for one in limits:
        row = rows[one.case]
        section.marks.append(Mark(one.work, one.figure(row), one.limit, one.unit, row.missing))
    own, shared = rows[OWN].rmse, rows[SHARED].rmse
    ratio = None if own is None or shared is None else shared / own
    section.marks.append(
        Mark("room A, a probe .5 m away over its own", ratio, 1.3, note=rows[SHARED].missing)
    )
    return [section]
