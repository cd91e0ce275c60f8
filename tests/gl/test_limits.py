"""Sizes beyond GL's limits, arguments that are no camera or scene, singular placements."""

import re
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.helpers import run_python

CAMERA: dict[str, Any] = {"fov": 50, "position": (0, 0, 3), "target": (0, 0, 0)}


def test_captures_over_the_limit_name_it(renderer):
    limit = renderer.info.limits.max_cube_map_texture_size
    drawn = renderer.info.limits.max_face_size
    with pytest.raises(ValueError, match=f"expected 1 to {drawn} pixels"):
        renderer.capture(cc.Scene(), size=drawn + 1)
    with pytest.raises(ValueError, match=r"expected 1 to \d+ pixels \(GL_MAX_\w+ of ") as refused:
        renderer.capture(cc.Scene(), size=limit + 1)
    largest, name = re.findall(r"to (\d+) pixels \(GL_MAX_(\w+)", str(refused.value))[0]
    if name == "CUBE_MAP_TEXTURE_SIZE":
        assert int(largest) == limit
    else:  # zink draws into smaller pictures than it can look up
        assert name in ("FRAMEBUFFER_WIDTH", "FRAMEBUFFER_HEIGHT")
        assert int(largest) < limit
    with pytest.raises(ValueError, match=r"\d"):
        renderer.capture(cc.Scene(), size=2**40)


def test_frames_over_the_limit_name_it(renderer):
    limit = renderer.info.limits.max_texture_size
    camera = cc.PerspectiveCamera(**CAMERA)
    for size in ((limit + 1, 1), (1, limit + 1)):
        with pytest.raises(ValueError, match=str(limit)):
            renderer.render(cc.Scene(), camera, size)
    with pytest.raises(ValueError, match="expected"):
        renderer.render(cc.Scene(), camera, (2**40, 2))


@pytest.mark.parametrize(
    ("size", "error"),
    [(0, ValueError), (-1, ValueError), (2.5, TypeError), ("8", TypeError), ((8, 8), TypeError)],
)
def test_bad_capture_sizes(renderer, size, error):
    with pytest.raises(error):
        renderer.capture(cc.Scene(), size=size)


@pytest.mark.parametrize(
    ("size", "error"),
    [
        ((0, 8), ValueError),
        ((8, -1), ValueError),
        ((8,), (TypeError, ValueError)),
        ((8, 8, 8), (TypeError, ValueError)),
        (8, TypeError),
        ((8.5, 8), TypeError),
        ("88", TypeError),
    ],
)
def test_bad_frame_sizes(renderer, size, error):
    with pytest.raises(error):
        renderer.render(cc.Scene(), cc.PerspectiveCamera(**CAMERA), size)


BAD_CAPTURES = {
    "near = far": ({"near": 2, "far": 2}, ValueError, "near"),
    "near > far": ({"near": 3, "far": 2}, ValueError, "near"),
    "near 0": ({"near": 0}, ValueError, "near"),
    "near negative": ({"near": -1}, ValueError, "near"),
    "near nan": ({"near": np.nan}, ValueError, "near"),
    "far inf": ({"far": np.inf}, ValueError, "far"),
    "position nan": ({"position": (0, 0, np.nan)}, ValueError, "position"),
    "position of 2": ({"position": (0, 0)}, ValueError, "position"),
    "position text": ({"position": "origin"}, TypeError, "position"),
    "eye inf": ({"eye": (np.inf, 0, 0)}, ValueError, "eye"),
    "eye of 4": ({"eye": (0, 0, 0, 1)}, ValueError, "eye"),
}


@pytest.mark.parametrize(("options", "error", "text"), BAD_CAPTURES.values(), ids=BAD_CAPTURES)
def test_bad_capture_options(renderer, options, error, text):
    with pytest.raises(error, match=text):
        renderer.capture(cc.Scene(), size=4, **options)


@pytest.mark.parametrize("scene", [None, "scene", 3, cc.Scene])
def test_what_is_no_scene_or_camera(renderer, scene):
    with pytest.raises(TypeError):
        renderer.capture(scene, size=4)
    with pytest.raises(TypeError):
        renderer.render(cc.Scene(), scene, (4, 4))


@pytest.mark.parametrize("layered", ["yes", []])
def test_bad_renderer_options(layered):
    with pytest.raises(TypeError):
        cc.Renderer(layered=layered)
    with pytest.raises((ValueError, TypeError)):
        cc.Renderer(cache_bytes=-1)


def test_extreme_but_valid_scenes_draw(renderer):
    """Very large, very small and very far nodes give finite numbers."""
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(1), cc.PhongMaterial(), scale=1e6, position=(0, 0, -2e6))
    scene.add(cc.Mesh.box(1), cc.PhongMaterial(), scale=1e-6)
    scene.add(cc.Mesh.box(1e-3), cc.PhongMaterial(), position=(1e7, 1e7, -1e7))
    scene.add(cc.PointLight(position=(0, 0, 0), decay=2))
    cube = renderer.capture(scene, size=16, far=1e8, outputs=("distance",))
    assert np.isfinite(cube.faces).all()
    assert not np.isnan(cube.distance).any()


def test_empty_scenes_draw(renderer):
    assert not renderer.capture(cc.Scene(), size=4, outputs=("id",)).id.any()
    scene = cc.Scene()
    scene.add()
    scene.add(cc.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]))  # a triangle without area
    assert not renderer.capture(scene, size=4, outputs=("id",)).id.any()


def test_too_large_for_the_memory_is_an_error_not_a_crash():
    """With 6 GB of address space, targets of about 20 GB raise a Python exception, and the renderer still works."""
    run_python(
        """
        import resource, cubecam as cc
        renderer = cc.Renderer()
        renderer.capture(cc.Scene(), size=8)
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
        limit = renderer.info.limits.max_cube_map_texture_size
        try:
            renderer.capture(cc.Scene(), size=min(limit, 8192), samples=4, outputs=("position", "normal"))
        except (cc.Error, MemoryError, ValueError) as error:
            print(type(error).__name__, error)
        else:
            raise SystemExit("expected an error")
        assert renderer.capture(cc.Scene(), size=8).size == 8
        """,
        timeout=120,
    )
