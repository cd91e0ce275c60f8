"""Layered drawing and one pass for each view give equal bytes, for all kinds of scenes.

llvmpipe gives equal bytes; other drivers may compile the two vertex shaders to other arithmetic.
"""

import os

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS, everything, perspective
from tests.helpers import run_python


@pytest.fixture(scope="module")
def scene():
    return everything()


@pytest.fixture
def both(new_renderer):
    layered, one_pass = new_renderer(layered=True), new_renderer(layered=False)
    assert one_pass.info.layered is False
    return layered, one_pass


def same(a, b, names):
    for name in names:
        assert_identical(getattr(a, name), getattr(b, name), name, across="programs")


@pytest.mark.llvmpipe("other drivers may lack GL_ARB_shader_viewport_layer_array")
def test_the_device_draws_layers_in_one_pass(renderer):
    taken = "-GL_ARB_shader_viewport_layer_array" in os.environ.get("MESA_EXTENSION_OVERRIDE", "")
    assert renderer.info.layered is not taken


WITHOUT_LAYERS = """
import sys
import cubecam as cc, numpy as np
from tests.gl.world import OUTPUTS, everything
from tests.helpers import DEVICE

with cc.Renderer(device=DEVICE) as renderer:
    assert renderer.info.layered is False
    cube = renderer.capture(everything(), size=24, format="rgba32f", outputs=OUTPUTS)
    assert renderer.stats.views_drawn >= 6
try:
    cc.Renderer(device=DEVICE, layered=True)
except ValueError as error:
    assert "lacks GL_ARB_shader_viewport_layer_array" in str(error)
else:
    raise SystemExit("expected a ValueError")
np.savez(sys.argv[1], faces=cube.faces, **{name: getattr(cube, name) for name in OUTPUTS})
"""


@pytest.mark.llvmpipe("Mesa alone takes an extension away")
def test_a_driver_without_layers_draws_the_same(renderer, scene, tmp_path):
    """Mesa without GL_ARB_shader_viewport_layer_array: the same bytes, and a clear error for layered=True."""
    path = tmp_path / "cube.npz"
    run_python(
        WITHOUT_LAYERS.replace("sys.argv[1]", repr(str(path))),
        MESA_EXTENSION_OVERRIDE="-GL_ARB_shader_viewport_layer_array",
    )
    want = renderer.capture(scene, size=24, format="rgba32f", outputs=OUTPUTS)
    with np.load(path) as got:
        for name in ("faces", *OUTPUTS):
            assert_identical(got[name], getattr(want, name), name, across="programs")


@pytest.mark.parametrize("fmt", ["rgba8", "rgba16f", "rgba32f"])
def test_captures(both, scene, fmt):
    cubes = [r.capture(scene, size=24, format=fmt, outputs=OUTPUTS) for r in both]
    same(cubes[0], cubes[1], ("faces", *OUTPUTS))


@pytest.mark.parametrize("samples", [2, 4])
def test_multisampled_captures(both, scene, samples):
    cubes = [r.capture(scene, size=16, samples=samples, outputs=OUTPUTS) for r in both]
    same(cubes[0], cubes[1], ("faces", *OUTPUTS))


def test_frames_with_a_probe(both, scene):
    view = perspective((2, 1.5, 3), (0, 0, 0))
    frames = [
        r.render(scene, view.camera, view.size, format="rgba32f", outputs=OUTPUTS) for r in both
    ]
    same(frames[0], frames[1], ("color", *OUTPUTS))
    probe = scene.nodes[-1].environment
    cubes = [r.read_probe(probe) for r in both]
    same(cubes[0], cubes[1], ("faces",))


def test_layered_true_is_the_same_as_auto(new_renderer, both, scene):
    forced = new_renderer(layered=True)
    assert forced.info.layered is True
    assert_identical(forced.capture(scene, size=8).faces, both[0].capture(scene, size=8).faces)


def test_one_pass_draws_a_mesh_once_per_view_layered_once_in_all(both):
    """The layered path draws a mesh with one instanced draw for all the views that see it."""
    scene = cc.Scene()
    scene.add(cc.Mesh.box(5), cc.BasicMaterial(double_sided=True))
    calls = []
    for renderer in both:
        renderer.capture(scene, size=8)
        calls.append(renderer.stats.draw_calls)
    assert calls[0] < calls[1]
    assert calls[1] - calls[0] >= 5


def test_same_input_same_bytes(new_renderer, scene):
    """Every renderer and every run gives the same bytes."""
    assert_identical(
        new_renderer().capture(scene, size=16).faces, new_renderer().capture(scene, size=16).faces
    )
