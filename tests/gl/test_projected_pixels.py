"""K @ world_to_camera_cv takes the world position of each pixel to the middle of the pixel."""

import numpy as np
import pytest

import cubecam as cc
from tests.gl.world import room

SIZE = (61, 43)
K = [[50.0, 0.0, 33.7], [0.0, 56.0, 18.2], [0.0, 0.0, 1.0]]
CAMERAS = {
    "plain": cc.PerspectiveCamera(fov=70, position=(0.2, 0.1, -0.1), target=(2, 0.2, 1)),
    "shifted": cc.PerspectiveCamera(fov=90, target=(-1, -0.3, 0.2), shift=(0.3, -0.2)),
    "calibrated": cc.PerspectiveCamera.from_intrinsics(K, SIZE, target=(0.3, 0.4, -1)),
    "matrices": cc.Camera(
        view=cc.PerspectiveCamera(target=(1, 1, 1)).view,
        projection=cc.PerspectiveCamera(fov=50, pixel_aspect=0.8).projection(61 / 43),
    ),
}


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS)
def test_positions_land_on_the_middle_of_their_pixels(renderer, camera):
    frame = renderer.render(room().scene, camera, SIZE, outputs=("position",))
    rows, columns = np.nonzero(np.isfinite(frame.position).all(axis=-1))
    assert len(rows) > 800
    points = np.c_[frame.position[rows, columns].astype(float), np.ones(len(rows))]
    seen = camera.intrinsics(SIZE) @ camera.world_to_camera_cv[:3] @ points.T
    want = np.stack([columns + 0.5, rows + 0.5])
    # float32 positions a few units away, seen through a lens of about 50 pixels: 1e-6 * 50.
    np.testing.assert_allclose(seen[:2] / seen[2], want, atol=1e-3)
