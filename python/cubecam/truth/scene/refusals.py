"""What rays cannot follow: refused by name before any work."""

from __future__ import annotations

from typing import Any, NoReturn

from ..._core import (
    BasicMaterial,
    Blend,
    GlassMaterial,
    Material,
    MirrorMaterial,
    Node,
    PhongMaterial,
    Probe,
    RenderTexture,
    StandardMaterial,
)
from .records import LINEAR_FACTORS, Kind

KINDS: dict[type[Material], Kind] = {
    BasicMaterial: "basic",
    PhongMaterial: "phong",
    MirrorMaterial: "mirror",
    GlassMaterial: "glass",
    StandardMaterial: "standard",
}

#: Ways to blend that multiply by the surface's colour.
_PRODUCTS = ("multiply", "src_color", "one_minus_src_color")


def kind_of(node: Node) -> Kind:
    """Return the kind of a node's material.

    Raises
    ------
    ValueError
        For a material that rays cannot follow; the message names the node and the property.
    """
    material = node.material
    kinds = [kind for known, kind in KINDS.items() if isinstance(material, known)]
    if material is None or not kinds:
        names = ", ".join(known.__name__ for known in KINDS)
        _refuse(node, "material", f"one of {names}", type(material).__name__)
    _check(node, material)
    return kinds[0]


def _check(node: Node, material: Material) -> None:
    if material.stencil is not None:
        _refuse(node, "material.stencil", "None", material.stencil)
    if not material.depth_test:
        _refuse(node, "material.depth_test", "True", False)
    if not all(material.color_write):
        _refuse(node, "material.color_write", "all four channels", material.color_write)
    if isinstance(material, BasicMaterial) and isinstance(material.cubemap, Probe):
        _refuse(node, "material.cubemap", "a CubeMap or None", material.cubemap)
    if isinstance(material.blend, Blend):
        _check_blend(node, material.blend)


def check_depth_write(node: Node, opaque: bool) -> None:
    """Refuse an opaque surface that hides nothing: what shows would depend on the order of drawing."""
    material = node.material
    if opaque and material is not None and material.depth_write is False:
        _refuse(node, "material.depth_write", "True or None on an opaque surface", False)


def check_gathering(node: Node, *names: str) -> None:
    """Refuse a product of two lights that rays must follow: that of the surface, and that behind it.

    `names` are a mode of blending, or the factors of a `Blend` for colours.
    """
    material = node.material
    gathers = isinstance(material, (MirrorMaterial, GlassMaterial)) or (
        isinstance(material, StandardMaterial) and not material.unlit
    )
    for name in names:
        if gathers and name in _PRODUCTS:
            _refuse(
                node,
                "material.blend",
                f"a sum on a {type(material).__name__}, whose colour comes from other rays",
                repr(name),
            )


def check_texture(node: Node, name: str, texture: RenderTexture) -> None:
    """Refuse a render texture with effects."""
    if texture.effects:
        _refuse(node, f"material.{name}", "a RenderTexture without effects", texture)


def no_textures(node: Node, name: str, texture: RenderTexture) -> NoReturn:
    """Refuse a render texture where the caller has no function that renders it."""
    _refuse(node, f"material.{name}", "an Image", texture)


def _check_blend(node: Node, blend: Blend) -> None:
    """Check that the result is A + B * D, with the colour D behind the surface."""
    if blend.equation != "add":
        _refuse(node, "material.blend.equation", "'add'", repr(blend.equation))
    for name in ("src", "dst", "src_alpha", "dst_alpha"):
        factor = getattr(blend, name)
        if factor not in LINEAR_FACTORS and not (
            name.endswith("alpha") and factor == "src_alpha_saturate"
        ):
            _refuse(
                node,
                f"material.blend.{name}",
                "a factor that does not depend on the picture",
                repr(factor),
            )


def _refuse(node: Node, place: str, expected: str, got: Any) -> NoReturn:
    name = f" {node.name!r}" if node.name else ""
    raise ValueError(f"node {node.id}{name}, {place}: expected {expected}, got {got}")
