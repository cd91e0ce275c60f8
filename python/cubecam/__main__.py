"""`python -m cubecam` is the command `cubecam`."""

from __future__ import annotations

import sys

__all__ = ["main"]


def main() -> None:
    """Run the command; `cubecam doctor` runs without the packages that the others need.

    Raises
    ------
    ImportError
        If a package is missing that the command needs; `cubecam doctor` needs none.
    """
    try:
        from .cli import main as run
    except ImportError as error:
        if sys.argv[1:2] != ["doctor"]:
            raise
        from .doctor.broken import run_without_the_core

        raise SystemExit(run_without_the_core(sys.argv[2:], "", str(error))) from None
    run()


if __name__ == "__main__":
    main()
