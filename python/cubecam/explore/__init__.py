"""Diagrams that can be turned by hand, for lessons.

>>> import cubecam as cc
>>> with cc.explore.reflection(where="offscreen", angle=20) as diagram:
...     picture = diagram.draw()
>>> picture.shape
(600, 960, 4)
"""

from __future__ import annotations

from ._layout import LayoutView, layout
from ._reflection import ReflectionView, reflection

__all__ = ["LayoutView", "ReflectionView", "layout", "reflection"]
