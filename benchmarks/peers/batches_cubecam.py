"""Cubemaps of a field in cubecam: all of a frame in one call, or a call for each."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import cubecam as cc

from .. import field


def make_scene(plan: field.Field, levels: bool = False) -> cc.Scene:
    """The field as a scene; `levels`: its meshes have levels of detail."""
    found = cc.Scene(background=field.CLEAR)
    if not plan.nodes:
        return found
    share = 1.0 / plan.lights
    for x, y, z, is_place in plan.light_places:
        if is_place:
            found.add(cc.PointLight(position=(x, y, z), intensity=share))
        else:
            found.add(cc.DirectionalLight((-x, -y, -z), intensity=share))

    def material(color: Any) -> cc.PhongMaterial:
        return cc.PhongMaterial(
            color=tuple(color), ka=field.KA, kd=field.KD, ks=field.KS, shininess=field.SHININESS
        )

    ground, mesh = (
        cc.Mesh(arrays.positions, arrays.indices, normals=arrays.normals)
        for arrays in (plan.ground, plan.mesh)
    )
    if levels:
        ground, mesh = ground.with_levels(), mesh.with_levels()
    found.add(ground, material(field.GROUND_COLOR))
    materials = [material(color) for color in plan.palette]
    for number, (place, turn) in enumerate(zip(plan.places, plan.turns, strict=True)):
        quaternion = (np.cos(turn / 2), 0.0, np.sin(turn / 2), 0.0)
        found.add(mesh, materials[number % plan.colors], position=place, rotation=quaternion)
    return found


class _Field:
    """A field, and how it is captured.

    `memory`: "recycled": results are freed at once, for the next; "fresh": they are kept until the end.
    `max_lod_error` is that of the captures, in pixels.
    """

    def __init__(
        self, memory: str = "recycled", max_lod_error: float = 0.0, **options: Any
    ) -> None:
        self.plan = field.Field.of(options)
        self.scene = make_scene(self.plan, max_lod_error > 0)
        self.renderer = cc.Renderer()
        self.kept: list[Any] | None = [] if memory == "fresh" else None
        if self.kept is None:
            field.keep_freed_memory()
        self.options: dict[str, Any] = {
            "size": self.plan.size,
            "outputs": self.plan.outputs,
            "near": field.NEAR,
            "far": field.FAR,
            "format": self.plan.format,
            "samples": self.plan.samples,
            "max_lod_error": max_lod_error,
        }

    def prepare(self, index: int) -> None:
        self.positions = self.plan.positions(index)

    def keep(self, found: Any) -> None:
        """Hold a result until the end, if the next one shall have fresh memory."""
        if self.kept is not None:
            self.kept.append(found)


class Batch(_Field):
    """One call for all cubemaps of a frame."""

    def draw(self, index: int) -> cc.CubeMapBatch:
        batch = self.renderer.capture_many(
            self.scene, self.positions, progress=False, **self.options
        )
        self.keep(batch)
        return batch

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """The colours as "faces", and the outputs by their names."""
        self.prepare(index)
        batch = self.draw(index)
        return {"faces": batch.faces, **batch.outputs}


class Single(_Field):
    """A call for each cubemap."""

    def draw(self, index: int) -> cc.CubeMap:
        capture, scene, options = self.renderer.capture, self.scene, self.options
        for place in self.positions:
            last = capture(scene, place, **options)
            self.keep(last)
        return last

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """The colours as "faces", and the outputs by their names."""
        cubes = [
            self.renderer.capture(self.scene, at, **self.options)
            for at in self.plan.positions(index)
        ]
        found = {"faces": np.stack([cube.faces for cube in cubes])}
        for name in self.plan.outputs:
            found[name] = np.stack([getattr(cube, name) for cube in cubes])
        return found


class Scenes:
    """The memory of the process while `capture_scenes` draws many small scenes."""

    def memory(self, count: int, at: list[int]) -> list[float]:
        """MiB of the process without the results' own bytes, when as many scenes as `at` says are captured."""
        found: list[float] = []
        box = cc.Mesh.box(1)
        bytes_of_one = 6 * 2 * 2 * 4 * 4

        def make_scene(number: int) -> cc.Scene:
            if number in at:
                found.append((_resident() - number * bytes_of_one) / 2**20)
            scene = cc.Scene(background=(0, 0, number / count))
            scene.add(cc.PointLight(position=(1, 2, 3)))
            material = cc.PhongMaterial(color=(number / count, 0.5, 0.2))
            scene.add(box, material, position=(0, 0, -2 - number / count))
            # A mesh that only this scene has, too.
            scene.add(cc.Mesh.sphere(1, segments=8, rings=6), material, position=(3, 0, 0))
            return scene

        cc.capture_scenes(make_scene, count, size=2, progress=False)
        return found


def _resident() -> int:
    """Bytes of the process's memory that are in RAM."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) * 1024
    raise OSError("expected a line VmRSS in /proc/self/status, found none")
