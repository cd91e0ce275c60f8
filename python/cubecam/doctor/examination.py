"""All checks, one after the other."""

from __future__ import annotations

import sys

from . import installation
from .devices import check_devices, check_variables
from .drawing import Drawing, check_drawing, try_drawing
from .egl_library import check_egl_library
from .extras import check_extras
from .findings import Finding
from .mesa import check_mesa
from .module import here
from .nodes import check_nodes
from .nvidia import check_nvidia
from .process import check_cache, check_helper, check_limits
from .surroundings import check_surroundings
from .system import System
from .vendors import check_vendors

__all__ = ["all_findings"]


def all_findings(system: System, device: str | None = None, error: str = "") -> list[Finding]:
    """Look at everything; `error` is the text of the ImportError if the core could not be loaded."""
    used = here().folder
    found = check_surroundings(system)
    module = installation.check_module(system, error)
    found += module
    found += installation.check_requirements()
    found += installation.check_copies(sys.path, used)
    found += installation.check_script(installation.found_script())
    loads = module[0].status != "problem"
    drawing = try_drawing(system, device) if loads else Drawing(tried=False)
    found += check_egl_library(system, drawing)
    found += check_vendors(system, drawing)
    found += check_mesa(system, drawing)
    found += check_nvidia(system, drawing)
    found += check_nodes(system, drawing)
    found += check_variables(system, drawing, device)
    found += check_devices(system, drawing, device)
    found += check_drawing(system, drawing, device)
    if loads:
        found += check_helper(drawing, used)
        found += check_limits(system)
    found += check_cache(system)
    found += check_extras()
    return found
