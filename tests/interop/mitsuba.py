"""Mitsuba 3 in a process of its own, since Mitsuba and Mesa may load two versions of LLVM.

CUBECAM_MITSUBA_PYTHON names an interpreter that has Mitsuba, this one if it is not set. The variant ``scalar_rgb``
needs no LLVM.
"""

import os
import pickle
import subprocess
import sys

import numpy as np

import cubecam as cc

PYTHON = os.environ.get("CUBECAM_MITSUBA_PYTHON", sys.executable)
#: Renders each scene of a pickled list, which are dicts or names of XML files.
PROGRAM = """
import pickle, sys
import mitsuba as mi, numpy as np
mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)
def ready(value):
    if isinstance(value, dict):
        return {key: ready(part) for key, part in value.items()}
    return mi.ScalarTransform4f(value) if isinstance(value, np.ndarray) else value
with open(sys.argv[1], "rb") as file:
    scenes = pickle.load(file)
made = [mi.load_file(s) if isinstance(s, str) else mi.load_dict(ready(s)) for s in scenes]
np.savez(sys.argv[2], *[np.array(mi.render(scene, seed=7)) for scene in made])
"""


def rendered(folder, scenes):
    """Render dicts and XML files; the pictures are (H, W, 4) RGBA."""
    source, result = folder / "scenes.pickle", folder / "pictures.npz"
    source.write_bytes(pickle.dumps([s if isinstance(s, dict) else str(s) for s in scenes]))
    done = subprocess.run(
        [PYTHON, "-c", PROGRAM, source, result], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, (done.returncode, done.stderr[-2000:])
    with np.load(result) as pictures:
        return [pictures[name] for name in pictures.files]


def cube_of_place(size=64):
    """A smooth environment whose colour is another one in each direction."""
    at = (np.arange(size) + 0.5) / size * 2 - 1
    t, s = np.meshgrid(at, at, indexing="ij")
    one = np.ones_like(s)
    faces = [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one)]
    way = np.array(faces).transpose(0, 2, 3, 1)
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    return cc.CubeMap((0.6 + 0.5 * way + 0.3 * way[..., [1, 2, 0]] ** 3).astype(np.float32))
