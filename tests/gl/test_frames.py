"""Frames against the ray caster: perspective, orthographic and given matrices."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close
from tests.gl.world import (
    OUTPUTS,
    View,
    inner,
    inner_smooth,
    label_of,
    orthographic,
    perspective,
    room,
)
from tests.reference import transforms as ref
from tests.reference.raycast import interior

EYE, TARGET = (1.2, 0.9, -0.2), (-0.6, -0.1, 1.5)


def by_matrices(position, target, size=(48, 36)):
    """A camera with an oblique projection, which no camera class of cubecam makes."""
    view = ref.look_at(position, target, (0.2, 1, 0))
    projection = ref.perspective(55, size[0] / size[1], 0.1, 100)
    projection[0, 2], projection[1, 2] = 0.2, -0.1
    camera = cc.Camera(view=view, projection=projection)
    return View(camera, view, projection, size, 0.1, 100.0, np.asarray(position, float))


VIEWS = {
    "perspective": lambda: perspective(EYE, TARGET),
    "tall": lambda: perspective(EYE, TARGET, fov=75, size=(30, 50), up=(0.3, 1, 0.1)),
    "orthographic": lambda: orthographic(EYE, TARGET),
    "matrices": lambda: by_matrices(EYE, TARGET),
}


@pytest.fixture(scope="module", params=list(VIEWS.values()), ids=list(VIEWS))
def seen(request, shared_renderers):
    world, view = room(), request.param()
    frame = shared_renderers(None).render(
        world.scene, view.camera, view.size, outputs=OUTPUTS, format="rgba32f"
    )
    return frame, view.hits(world.shapes), world, view


def test_shapes(seen):
    frame, _, _, view = seen
    width, height = view.size
    assert frame.color.shape == (height, width, 4)
    assert tuple(frame.size) == (width, height)
    assert frame.distance.shape == frame.id.shape == (height, width)
    assert frame.normal.shape == frame.position.shape == (height, width, 3)


def test_enough_is_seen(seen):
    _, hits, _, _ = seen
    assert len(np.unique(hits.id)) >= 4


def test_id_and_color(seen):
    frame, hits, world, _ = seen
    mask = interior(hits.id)
    assert_close(frame.id, hits.id, "exact", mask=mask)
    assert_close(frame.label, label_of(hits.id), "exact", mask=mask)
    assert_close(frame.color, world.paint(hits), "float32_maths", mask=mask)


def test_position_and_normal(seen):
    frame, hits, _, _ = seen
    assert_close(frame.position, hits.position, "position", mask=interior(hits.id))
    mask = np.where(hits.id == 6, inner_smooth(hits), inner(hits))
    assert_close(frame.normal, hits.normal, "normal", mask=mask)


def test_z_is_along_the_cameras_axis(seen):
    frame, hits, _, _ = seen
    assert_close(frame.z, hits.t, "distance", mask=interior(hits.id))


def test_distance(seen):
    """Distance is the length of the ray; an orthographic ray starts on the near plane."""
    frame, hits, _, view = seen
    want = hits.t - view.near if view.projection[3, 3] == 1 else hits.distance
    assert_close(frame.distance, want, "distance", mask=interior(hits.id))


def test_row_0_is_on_top(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 1.5, 0))
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(0, 1, 0)), position=(1.5, 0, 0))
    camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 5), target=(0, 0, 0))
    color = renderer.render(scene, camera, (20, 20)).color
    red, green = np.argwhere(color[..., 0] == 255), np.argwhere(color[..., 1] == 255)
    assert red[:, 0].mean() < 8 < green[:, 0].mean() < 12
    assert green[:, 1].mean() > 12


def test_frames_are_the_callers_own(renderer):
    scene = room().scene
    view = perspective(EYE, TARGET)
    first = renderer.render(scene, view.camera, view.size, outputs=OUTPUTS)
    kept = first.color.copy()
    for name in ("color", *OUTPUTS):
        assert getattr(first, name).flags.writeable
        getattr(first, name)[:] = 7
    again = renderer.render(scene, view.camera, view.size)
    np.testing.assert_array_equal(again.color, kept)


def test_frame_is_a_picture_in_jupyter(renderer):
    view = perspective(EYE, TARGET)
    assert renderer.render(room().scene, view.camera, view.size)._repr_png_().startswith(b"\x89PNG")


def test_near_and_far_of_a_camera(renderer):
    world = room()
    view = perspective(EYE, TARGET, near=1.5, far=3.0)
    hits = view.hits(world.shapes)
    frame = renderer.render(world.scene, view.camera, view.size, outputs=("id",))
    assert_close(frame.id, hits.id, "exact", mask=interior(hits.id))


def test_a_moved_camera_draws_anew(renderer):
    """The same camera object is moved: the cache key holds its matrices, not its identity."""
    world = room()
    camera = cc.PerspectiveCamera(fov=60, position=EYE, target=TARGET)
    first = renderer.render(world.scene, camera, (24, 24)).color
    camera.position = (1.0, 0.7, -0.4)
    assert (renderer.render(world.scene, camera, (24, 24)).color != first).any()
    camera.position = EYE
    np.testing.assert_array_equal(renderer.render(world.scene, camera, (24, 24)).color, first)
