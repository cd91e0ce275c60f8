"""What is missing on this machine, and what mends it: the command `cubecam doctor`.

Nothing of this package needs the compiled module or numpy before it is used, so that it runs when they are what is
missing. ``examine()`` looks for causes, ``selftest()`` compares pictures of this machine's driver with numpy.
"""

from __future__ import annotations

from .findings import Finding
from .proofs.measurement import Measurement

__all__ = ["Finding", "Measurement", "examine", "selftest"]


def examine(device: str | int | None = None) -> list[Finding]:
    """Look for what prevents drawing on this machine, or makes it slow.

    A process of its own opens EGL and draws, so that a driver that crashes is a finding.

    Parameters
    ----------
    device : str or int, optional
        As in `Renderer`: "auto", "software", "gpu", an index, a part of a name or a UUID. None: "auto".

    Returns
    -------
    list of Finding
        In the order in which things depend on each other. No picture can be drawn if the status of one is "problem".

    Raises
    ------
    TypeError
        For a device of another type.

    Examples
    --------
    >>> import cubecam as cc
    >>> found = {finding.name: finding.status for finding in cc.doctor.examine()}
    >>> found["drawing"]
    'ok'
    """
    from .examination import all_findings
    from .system import System

    if device is not None and (not isinstance(device, (str, int)) or isinstance(device, bool)):
        raise TypeError(f"device: expected str, int or None, got {type(device).__name__}")
    return all_findings(System(), None if device is None else str(device))


def selftest(device: str | int | None = None) -> list[Measurement]:
    """Compare what this machine's driver draws with numpy: orientation, seams, formats, mirrors and a shader.

    Parameters
    ----------
    device : str or int, optional
        As in `Renderer`. None: "auto".

    Returns
    -------
    list of Measurement
        With `name`, `what`, `error`, `tolerance` and `passed`.

    Raises
    ------
    ContextError
        If there is no such device; `cubecam doctor` says why.

    Examples
    --------
    >>> import cubecam as cc
    >>> all(measured.passed for measured in cc.doctor.selftest(device="software"))
    True
    """
    from .._core import Renderer
    from .proofs.run import prove

    with Renderer(device="auto" if device is None else device) as renderer:
        return list(prove(renderer))
