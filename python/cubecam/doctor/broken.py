"""What happens when the core cannot be loaded: an import says why, and `cubecam doctor` runs none the less.

It needs nothing but the standard library, since anything else may be what is missing.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NoReturn

__all__ = ["refuse", "run_without_the_core"]


def refuse(error: ImportError) -> NoReturn:
    """Raise an ImportError that explains; in the command `cubecam` print it, or examine the machine, and exit.

    Raises
    ------
    ImportError
        Always, in a program.
    SystemExit
        Always, in the command.
    """
    from .module import explain, here
    from .system import System

    if "subinterpreter" in str(error):  # the module itself says why, and nothing is broken
        raise error
    words = _words_of_command()
    if words is not None and words[:1] == ["doctor"]:
        raise SystemExit(run_without_the_core(words[1:], str(error)))
    finding = explain(System(), here(), str(error))
    text = "\n  ".join((f"cubecam cannot be loaded: {finding.text}", *finding.cure))
    if words is not None:
        print(f"error: {text}\n  `cubecam doctor` says more", file=sys.stderr)
        raise SystemExit(1)
    raise ImportError(f"{text}\n  `cubecam doctor` says more", name="cubecam._core") from error


def run_without_the_core(words: list[str], error: str, command: str = "") -> int:
    """Print what the doctor finds, and give the exit code.

    error, command : the texts of the ImportErrors, if the core or the command line cannot be loaded.
    """
    from .examination import all_findings
    from .findings import Finding
    from .module import here
    from .report import as_json, as_lines, verdict
    from .system import System

    findings = all_findings(System(), error=error)
    if command:
        # The package that is missing may be one that no other finding names, such as one of click's own.
        text = f"the command line cannot be loaded: {command}"
        findings.append(Finding("command", "problem", text, (here().reinstall,)))
    if "--json" in words:
        print(as_json(findings))
    else:
        print("\n".join([*as_lines(findings), verdict(findings)]))
    return 1


def _words_of_command() -> list[str] | None:
    """Give what stands behind `cubecam` in a terminal; None in another program."""
    words = list(getattr(sys, "orig_argv", ()))
    if sys.argv[:1] == ["-m"] and "-m" in words:
        # `python -m cubecam`: the module's name is known before its file is.
        at = words.index("-m")
        return words[at + 2 :] if words[at + 1 : at + 2] == ["cubecam"] else None
    return sys.argv[1:] if sys.argv and Path(sys.argv[0]).name == "cubecam" else None
