"""A glTF file as a Scene: `read_scene`. `build.py` has the steps, each other module makes one kind of object."""

from __future__ import annotations

from .build import read_scene

__all__ = ["read_scene"]
