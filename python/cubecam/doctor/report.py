"""Findings as text and as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable
from dataclasses import asdict

from .findings import Finding
from .proofs.measurement import Measurement

__all__ = ["as_json", "as_lines", "measurement_lines", "verdict"]

_COLORS = {"ok": "green", "note": "cyan", "warning": "yellow", "problem": "red"}


def as_lines(
    findings: Iterable[Finding], paint: Callable[[str, str], str] = lambda text, color: text
) -> list[str]:
    """Give the lines of a terminal: a status, what was found, and below it what mends it."""
    lines = []
    for finding in findings:
        status = paint(f"{finding.status:<8}", _COLORS[finding.status])
        first, *more = finding.text.splitlines() or [""]
        lines.append(f"{status} {finding.name}: {first}")
        lines += [f"         {line}" for line in more]
        lines += [
            f"           {paint(line, 'bright_black') if line.startswith('#') else line}"
            for line in finding.cure
        ]
    # Names of files and variables may hold bytes that are no text.
    return [line.encode("utf-8", "backslashreplace").decode() for line in lines]


def verdict(findings: Iterable[Finding]) -> str:
    """Say in a line whether a picture can be drawn."""
    status = [finding.status for finding in findings]
    problems, warnings = status.count("problem"), status.count("warning")
    if problems:
        return f"No picture can be drawn as asked: {_count(problems, 'problem')}, {_count(warnings, 'warning')}."
    return f"Pictures can be drawn; {_count(warnings, 'warning')}."


def as_json(findings: Iterable[Finding], tests: Iterable[Measurement] | None = None) -> str:
    """Give one JSON object."""
    listed = list(findings)
    works = all(finding.status != "problem" for finding in listed)
    report: dict[str, object] = {
        "works": works,
        "findings": [asdict(finding) for finding in listed],
    }
    if tests is not None:
        report["selftest"] = [_numbers(test) for test in tests]
    return json.dumps(report, indent=2)


def _numbers(test: Measurement) -> dict[str, object]:
    members = {**asdict(test), "passed": test.passed}
    # JSON has no NaN and no infinity.
    return {**members, "error": test.error if math.isfinite(test.error) else None}


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'s' * (number != 1)}" if number else f"no {what}s"


def measurement_lines(
    tests: Iterable[Measurement],
    seconds: float,
    paint: Callable[[str, str], str] = lambda text, color: text,
) -> list[str]:
    """Give a line for each test, with its error and its tolerance, and one for all."""
    lines, failed = [], 0
    for test in tests:
        failed += not test.passed
        status = paint("ok      ", "green") if test.passed else paint("FAILED  ", "red")
        numbers = f"error {test.error:.2g}, tolerance {test.tolerance:.2g}"
        lines.append(f"{status} {test.name}: {test.what}: {test.failure or numbers}")
    words = f"{_count(failed, 'test')} failed" if failed else "All tests passed"
    return [*lines, f"{words}, in {seconds:.1f} s."]
