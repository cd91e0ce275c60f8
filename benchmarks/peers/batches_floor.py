"""Cubemaps of a field, drawn by a loop in C++ that calls OpenGL. The first use compiles it."""

from __future__ import annotations

import ctypes
import hashlib
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from .. import field, scene
from ..processes import ROOT
from .batches_moderngl import FRAGMENT, OUTPUTS, declared, model_matrix
from .moderngl_frame import ONE_NODE

SOURCE = Path(__file__).with_suffix(".cpp")


class _Mesh(ctypes.Structure):
    _fields_ = (
        ("vertices", ctypes.c_void_p),
        ("vertex_count", ctypes.c_int32),
        ("indices", ctypes.c_void_p),
        ("index_count", ctypes.c_int32),
    )


class _Plan(ctypes.Structure):
    _fields_ = (
        ("vertex_source", ctypes.c_char_p),
        ("fragment_source", ctypes.c_char_p),
        ("size", ctypes.c_int32),
        ("samples", ctypes.c_int32),
        ("float_colors", ctypes.c_int32),
        ("output_count", ctypes.c_int32),
        ("channels", ctypes.c_void_p),
        ("clears", ctypes.c_void_p),
        ("mesh", _Mesh),
        ("ground", _Mesh),
        ("nodes", ctypes.c_int32),
        ("models", ctypes.c_void_p),
        ("colors", ctypes.c_void_p),
        ("places", ctypes.c_void_p),
        ("reach", ctypes.c_double),
        ("lights", ctypes.c_void_p),
        ("light_count", ctypes.c_int32),
        ("weights", ctypes.c_void_p),
        ("turned", ctypes.c_void_p),
        ("forwards", ctypes.c_void_p),
    )


def library() -> ctypes.CDLL:
    """The compiled source, which is kept in build/ until the source changes."""
    source = SOURCE.read_bytes()
    made = ROOT / "build" / "floor" / f"{hashlib.sha256(source).hexdigest()[:16]}.so"
    if not made.exists():
        made.parent.mkdir(parents=True, exist_ok=True)
        compiler = shutil.which("c++") or shutil.which("g++") or "c++"
        with tempfile.TemporaryDirectory(dir=made.parent) as folder:
            glad = [sys.executable, "-m", "glad", "--quiet", "--reproducible", "--out-path", folder]
            apis = ["--api", "gl:core=4.5,egl=1.5", "--extensions", "EGL_MESA_platform_surfaceless"]
            subprocess.run([*glad, *apis, "c", "--loader"], check=True)
            built = Path(folder, "floor.so")
            sources = [str(SOURCE), *map(str, Path(folder, "src").glob("*.c"))]
            options = ["-O2", "-shared", "-fPIC", f"-I{folder}/include"]
            subprocess.run([compiler, *options, *sources, "-ldl", "-o", str(built)], check=True)
            built.replace(made)
    found = ctypes.CDLL(str(made))
    found.floor_make.restype = ctypes.c_void_p
    found.floor_draw.argtypes = (
        ctypes.c_void_p,
        ctypes.c_int32,
        ctypes.c_void_p,
        ctypes.c_void_p,
    )
    return found


class Loop:
    """The field in one OpenGL context; a call of C++ draws a frame."""

    def __init__(self, **options: Any) -> None:
        self.plan = plan = field.Field.of(options)
        field.keep_freed_memory()
        self.library = library()
        self.kept: list[np.ndarray] = []
        projection = scene.perspective(90, 1, field.NEAR, field.FAR)
        turned = [
            (projection @ scene.look_at((0, 0, 0), forward, up)).T
            for forward, up in zip(scene.FACE_FORWARD, scene.FACE_UP, strict=True)
        ]
        models = [
            model_matrix(place, turn).T for place, turn in zip(plan.places, plan.turns, strict=True)
        ]
        colors = [plan.palette[i % plan.colors] for i in range(plan.nodes)]
        channels = [3 if OUTPUTS[name][1] == 3 else 1 for name in plan.outputs]
        clears = [field.CLEAR, *([OUTPUTS[name][3]] * 4 for name in plan.outputs)]
        weights = (field.KA, field.KD, field.KS, field.SHININESS)
        self.described = _Plan(
            vertex_source=ONE_NODE.lstrip().encode(),
            fragment_source=declared(FRAGMENT, plan).lstrip().encode(),
            size=plan.size,
            samples=plan.samples,
            float_colors=plan.format == "rgba32f",
            output_count=len(plan.outputs),
            channels=self._array(channels, np.int32),
            clears=self._array(clears, np.float32),
            mesh=self._mesh(plan.mesh),
            ground=self._mesh(plan.ground),
            nodes=plan.nodes,
            models=self._array(models, np.float32),
            colors=self._array([*colors, field.GROUND_COLOR], np.float32),
            places=self._array(plan.places, np.float64),
            reach=plan.radius * np.sqrt(2),
            lights=self._array(plan.light_places, np.float32),
            light_count=plan.lights,
            weights=self._array(weights, np.float32),
            turned=self._array(turned, np.float64),
            forwards=self._array(scene.FACE_FORWARD, np.float64),
        )
        self.made = self.library.floor_make(ctypes.byref(self.described))
        if not self.made:
            raise RuntimeError("the loop in C++ did not begin; its reason is in its output")

    def _array(self, values: Any, dtype: Any) -> int:
        """The address of an array that is kept."""
        self.kept.append(np.ascontiguousarray(values, dtype))
        return self.kept[-1].ctypes.data

    def _mesh(self, mesh: scene.MeshArrays) -> _Mesh:
        return _Mesh(
            vertices=self._array(mesh.interleaved, np.float32),
            vertex_count=len(mesh.positions),
            indices=self._array(mesh.indices, np.uint32),
            index_count=3 * len(mesh.indices),
        )

    def prepare(self, index: int) -> None:
        self.positions = np.ascontiguousarray(self.plan.positions(index))

    def draw(self, index: int) -> dict[str, np.ndarray]:
        """(probes, 6, N, N, ...) arrays: "faces" and the outputs."""
        count = len(self.positions)
        found = self.plan.results(count)
        results = (ctypes.c_void_p * len(found))(*(array.ctypes.data for array in found.values()))
        if not self.library.floor_draw(self.made, count, self.positions.ctypes.data, results):
            raise RuntimeError("the loop in C++ failed; its reason is in its output")
        return found

    def arrays(self, index: int) -> dict[str, np.ndarray]:
        """As `draw`."""
        self.prepare(index)
        return self.draw(index)
