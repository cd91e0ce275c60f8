"""The twelve edges of captured cubes: neighbours meet."""

import numpy as np
import pytest

import cubecam as cc
from tests.gl.world import phong_lights, smooth_environment
from tests.reference.cube_faces import direction_to_face_uv, face_uv_to_direction
from tests.reference.sampling import pad_faces


def edge_steps(faces):
    """The largest step over any edge, and the largest between neighbours inside faces, for an array (6, N, N, C)."""
    padded = pad_faces(faces)
    over = max(
        np.abs(padded[:, 1:-1, 0] - padded[:, 1:-1, 1]).max(),
        np.abs(padded[:, 1:-1, -1] - padded[:, 1:-1, -2]).max(),
        np.abs(padded[:, 0, 1:-1] - padded[:, 1, 1:-1]).max(),
        np.abs(padded[:, -1, 1:-1] - padded[:, -2, 1:-1]).max(),
    )
    inside = max(np.abs(np.diff(faces, axis=1)).max(), np.abs(np.diff(faces, axis=2)).max())
    return over, inside


def smooth_scene():
    """The inside of a big lit sphere: its picture has only smooth slopes."""
    scene = cc.Scene()
    scene.add(cc.Mesh.sphere(5), cc.PhongMaterial(color=(0.7, 0.5, 0.3), double_sided=True))
    for light in phong_lights()[0]:
        scene.add(light)
    return scene


@pytest.mark.parametrize("samples", [1, 4])
def test_a_lit_shell_is_continuous_over_the_edges(any_path, samples):
    cube = any_path.capture(smooth_scene(), position=(0.3, -0.2, 0.4), size=48, samples=samples)
    over, inside = edge_steps(cube.faces.astype(float))
    assert inside < 0.12
    assert over < 1.2 * inside


def test_distance_is_continuous_and_z_is_not(renderer):
    """z has a kink at each edge, but the same value on both sides only by symmetry; distance is one function."""
    cube = renderer.capture(
        smooth_scene(),
        position=(0.9, -0.6, 1.2),
        size=48,
        outputs=("distance", "z", "position", "normal"),
    )
    for name in ("distance", "position", "normal"):
        values = getattr(cube, name)
        over, inside = edge_steps(values.reshape(*values.shape[:3], -1).astype(float))
        assert over < 1.5 * inside, name


def test_translucent_and_mirrored_things_are_continuous(renderer):
    scene = smooth_scene()
    scene.environment = cc.CubeMap(smooth_environment(32))
    scene.add(
        cc.Mesh.sphere(2), cc.BasicMaterial(color=(0, 0.4, 0.8), opacity=0.5, double_sided=True)
    )
    scene.add(cc.Mesh.sphere(4), cc.MirrorMaterial(double_sided=True, env_weight=0.5))
    cube = renderer.capture(scene, position=(0.3, -0.2, 0.4), size=48)
    over, inside = edge_steps(cube.faces.astype(float))
    assert over < 1.5 * inside


def test_a_thin_line_over_an_edge_goes_on(renderer):
    """A rod crosses the edge between +X and -Z: both faces show it at the same height."""
    scene = cc.Scene()
    scene.add(
        cc.Mesh.box((6, 0.12, 0.12)),
        cc.BasicMaterial(color=(1, 1, 1)),
        position=(2, 0.5, -2),
        rotation=cc.axis_angle((0, 1, 0), -45),
    )
    faces = renderer.capture(scene, size=64).faces
    t = np.arange(64)
    for face, s in ((0, 1.0), (5, 0.0)):
        assert np.allclose(face_uv_to_direction(face, s, 0.5), [1, 0, -1])
        column = faces[face, :, -1 if s else 0, 0]
        assert column.any()
        rows = t[column > 0]
        middle = face_uv_to_direction(face, s, (rows.mean() + 0.5) / 64)
        assert middle[1] == pytest.approx(0.25, abs=0.03)
        assert direction_to_face_uv(middle)[0] in (0, 5)
