"""A whole scene for Mitsuba: what it emits, what it looks like, and what Mitsuba cannot say."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..._core import (
    BasicMaterial,
    Camera,
    CubeMap,
    GlassMaterial,
    Material,
    MirrorMaterial,
    Node,
    PhongMaterial,
    Scene,
    StandardMaterial,
)
from ..._nodes import holds, shown_nodes
from ..left_out import LeftOut
from .cameras import sensor_of
from .files import Files
from .geometry import Surface, ply, surface_of
from .lights import Lamps, ambient_of, darkness, even, sky
from .looks import Look
from .materials import Materials

Json = dict[str, Any]

#: How far behind a surface the mesh lies that shows its back, as a share of the size of its bounds.
_BEHIND = 1e-4


@dataclass
class Document:
    """A scene with its files; matrices (4, 4) are arrays."""

    scene: Json
    files: dict[Path, bytes]


def document_of(
    scene: Scene,
    camera: Camera,
    size: tuple[int, int],
    samples: int,
    max_depth: int | None,
    target: Path,
    left_out: LeftOut,
) -> Document:
    """Return the Mitsuba scene of a scene; its files are named after `target`."""
    return _Writer(scene, target, left_out).document(camera, size, samples, max_depth)


class _Writer:
    def __init__(self, scene: Scene, target: Path, left_out: LeftOut) -> None:
        self.scene = scene
        self.left_out = left_out
        self.files = Files(target)
        self.ids = frozenset(node.id for node in scene.nodes)
        self.nodes = [n for n in shown_nodes(scene) if n.material is not None]
        kinds = [_lit(node.material) for node in self.nodes]
        self.is_lit = any(kind is not None for kind in kinds)
        self.has_phong = PhongMaterial in kinds
        # A PhongMaterial counts a light as radiance: it reflects pi times as much as a matt surface of this colour.
        self.brighter = self.has_phong and StandardMaterial not in kinds
        self.materials = Materials(self.files, left_out, 1.0 if self.brighter else math.pi)
        self.bsdfs: dict[str, str] = {}
        self.entries: Json = {}
        self.shapes: Json = {}
        self.has_lamps = False
        self.has_media = False
        self.has_holes = False

    def document(
        self, camera: Camera, size: tuple[int, int], samples: int, max_depth: int | None
    ) -> Document:
        for node in self.nodes:
            self._add_node(node)
        self._tell_scene()
        emitters, hidden = self._emitters()
        integrator: Json = {
            "type": "volpath" if self.has_media else "path",
            "max_depth": -1 if max_depth is None else max_depth,
            "hide_emitters": hidden,
        }
        made = {
            "type": "scene",
            "integrator": integrator,
            "sensor": sensor_of(camera, size, samples, self.left_out),
            **emitters,
            **self.entries,
            **self.shapes,
        }
        return Document(made, self.files.contents)

    def _add_node(self, node: Node) -> None:
        material = node.material
        assert material is not None
        name = _name(node)
        surface = surface_of(node, self.ids)
        if not len(surface.triangles):
            return
        self._tell_node(node, material, surface, name)
        look = self.materials.look(surface, material, name)
        label = f"node-{node.id}"
        self.shapes[label] = self._shape(look, look.surface, material)
        if look.both_sides:
            extent = float(np.linalg.norm(np.ptp(surface.positions, axis=0)))
            back = look.surface.behind(_BEHIND * extent)
            self.shapes[f"{label}-back"] = self._shape(look, back, material)

    def _shape(self, look: Look, surface: Surface, material: Material) -> Json:
        flat = bool(material.flat_shading)
        shape: Json = {
            "type": "ply",
            "filename": self.files.add(ply(surface, look.uvs, look.colors, not flat), ".ply"),
            # v counts from the bottom of a picture here, and from its top in Mitsuba.
            "flip_tex_coords": True,
            "face_normals": flat,
            "bsdf": {"type": "ref", "id": self._bsdf(look.bsdf)},
        }
        self.has_holes = self.has_holes or look.bsdf["type"] == "mask"
        if look.radiance is not None:
            shape["emitter"] = {"type": "area", "radiance": look.radiance}
            self.has_lamps = True
        if look.inside is not None:
            shape["interior"] = look.inside
            self.has_media = True
        return shape

    def _bsdf(self, bsdf: Json) -> str:
        """Return the id of a BSDF, which equal materials share."""
        key = json.dumps(bsdf, sort_keys=True)
        if key not in self.bsdfs:
            self.bsdfs[key] = f"material-{len(self.bsdfs)}"
            self.entries[self.bsdfs[key]] = bsdf
        return self.bsdfs[key]

    def _emitters(self) -> tuple[Json, bool]:
        """Return the emitters, and whether a camera that meets nothing sees none of them."""
        bounds = np.asarray(self.scene.bounds)
        center = bounds.mean(axis=0) if np.isfinite(bounds).all() else np.zeros(3)
        lamps = Lamps(self.files, self.left_out, math.pi if self.brighter else 1.0, center)
        made: Json = {}
        if self.is_lit:
            for index, light in enumerate(self.scene.lights):
                emitter = lamps.emitter(light, f"light {index}")
                if emitter is not None:
                    made[f"light-{index}"] = emitter
        around, shown = self._around()
        if around is not None:
            made["environment"] = around
        if around is None and self.has_holes:
            # Mitsuba drops what a ray met before it left an empty scene.
            made["environment"] = darkness()
        if shown or around is None:
            return made, False
        if self.has_lamps:
            # hide_emitters would hide them as well.
            self.left_out.add("the light from all around is seen in place of the background")
            return made, False
        if self.has_holes:
            self.left_out.add(
                "translucent surfaces are not seen where only the background lies behind them"
            )
        return made, True

    def _around(self) -> tuple[Json | None, bool]:
        """Return the emitter of the light from all around, and whether it is what the background shows."""
        scene, background = self.scene, self.scene.background
        ambient = ambient_of(scene)
        if not self.is_lit:
            ambient = np.zeros(3)
        elif self.has_phong:
            if scene.environment is not None:
                self.left_out.add("the environment lights a PhongMaterial, too")
            if ambient.any():
                self.left_out.add(
                    "ambient light, of which a PhongMaterial shows the share ka, lights it whole"
                )
        turn, factor = np.asarray(scene.environment_rotation), scene.environment_intensity
        if scene.environment is not None and (self.is_lit or background is None):
            emitter = sky(scene.environment, turn, factor, ambient, self.files)
            return emitter, background is None and not ambient.any()
        if ambient.any():
            return even(ambient), False
        own: Json | None = None
        if isinstance(background, CubeMap):
            own = sky(background, np.array([1.0, 0, 0, 0]), 1.0, np.zeros(3), self.files)
        elif background is not None and np.any(np.asarray(background)[:3]):
            own = even(np.asarray(background, float)[:3])
        if own is not None and self.is_lit:
            self.left_out.add(
                "the background is left out, since in Mitsuba it would light the scene"
            )
            return None, False
        return own, own is not None

    def _tell_node(self, node: Node, material: Material, surface: Surface, name: str) -> None:
        tell = self.left_out.add
        if isinstance(node.environment, CubeMap) and not isinstance(
            material, (BasicMaterial, PhongMaterial)
        ):
            tell("a Mitsuba scene has one environment: that of a node is left out", name)
        if not node.in_captures:
            tell("in_captures=False is left out: rays meet every node", name)
        if (
            self.is_lit
            and self.scene.lights
            and not (holds(node, "cast_shadow") and node.receive_shadow)
        ):
            tell("cast_shadow=False and receive_shadow=False are left out", name)
        passes = isinstance(material, GlassMaterial) or (
            isinstance(material, StandardMaterial) and material.transmission > 0
        )
        if not material.double_sided and not passes and not surface.is_closed():
            tell("surfaces that are not double-sided are black from behind, not invisible", name)

    def _tell_scene(self) -> None:
        if self.has_phong and not self.brighter:
            self.left_out.add(
                "a PhongMaterial beside other materials reflects pi times its colour, more than it receives"
            )
        if self.has_lamps and self.is_lit:
            self.left_out.add("surfaces that show a colour of their own light other surfaces")


def _name(node: Node) -> str:
    return repr(node.name) if node.name else f"node {node.id}"


def _lit(material: Material | None) -> type[Material] | None:
    """Return the kind of a material that shows light from elsewhere; None for one that does not."""
    if isinstance(material, BasicMaterial) or (
        isinstance(material, StandardMaterial) and material.unlit
    ):
        return None
    for kind in (PhongMaterial, StandardMaterial, MirrorMaterial, GlassMaterial):
        if isinstance(material, kind):
            return kind
    return Material
