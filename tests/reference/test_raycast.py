import numpy as np
import pytest

from cubecam.truth.shading import normalised

from .cube_faces import texel_directions
from .raycast import (
    Box,
    Quad,
    Sphere,
    Triangles,
    cast,
    cast_cube,
    cast_farthest,
    cast_frame,
    interior,
)
from .transforms import (
    apply,
    axis_angle,
    look_at,
    orthographic,
    perspective,
    pixel_rays,
    translation,
    trs,
)

BOX_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
X_SIDES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5]]
Y_SIDES = [[0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6]]
Z_SIDES = [[0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
BOX_TRIANGLES = np.array([*X_SIDES, *Y_SIDES, *Z_SIDES])


def test_sphere_straight_ahead():
    hits = cast(
        [Sphere(3, translation((0, 0, -5)), radius=2)],
        (0, 0, 0),
        np.array([[0, 0, -1.0], [0, 1.0, 0]]),
    )
    np.testing.assert_array_equal(hits.id, [3, 0])
    np.testing.assert_allclose(hits.t, [3, np.inf])
    np.testing.assert_allclose(hits.normal[0], [0, 0, 1])
    assert np.isnan(hits.position[1]).all()


def test_from_inside_only_double_sided_shapes_are_met():
    ray = np.array([[0, 0.1, -1.0]])
    for shape in (Sphere, Box):
        assert not cast([shape(1)], (0, 0, 0), ray).hit.any()
        hits = cast([shape(1, double_sided=True)], (0, 0, 0), ray)
        assert hits.hit.all()
        assert hits.facing[0] > 0


@pytest.mark.parametrize(
    "scale", [(1, 1, 1), (1, 2, 0.5), (-1, 1, 1)], ids=["plain", "stretched", "mirrored"]
)
@pytest.mark.parametrize("double_sided", [False, True])
def test_triangles_agree_with_the_box(scale, double_sided):
    matrix = trs((0.3, -0.2, -3), axis_angle((1, 2, 3), 40), scale)
    box = cast_cube([Box(1, matrix, double_sided)], (0, 0, 0), 32)
    mesh = Triangles(1, matrix, double_sided, positions=BOX_CORNERS, indices=BOX_TRIANGLES)
    triangles = cast_cube([mesh], (0, 0, 0), 32)
    assert box.hit.sum() > 20
    np.testing.assert_array_equal(box.id, triangles.id)
    np.testing.assert_allclose(box.t, triangles.t, rtol=1e-9)
    np.testing.assert_allclose(box.normal, triangles.normal, atol=1e-9)


def test_quad_faces_up_and_is_bounded():
    rays = np.array([[0, -1.0, 0], [0.6, -1, 0], [0, -1, 0.6], [0, -1, 0.9]])
    hits = cast([Quad(1, width=1, depth=1.5)], (0, 1, 0), rays)
    np.testing.assert_array_equal(hits.id, [1, 0, 1, 0])
    assert not cast([Quad(1)], (0, -1, 0), -rays).hit.any()


def test_near_and_far_cut():
    shape = [Quad(1, trs((0, 0, -5), axis_angle((1, 0, 0), 90)), width=100, depth=100)]
    assert cast_cube(shape, (0, 0, 0), 8, near=4.9).id[5].all()
    assert not cast_cube(shape, (0, 0, 0), 8, near=5.1).id[5].any()
    assert not cast_cube(shape, (0, 0, 0), 8, far=4.9).id[5].any()


def test_z_of_a_cube_ray_is_its_parameter():
    hits = cast_cube([Sphere(1, translation((2, 1, 3)), radius=1)], (0, 0, 0), 16)
    axis = np.abs(hits.position).max(-1)
    np.testing.assert_allclose(hits.t[hits.hit], axis[hits.hit])
    np.testing.assert_allclose(
        hits.distance[hits.hit], np.linalg.norm(hits.position[hits.hit], axis=-1)
    )


@pytest.mark.parametrize(
    "projection",
    [perspective(50, 1.5, 0.1, 100), orthographic(-3, 3, -2, 2, 0.1, 100)],
    ids=["perspective", "orthographic"],
)
def test_pixel_rays_project_back_to_their_pixels(projection):
    view = look_at((1, 2, 3), (0, 0, -1))
    origins, directions = pixel_rays(view, projection, (30, 20))
    ndc = apply(projection @ view, origins + 7 * directions)
    assert np.allclose((ndc[..., 0] + 1) / 2 * 30, np.arange(30) + 0.5)
    assert np.allclose(((1 - ndc[..., 1]) / 2 * 20).T, np.arange(20) + 0.5)
    forward = normalised([-1, -2, -4])
    np.testing.assert_allclose(directions @ forward, 1)
    np.testing.assert_allclose((origins - [1, 2, 3]) @ forward, 0, atol=1e-9)


def test_frame_of_a_sphere_is_round_and_in_the_right_place():
    view = look_at((0, 0, 5), (0, 0, 0))
    hits = cast_frame(
        [Sphere(1, translation((1, 1, 0)), radius=0.5)],
        view,
        perspective(60, 1, 0.1, 100),
        (40, 40),
        0.1,
        100,
    )
    rows, columns = np.nonzero(hits.hit)
    assert rows.mean() < 20 < columns.mean()
    assert abs((rows.max() - rows.min()) - (columns.max() - columns.min())) <= 1


def test_interpolated_normals_uvs_and_colors():
    mesh = Triangles(
        1,
        positions=np.array([[-1, -1, -2], [1, -1, -2], [-1, 1, -2.0]]),
        indices=np.array([[0, 1, 2]]),
        normals=np.eye(3) + 1,
        uvs=np.array([[0, 0], [1, 0], [0, 1.0]]),
        colors=np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1.0]]),
    )
    hits = cast([mesh], (0, 0, 0), np.array([[-0.25, -0.25, -1.0]]))
    np.testing.assert_allclose(hits.uv[0], [0.25, 0.25])
    np.testing.assert_allclose(hits.color[0], [0.5, 0.25, 0.25, 1])
    np.testing.assert_allclose(hits.normal[0], normalised([1.5, 1.25, 1.25]))


def test_interior_leaves_out_both_sides_of_an_edge():
    labels = np.zeros((2, 5, 5), int)
    labels[0, :, 3:] = 1
    inside = interior(labels)
    np.testing.assert_array_equal(inside[0, 2], [True, True, False, False, True])
    assert inside[1].all()


def test_cube_rays_are_the_texel_directions():
    sphere = Sphere(1, radius=2, double_sided=True)
    hits = cast_cube([sphere], (0, 0, 0), 6)
    np.testing.assert_allclose(hits.position, 2 * normalised(texel_directions(6)))


def test_the_farthest_hit_is_the_last_of_all():
    shapes = [
        Sphere(1, np.eye(4), radius=1.0, double_sided=True),
        Sphere(2, translation((0, 0, -4)), radius=0.5),
    ]
    origins = np.array([(0.0, 0, 3), (0.0, 0.9, 3), (0.0, 5, 3)])
    hits = cast_farthest(shapes, origins, np.array([0.0, 0, -1]) + np.zeros((3, 3)), 0.1, 100)
    assert hits.id.tolist() == [2, 1, 0]
    # The rays hit the front of the second sphere, the back of the first one, and nothing.
    np.testing.assert_allclose(hits.t, [6.5, 3 + np.sqrt(1 - 0.81), np.inf])
    np.testing.assert_allclose(hits.normal[0], [0, 0, 1])
