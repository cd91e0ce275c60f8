"""Blender, as the Python module bpy, sees in each direction of its world what the cubemap holds there.

bpy needs the very Python that it was built for, so it may live in an environment of its own: CUBECAM_BPY_PYTHON names
the interpreter. `make test-interop` makes that environment.
"""

import json
import os
import subprocess

import numpy as np
import pytest

import cubecam as cc
from tests.interop.directions import DIRECTIONS, sky, sky_cube

pytestmark = pytest.mark.interop

CODE = """
import json, sys
import bpy
from mathutils import Vector

folder, directions = sys.argv[-2], json.loads(sys.argv[-1])
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.world = bpy.data.worlds.new("World")
scene.world.use_nodes = True
tree = scene.world.node_tree
node = tree.nodes.new("ShaderNodeTexEnvironment")
node.image = bpy.data.images.load(folder + "/environment.exr")
tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
scene.render.resolution_x = scene.render.resolution_y = 4
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
lens = bpy.data.cameras.new("camera")
lens.angle = 0.02
camera = bpy.data.objects.new("camera", lens)
scene.collection.objects.link(camera)
scene.camera = camera
for number, (x, y, z) in enumerate(directions):  # Blender's glTF importer turns y up to z up
    camera.rotation_euler = Vector((x, -z, y)).to_track_quat("-Z", "Y").to_euler()
    scene.render.filepath = f"{folder}/{number}.exr"
    bpy.ops.render.render(write_still=True)
"""


def test_the_world(tmp_path):
    python = os.environ.get("CUBECAM_BPY_PYTHON", "")
    assert python, "expected CUBECAM_BPY_PYTHON, a Python with bpy; make test-interop sets it"
    sky_cube().save_for("blender", tmp_path)
    # At a pole, Blender mixes the first row of a panorama with the last one.
    directions = DIRECTIONS.copy()
    directions[2:4] += [0.05, 0, 0.03]
    script = tmp_path / "look.py"
    script.write_text(CODE, encoding="utf-8")
    subprocess.run(
        [python, script, tmp_path, json.dumps(directions.tolist())], check=True, capture_output=True, timeout=300
    )  # fmt: skip
    found = [cc.load_image(tmp_path / f"{n}.exr")[2, 2, :3] for n in range(len(directions))]
    assert np.abs(np.array(found) - sky(directions)).max() < 0.02
