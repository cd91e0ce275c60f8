"""Pictures of results and of objects, for notebooks, terminals and the command line.

`results` draws cubemaps, frames and images. The other modules describe objects: `cards` holds what is shown of any
object, `describe` and `scenes` fill it in, `studio` draws the thumbnails, and `html` and `rich_text` write it.
"""

from __future__ import annotations

from .results import cube_picture, cube_png, frame_png, image_png

__all__ = ["cube_picture", "cube_png", "frame_png", "image_png"]
