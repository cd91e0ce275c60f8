"""A driver that behaves as drivers behave that this machine does not have; fake_egl.cpp describes it."""

import ctypes
import os
import shutil
import subprocess
from pathlib import Path

from tests.helpers import run_python

SOURCE = Path(__file__).with_name("fake_egl.cpp")

#: What scripts begin with: `fake[name]` reads and sets a number of the stand-in.
PRELUDE = """
import os, warnings
import numpy as np
import cubecam as cc
from tests.gl.fakes import Numbers
from tests.gl.lost import warned

fake = Numbers()
scene = cc.Scene(environment=cc.CubeMap(np.random.default_rng(1).random((6, 8, 8, 3), dtype=np.float32)))
scene.add(cc.PointLight((1, 3, 2), shadow=cc.Shadow(size=32)))
scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), environment=cc.Probe(position=(0, 0, 0), size=16))
floor = scene.add(cc.Mesh.plane(4, 4), cc.PhongMaterial(), position=(0, -1, 0), label=3)
camera = cc.PerspectiveCamera(fov=60, position=(3, 2, 3), target=(0, 0, 0))
"""


class Numbers:
    """The numbers by which the stand-in is driven, in the process that has loaded it."""

    def __init__(self):
        library = ctypes.CDLL(os.environ["CUBECAM_EGL_LIBRARY"])
        library.fake_number.restype = ctypes.POINTER(ctypes.c_int)
        library.fake_number.argtypes = [ctypes.c_char_p]
        self._find = library.fake_number

    def __getitem__(self, name):
        """Return a number."""
        return self._find(name.encode())[0]

    def __setitem__(self, name, value):
        """Set a number."""
        self._find(name.encode())[0] = value


def build_fake(folder):
    """Compile the stand-in into a folder; return the path of the library."""
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++")
    assert compiler, "expected a C++ compiler, as for the build of cubecam"
    made = Path(folder) / "libfake_egl.so"
    flags = ["-std=c++17", "-shared", "-fPIC", str(SOURCE), "-o", str(made), "-ldl"]
    command = [*compiler.split(), *flags]
    # The compiler does not start with a sanitizer's library.
    environment = {key: value for key, value in os.environ.items() if key != "LD_PRELOAD"}
    subprocess.run(command, check=True, timeout=120, env=environment)
    return made


def run_fake(library, script, **options):
    """Run a script with the stand-in for EGL."""
    return run_python(PRELUDE + script, CUBECAM_EGL_LIBRARY=str(library), **options)
