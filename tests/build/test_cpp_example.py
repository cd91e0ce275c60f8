"""The C++ example is built and run without Python, and its faces are compared with those of Python."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.build.tools import ROOT, run, tool
from tests.compare import assert_close
from tests.helpers import DEVICE

pytestmark = pytest.mark.build


def read_pfm(path):
    """Read a (H, W, 3) float32 picture with row 0 on top; the file stores the rows from the bottom."""
    data = path.read_bytes()
    header = re.match(rb"(PF|Pf)\n(\d+) (\d+)\n(-?[\d.]+)\n", data)
    assert header, f"{path.name}: no PFM header in {data[:20]!r}"
    width, height = int(header[2]), int(header[3])
    channels = 3 if header[1] == b"PF" else 1
    assert float(header[4]) < 0, "expected little-endian numbers"
    pixels = np.frombuffer(data, "<f4", offset=header.end()).reshape(height, width, channels)
    return pixels[::-1]


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    folder = tmp_path_factory.mktemp("example")
    run(
        tool("cmake"), "-S", ROOT, "-B", folder / "build", "-G", "Ninja",
        f"-DCMAKE_MAKE_PROGRAM={tool('ninja')}", f"-DPython_EXECUTABLE={sys.executable}",
        "-DCUBECAM_BUILD_MODULE=OFF", "-DCUBECAM_BUILD_EXAMPLES=ON",
        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O0",
    )  # fmt: skip
    run(tool("cmake"), "--build", folder / "build", "-j", os.cpu_count() or 2)
    return folder / "build"


@pytest.fixture(scope="module")
def program(build):
    found = [
        path
        for path in build.rglob("*capture_example*")
        if path.is_file() and os.access(path, os.X_OK)
    ]
    assert len(found) == 1, found
    return found[0]


def scene_of_the_example():
    scene = cc.Scene(background=(0.4, 0.4, 0.4, 1))
    scene.add(cc.PointLight(position=(5, 5, 5)))
    scene.add(cc.Mesh.plane(10, 10), cc.PhongMaterial(color=(0.4, 0.4, 1)), position=(0, -2, 0))
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(color=(0.4, 1, 0.4)), position=(2, 0, 0.5))
    scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color=(1, 0.4, 0.4)), position=(-0.5, 0.25, -2))
    ball = scene.add(cc.Mesh.sphere(0.75), cc.MirrorMaterial(), position=(0, 0.5, 2.5))
    ball.environment = cc.Probe(position=(0, 0.5, 2.5))
    return scene


def test_the_core_has_no_python(build, program):
    linked = run("ldd", program).stdout
    for library in ("libpython", "libGL", "libEGL", "libX11"):
        assert library not in linked
    cache = (build / "CMakeCache.txt").read_text()
    assert "pybind11_DIR:PATH=/" not in cache
    for source in (ROOT / "cpp" / "cubecam").rglob("*.[ch]pp"):
        text = source.read_text()
        assert "pybind11" not in text, source
        assert "Python.h" not in text, source


def test_its_faces_are_those_of_python(program, tmp_path, renderer):
    run(program, tmp_path / "out", env={**os.environ, "CUBECAM_DEVICE": DEVICE})
    faces = np.stack([read_pfm(tmp_path / "out" / f"face_{face}.pfm") for face in range(6)])
    assert len(np.unique(faces.reshape(-1, 3), axis=0)) > 100
    want = renderer.capture(scene_of_the_example(), size=faces.shape[1]).faces[..., :3]
    # -O0 and -O3 may round differently, so matrices may differ in their last bits, and pictures in
    # single pixels at edges.
    same = np.abs(faces - want).max(-1) < 1e-4
    assert same.mean() > 0.999
    assert_close(faces, np.where(same[..., None], want, faces), "float32_maths")


def test_it_says_how_it_is_used(program, tmp_path):
    done = subprocess.run([program], capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert "usage" in (done.stdout + done.stderr).lower()
    blocked = tmp_path / "file"
    blocked.write_text("")
    done = subprocess.run([program, blocked / "below"], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr
