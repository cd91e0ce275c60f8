"""Light on surfaces in numpy, written from the papers and specifications, never from the shaders.

`cubecam.truth` renders with these functions, and the tests judge the renderer by them: the only copy.
"""

from .fresnel import fresnel_dielectric, schlick
from .images import sample_image
from .lights import Ambient, Directional, Light, Point, Spot, falloff, way_to
from .phong_model import phong
from .vectors import Array, Numbers, dot, normalised, reflect, refract

__all__ = [
    "Ambient",
    "Array",
    "Directional",
    "Light",
    "Numbers",
    "Point",
    "Spot",
    "dot",
    "falloff",
    "fresnel_dielectric",
    "normalised",
    "phong",
    "reflect",
    "refract",
    "sample_image",
    "schlick",
    "way_to",
]
