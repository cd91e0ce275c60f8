"""Mesh.from_trimesh: what trimesh has is what the mesh has."""

import numpy as np
import pytest
import trimesh

import cubecam as cc
from cubecam.truth.shading import normalised
from tests.reference import transforms as ref


def torus(**options):
    made = trimesh.creation.torus(major_radius=1, minor_radius=0.3)
    return trimesh.Trimesh(made.vertices, made.faces, process=False, **options)


def test_vertices_faces_and_normals():
    given = torus()
    mesh = cc.Mesh.from_trimesh(given)
    np.testing.assert_array_equal(mesh.positions, given.vertices.astype(np.float32))
    np.testing.assert_array_equal(mesh.indices, given.faces)
    np.testing.assert_allclose(mesh.normals, given.vertex_normals, atol=1e-6)
    assert mesh.uvs is None
    assert mesh.colors is None


def test_normals_that_were_given(rng):
    normals = normalised(rng.normal(size=torus().vertices.shape))
    mesh = cc.Mesh.from_trimesh(torus(vertex_normals=normals))
    np.testing.assert_allclose(mesh.normals, normals, atol=1e-6)


def test_texture_coordinates(rng):
    uvs = rng.random((len(torus().vertices), 2))
    visual = trimesh.visual.TextureVisuals(uv=uvs)
    mesh = cc.Mesh.from_trimesh(torus(visual=visual))
    np.testing.assert_array_equal(mesh.uvs, uvs.astype(np.float32))


def test_vertex_colors(rng):
    colors = rng.integers(0, 256, (len(torus().vertices), 4), dtype=np.uint8)
    mesh = cc.Mesh.from_trimesh(torus(vertex_colors=colors))
    assert mesh.colors is not None
    np.testing.assert_allclose(mesh.colors, colors / 255, atol=1e-7)


def test_colors_of_faces_are_not_read(rng):
    colors = rng.integers(0, 256, (len(torus().faces), 4), dtype=np.uint8)
    assert cc.Mesh.from_trimesh(torus(face_colors=colors)).colors is None


@pytest.mark.parametrize(
    "scale", [(3, 1, 1), (-2, 1, 1), (1, -1, 0.5), (-1, -2, -3), (1, 1, 0)], ids=str
)
def test_normals_and_winding_of_a_scaled_node(scale):
    """A ball becomes an ellipsoid, whose normals are the gradient of x^2/a^2 + y^2/b^2 + z^2/c^2."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    places = ball.vertices / np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    scene = trimesh.Scene()
    scene.add_geometry(
        trimesh.Trimesh(places, ball.faces, vertex_normals=places, process=False),
        transform=np.diag([*scale, 1.0]),
    )
    mesh = cc.Mesh.from_trimesh(scene)
    a, b, c = scale
    gradient = places * (b * c, c * a, a * b) * np.sign([np.prod(scale) or 1])
    gradient /= np.linalg.norm(gradient, axis=1, keepdims=True) + (np.prod(scale) == 0)
    np.testing.assert_allclose(mesh.positions, places * scale, atol=1e-6)
    if np.prod(scale):
        np.testing.assert_allclose(mesh.normals, gradient, atol=1e-6)
        corners = mesh.positions.astype(float)[mesh.indices]
        outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        assert (np.einsum("ij,ij->i", outward, corners.mean(axis=1)) > 0).all()
    else:  # flat: all normals are along z where they are not 0
        flat = np.abs(places[:, 2]) > 1e-6
        np.testing.assert_allclose(np.abs(mesh.normals[flat, 2]), 1, atol=1e-6)


def test_a_scene_becomes_one_mesh():
    scene = trimesh.Scene()
    matrices = [ref.trs((1, 2, 3), (1, 2, 3, 4), 2), np.diag([-1.0, 1, 1, 1])]
    for matrix in matrices:
        scene.add_geometry(torus(), transform=matrix)
    scene.add_geometry(trimesh.PointCloud([[9, 9, 9]]))
    mesh = cc.Mesh.from_trimesh(scene)
    one = torus()
    want = [one.vertices @ m[:3, :3].T + m[:3, 3] for m in matrices]
    np.testing.assert_allclose(mesh.positions, np.concatenate(want), atol=1e-6)
    count = len(one.vertices)
    np.testing.assert_array_equal(mesh.indices[: len(one.faces)], one.faces)
    np.testing.assert_array_equal(mesh.indices[len(one.faces) :], one.faces[:, ::-1] + count)
    turned = [one.vertex_normals @ np.linalg.inv(m[:3, :3]) for m in matrices]
    np.testing.assert_allclose(mesh.normals, normalised(np.concatenate(turned)), atol=1e-6)


@pytest.mark.parametrize("thing", [None, "bunny.obj", 3, trimesh.PointCloud([[0, 0, 0]])])
def test_another_kind_of_object_is_an_error(thing):
    expected = "mesh: expected a trimesh.Trimesh or a trimesh.Scene, got "
    with pytest.raises(TypeError, match=expected + type(thing).__name__):
        cc.Mesh.from_trimesh(thing)


def test_a_mesh_of_cubecam_is_an_error():
    with pytest.raises(TypeError, match="got Mesh"):
        cc.Mesh.from_trimesh(cc.Mesh.box())


@pytest.mark.parametrize("empty", [trimesh.Trimesh(), trimesh.Scene()], ids=["mesh", "scene"])
def test_without_triangles(empty):
    with pytest.raises(ValueError, match="mesh: expected triangles, got none"):
        cc.Mesh.from_trimesh(empty)


def test_broken_contents():
    with pytest.raises(ValueError, match="finite positions"):
        cc.Mesh.from_trimesh(trimesh.Trimesh(np.array([[0, 0, 0], [1, 0, 0], [0, np.nan, 0]]), [[0, 1, 2]],
                                             process=False))  # fmt: skip
