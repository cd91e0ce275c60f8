"""`cubecam doctor`: what is missing and the command that mends it; with --selftest, whether the driver draws right."""

from __future__ import annotations

import time

import click

from .common import device_option
from .help import Command, option

_HELP = """Look for what is missing on this machine, and say the command that mends it.

Each line is ok, a note, a warning or a problem. Exit code 1: no picture can be drawn as asked, or a test failed.
"""


@click.command(cls=Command, help=_HELP)
@option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@option(
    "--selftest",
    is_flag=True,
    help="Then compare what the driver draws with numpy: orientation, seams, formats, mirrors, a shader.",
)
@device_option
def doctor(device: str | None, as_json: bool, selftest: bool) -> None:
    """Print the findings, and run the tests."""
    from ..doctor.examination import all_findings
    from ..doctor.proofs.run import prove_apart
    from ..doctor.report import as_json as json_text
    from ..doctor.report import as_lines, measurement_lines, verdict
    from ..doctor.system import System

    system = System()
    findings = all_findings(system, device)
    works = all(finding.status != "problem" for finding in findings)
    if not as_json:
        click.echo("\n".join([*as_lines(findings, _paint), verdict(findings)]))
    tests = None
    start = time.monotonic()
    if selftest and works:
        tests = prove_apart(system, device)
        if not as_json:
            seconds = time.monotonic() - start
            click.echo("\n".join(measurement_lines(tests, seconds, _paint)))
    if as_json:
        click.echo(json_text(findings, tests))
    if not works or not all(test.passed for test in tests or ()):
        raise SystemExit(1)


def _paint(text: str, color: str) -> str:
    return click.style(text, fg=color)
