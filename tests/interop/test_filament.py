"""Filament, by the package filly, shows in each direction what the cubemap holds there.

CUBECAM_FILLY_PYTHON names an interpreter that has filly, this one if it is not set.
"""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import cubecam as cc
from tests.interop.directions import DIRECTIONS, sky, sky_cube

pytestmark = pytest.mark.interop

CODE = """
import json, sys
import filly
import numpy as np

path, directions = sys.argv[-2], json.loads(sys.argv[-1])
found = []
with filly.Renderer() as renderer:
    scene = renderer.create_scene()
    scene.environment = renderer.load_environment(path)
    scene.environment_visible, scene.environment_intensity = True, 1.2
    scene.tone_mapping, scene.encoding = "linear", "linear"
    target = renderer.create_render_target(width=8, height=8)
    for direction in directions:
        camera = renderer.create_camera()
        camera.set_perspective(fov_y_deg=5, aspect=1, near=0.1, far=100)
        camera.position, camera.exposure = [0, 0, 0], 0.0
        camera.look_at(direction, up=[0.31, 0.2, 0.93])
        scene.camera = camera
        renderer.render(scene, target)
        found.append((np.array(target.read())[3:5, 3:5, :3].mean((0, 1)) / 255).tolist())
print(json.dumps(found))
"""


def test_the_background(tmp_path):
    dark = cc.CubeMap(sky_cube().faces / 2)  # bytes end at 1
    dark.save_for("filament", tmp_path)
    python = os.environ.get("CUBECAM_FILLY_PYTHON", sys.executable)
    told = json.dumps(DIRECTIONS.tolist())
    command = [python, "-c", CODE, str(tmp_path / "environment.hdr"), told]
    done = subprocess.run(command, check=True, capture_output=True, text=True, timeout=120)
    # Filament writes remarks of its own before.
    found = np.array(json.loads(done.stdout[done.stdout.rindex("[[") :]))
    assert (
        np.abs(found - sky(DIRECTIONS) / 2).max() < 0.04
    )  # its own cubemap of the panorama is coarse at the poles
