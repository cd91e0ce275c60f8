"""A scene as XML: what a dict for ``mitsuba.load_dict`` says, in Mitsuba's scene format."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

#: The tag of each plugin that cubecam writes.
_TAGS = {
    **dict.fromkeys(("path", "volpath"), "integrator"),
    **dict.fromkeys(("perspective", "orthographic"), "sensor"),
    **dict.fromkeys(("hdrfilm",), "film"),
    **dict.fromkeys(("box",), "rfilter"),
    **dict.fromkeys(("independent",), "sampler"),
    **dict.fromkeys(("ply",), "shape"),
    **dict.fromkeys(("area", "point", "spot", "directional", "constant", "envmap"), "emitter"),
    **dict.fromkeys(("bitmap", "mesh_attribute", "rawconstant"), "texture"),
    **dict.fromkeys(("homogeneous",), "medium"),
    **dict.fromkeys(
        ("diffuse", "conductor", "dielectric", "roughdielectric", "thindielectric", "principled"),
        "bsdf",
    ),
    **dict.fromkeys(("mask", "twosided", "normalmap"), "bsdf"),
}
#: The oldest format that has all of these plugins and names.
_VERSION = "3.0.0"


def scene_xml(scene: dict[str, Any], folder: Path) -> bytes:
    """Write a scene as XML whose file names are relative to a folder, that of the XML file."""
    root = ElementTree.Element("scene", version=_VERSION)
    for name, entry in scene.items():
        if name != "type":
            _add(root, name, entry, folder, is_top=True)
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
    return text + b"\n"


def _add(
    above: ElementTree.Element, name: str, value: Any, folder: Path, is_top: bool = False
) -> None:
    if isinstance(value, dict):
        _add_object(above, name, value, folder, is_top)
    elif isinstance(value, np.ndarray):
        transform = ElementTree.SubElement(above, "transform", name=name)
        ElementTree.SubElement(transform, "matrix", value=" ".join(map(_number, value.flat)))
    elif isinstance(value, (list, tuple)):
        # Points and vectors are read alike, as three numbers.
        tag = "point" if name == "position" else "vector"
        x, y, z = map(_number, value)
        ElementTree.SubElement(above, tag, name=name, x=x, y=y, z=z)
    else:
        tag, text = _plain(name, value, folder)
        ElementTree.SubElement(above, tag, name=name, value=text)


def _add_object(
    above: ElementTree.Element, name: str, value: dict[str, Any], folder: Path, is_top: bool
) -> None:
    kind = value["type"]
    if kind == "ref":
        ElementTree.SubElement(above, "ref", name=name, id=value["id"])
    elif kind == "rgb":
        text = ", ".join(map(_number, value["value"]))
        ElementTree.SubElement(above, "rgb", name=name, value=text)
    else:
        tag = _TAGS[kind]
        label = {"type": kind, "id" if is_top else "name": name}
        element = ElementTree.SubElement(above, tag, label)
        for key, part in value.items():
            if key != "type":
                if kind == "rawconstant":
                    text = ", ".join(map(_number, part))
                    ElementTree.SubElement(element, "vector", name=key, value=text)
                else:
                    _add(element, key, part, folder)


def _plain(name: str, value: Any, folder: Path) -> tuple[str, str]:
    if isinstance(value, bool):
        return "boolean", "true" if value else "false"
    if isinstance(value, int):
        return "integer", str(value)
    if isinstance(value, float):
        return "float", _number(value)
    if name == "filename" and Path(value).parent == folder:
        return "string", Path(value).name
    return "string", str(value)


def _number(value: Any) -> str:
    """Return the shortest digits that give the same float64 again."""
    return repr(float(value))
