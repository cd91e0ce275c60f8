"""Plots of cubemaps with matplotlib, for notebooks and papers: ``pip install "cubecam[plot]"``.

>>> import cubecam as cc
>>> cube = cc.load_environment(cc.sample_data("studio.exr"), size=64)
>>> ax = cc.plot.cross(cube)

Each function draws on ``ax=`` or, without one, on a new figure, and returns the matplotlib Axes that it drew on;
`faces` and `pictures` draw on several and return an array of them. No function shows or closes a figure, or changes
matplotlib's settings. matplotlib is imported by the first picture; `seam_steps`, `inner_steps` and `seam_ratios` need
only numpy.

Faces are drawn in the convention "inside", the view from the center, unless ``convention=`` names another one
(docs/conventions.md). Light is prepared for the screen as by ``cc.to_screen``.
"""

from __future__ import annotations

from ._errors import error_map
from ._faces import EDGE_NAMES
from ._layout import layout
from ._pictures import cross, faces, panorama, pictures
from ._seams import inner_steps, seam_ratios, seam_steps, seams
from ._vectors import arrows, face_axes, vectors

__all__ = [
    "EDGE_NAMES",
    "arrows",
    "cross",
    "error_map",
    "face_axes",
    "faces",
    "inner_steps",
    "layout",
    "panorama",
    "pictures",
    "seam_ratios",
    "seam_steps",
    "seams",
    "vectors",
]
