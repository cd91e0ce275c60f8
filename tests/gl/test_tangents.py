"""Tangents and the second set of uvs as shaders see them: interpolated, in the world, after every change."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.flat import CORNERS, flat_camera
from tests.helpers import DEVICE

TANGENT = "vec3 shade(Surface s) { return s.tangent.xyz; }"
BITANGENT = "vec3 shade(Surface s) { return s.tangent.w * cross(s.normal, s.tangent.xyz); }"
SIGN = "vec3 shade(Surface s) { return vec3(s.tangent.w); }"
SECOND = "vec3 shade(Surface s) { return vec3(s.uv1, s.uv.x); }"
SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
TRIANGLES = [[0, 1, 2], [0, 2, 3]]


def mesh_of(uvs=CORNERS, **more):
    return cc.Mesh(SQUARE, TRIANGLES, uvs=uvs, **more)


def middle(renderer, mesh, fragment, matrix=None, camera=None, **options):
    """The colour in the middle of the picture of one node."""
    scene = cc.Scene()
    scene.add(
        mesh, cc.ShaderMaterial(fragment, **options), matrix=np.eye(4) if matrix is None else matrix
    )
    frame = renderer.render(scene, camera or flat_camera(1, 1), (5, 5), format="rgba32f")
    return frame.color[2, 2, :3].astype(float)


def turned(uv_matrix, matrix):
    """Where +u and +v point in the world, if uv = uv_matrix @ (x, y)."""
    along = np.linalg.inv(uv_matrix)  # columns: +u, +v
    both = matrix[:3, :2] @ along
    return (both / np.linalg.norm(both, axis=0)).T


@pytest.mark.parametrize("mirrored", [1, -1])
@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (2, 0.7, 1), (-2, -0.7, 1), (1, -3, 2)])
def test_tangents_of_uvs_in_the_world(any_path, scale, mirrored):
    """Tangents go with the matrix, and the bitangent points along +v, whatever is mirrored."""
    turn = np.array([[0.8, -0.6], [0.6, 0.8]])
    uv_matrix = np.diag([mirrored, 1]) @ turn
    matrix = np.eye(4)
    matrix[:3, :3] = np.diag(scale)
    matrix[:2, 3] = 0.5 - 0.5 * np.array(scale[:2])  # the middle stays
    mesh = mesh_of(SQUARE[:, :2] @ uv_matrix.T)
    want = turned(uv_matrix, matrix)
    # A matrix that mirrors keeps the front at the front, so both sides are shown: the normal is +z.
    np.testing.assert_allclose(middle(any_path, mesh, TANGENT, matrix), want[0], atol=1e-5)
    if abs(abs(scale[0]) - abs(scale[1])) < 1e-9:  # else u and v are not perpendicular in the world
        np.testing.assert_allclose(middle(any_path, mesh, BITANGENT, matrix), want[1], atol=1e-5)
    sign = mirrored * np.sign(np.linalg.det(matrix))
    np.testing.assert_array_equal(middle(any_path, mesh, SIGN, matrix), sign)


def test_the_back_has_the_frame_turned_as_a_whole(renderer):
    """A bump is a dent on the other side: normal, tangent and bitangent all change their sign."""
    camera = cc.OrthographicCamera(height=1, position=(0.5, 0.5, -5), target=(0.5, 0.5, 0))
    for fragment, want in ((TANGENT, (1, 0, 0)), (BITANGENT, (0, 1, 0)), (SIGN, (1, 1, 1))):
        for behind, factor in ((None, 1), (camera, -1)):
            got = middle(renderer, mesh_of(), fragment, camera=behind, double_sided=True)
            np.testing.assert_allclose(got, factor * np.array(want), atol=1e-6)


def test_given_tangents_are_interpolated(renderer):
    given = np.array([[1, 0, 0, 1], [0, 1, 0, 1], [0, 1, 0, 1], [1, 0, 0, 1]], float)
    got = middle(renderer, mesh_of(tangents=given), TANGENT)
    np.testing.assert_allclose(got, np.array([1, 1, 0]) / np.sqrt(2), atol=1e-5)


def test_the_second_set_of_uvs_is_another(any_path):
    second = np.array([[0, 0], [4, 0], [4, 2], [0, 2]], float)
    np.testing.assert_allclose(
        middle(any_path, mesh_of(uvs1=second), SECOND), [2, 1, 0.5], atol=1e-5
    )
    np.testing.assert_allclose(middle(any_path, mesh_of(), SECOND), [0, 0, 0.5], atol=1e-5)


def test_without_uvs_there_are_no_tangents(renderer):
    mesh = cc.Mesh(SQUARE, TRIANGLES)
    np.testing.assert_array_equal(
        middle(renderer, mesh, "vec3 shade(Surface s) { return s.tangent.xyz; }"), 0
    )
    mesh.tangents = [[0, 2, 0, 1]] * 4
    np.testing.assert_allclose(middle(renderer, mesh, TANGENT), [0, 1, 0], atol=1e-6)


def stage(mesh, **options):
    scene = cc.Scene()
    for place, fragment in enumerate((TANGENT, SECOND)):
        material = cc.ShaderMaterial(fragment, **options)
        scene.add(mesh, material, position=(-1.2 + 2.4 * place, 0, 0), scale=(1, 1.3, -0.8))
    return scene


CAMERA = cc.PerspectiveCamera(fov=60, position=(0.4, 0.7, 4), target=(0, 0, 0))


def pictures(renderer, scene):
    frame = renderer.render(scene, CAMERA, (40, 24), format="rgba32f")
    return [frame.color, renderer.capture(scene, (0, 0, 2), 16).faces]


def lump(rng):
    ball = cc.Mesh.icosphere(1, subdivisions=2)
    count = len(ball.positions)
    return cc.Mesh(
        ball.positions, ball.indices, uvs=rng.random((count, 2)), uvs1=rng.random((count, 2))
    )


@pytest.mark.parametrize("flat", [False, True])
def test_pictures_after_changes_equal_pictures_from_scratch(renderer, rng, flat):
    mesh = lump(rng)
    count = len(mesh.positions)
    scene = stage(mesh, flat_shading=flat)
    first = pictures(renderer, scene)
    changes = [
        {"positions": mesh.positions * (1, 0.6, 1.2)},
        {"uvs": rng.random((count, 2))},
        {"uvs1": rng.random((count, 2))},
        {"tangents": np.c_[rng.normal(size=(count, 3)), np.ones(count)]},
        {"tangents": np.c_[rng.normal(size=(count, 3)), -np.ones(count)]},
        {"normals": rng.normal(size=(count, 3))},
    ]
    for change in changes:
        mesh.update(**change)
        got = pictures(renderer, scene)
        arrays = {
            name: getattr(mesh, name)
            for name in ("positions", "normals", "uvs", "uvs1", "tangents")
        }
        again = cc.Mesh(indices=mesh.indices, **arrays)
        with cc.Renderer(device=DEVICE) as fresh:
            for one, other in zip(
                got, pictures(fresh, stage(again, flat_shading=flat)), strict=True
            ):
                assert_identical(one, other)
        assert not np.array_equal(got[0], first[0]) or "normals" in change
    mesh.tangents = None
    got = pictures(renderer, scene)
    arrays = {name: getattr(mesh, name) for name in ("positions", "normals", "uvs", "uvs1")}
    with cc.Renderer(device=DEVICE) as fresh:
        want = pictures(fresh, stage(cc.Mesh(indices=mesh.indices, **arrays), flat_shading=flat))
        for one, other in zip(got, want, strict=True):
            assert_identical(one, other)


def test_a_mesh_is_drawn_with_its_own_tangents_made(renderer, rng):
    """Drawing with tangents that the renderer has made equals drawing the mesh of `with_tangents`."""
    mesh = lump(rng)
    made = mesh.with_tangents()
    assert len(made.positions) > len(mesh.positions)
    assert_identical(pictures(renderer, stage(mesh))[0], pictures(renderer, stage(made))[0])
