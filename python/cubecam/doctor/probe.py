"""What a process of its own does for the doctor: it opens EGL and draws, and tells each step before it begins.

A driver that crashes ends this process alone, and the last step that was told says where.
"""

from __future__ import annotations

import json
import sys
import warnings
from typing import Any

from .drawing import device_of

__all__ = ["main"]

_DEVICE = ("index", "name", "vendor", "driver", "software", "drm_node", "platform", "problem")
_CHOSEN = ("renderer", "vendor", "version", "platform", "software")
#: Drawn where nothing else is: a driver without a working compiler or readback fails here.
_COLOR = (0.25, 0.5, 0.75)


def main(words: list[str]) -> None:
    """Print one JSON object a line; `words` may have a device, as text."""
    try:
        _probe(device_of(words))
    except Exception as error:
        _tell(error=f"{type(error).__name__}: {error}")


def _probe(device: str | int) -> None:
    from .._core import Renderer, Scene, devices

    _tell(step="listing the devices")
    _tell(devices=[_members(item, _DEVICE) for item in devices()])
    _tell(step="starting the driver")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        with Renderer(device=device) as renderer:
            _tell(chosen=_members(renderer.info, _CHOSEN), index=renderer.info.device.index)
            _tell(step="drawing a picture")
            cube = renderer.capture(Scene(background=_COLOR), size=4)
            got = [float(value) for value in cube.faces[5, 3, 3, :3]]
            if any(abs(a - b) > 1e-3 for a, b in zip(got, _COLOR, strict=True)):
                raise RuntimeError(f"expected a picture of the colour {_COLOR}, got {tuple(got)}")
            _tell(step="trying a shader")
            _try_shader(renderer)
            _tell(step="closing the driver")
    _tell(warnings=[str(item.message) for item in caught])


def _try_shader(renderer: Any) -> None:
    from os import urandom

    from .._core import Mesh, Scene, ShaderMaterial

    # A source that no verdict is kept for: the helper has to start.
    source = f"vec3 shade(Surface s) {{ return vec3(0.5); }} // {urandom(8).hex()}"
    scene = Scene()
    scene.add(Mesh.box(1.0), ShaderMaterial(source, double_sided=True))
    renderer.capture(scene, size=4)


def _members(thing: Any, names: tuple[str, ...]) -> dict[str, Any]:
    return {name: getattr(thing, name) for name in names}


def _tell(**what: Any) -> None:
    sys.stdout.write(json.dumps(what) + "\n")
    sys.stdout.flush()
