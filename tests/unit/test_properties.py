"""Laws that hold for any cube, any direction and any position; hypothesis chooses the examples."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import cubecam as cc
from tests.reference import transforms as ref
from tests.reference.cube_faces import CONVENTIONS, LAYOUTS
from tests.reference.pattern import random_faces

sizes = st.integers(1, 9)
channels = st.sampled_from([1, 3, 4])
dtypes = st.sampled_from([np.uint8, np.float16, np.float32])
conventions = st.sampled_from(CONVENTIONS)
number = st.floats(-1e3, 1e3, allow_subnormal=False)
vector = st.tuples(number, number, number)
direction = vector.filter(lambda v: np.linalg.norm(v) > 1e-3)
length = st.floats(1e-2, 1e2) | st.floats(-1e2, -1e-2)


def cube_of(size, count, dtype, seed=0):
    return cc.CubeMap(random_faces(np.random.default_rng(seed), size, count, dtype))


@given(sizes, channels, dtypes, conventions, st.sampled_from(LAYOUTS))
def test_every_layout_comes_back(size, count, dtype, convention, layout):
    cube = cube_of(size, count, dtype)
    picture = cube.to_layout(layout, convention=convention)
    assert cc.CubeMap.from_layout(picture, layout=layout, convention=convention) == cube


@given(sizes, dtypes, conventions, conventions)
def test_conversions_go_by_way_of_any_other(size, dtype, first, second):
    cube = cube_of(size, 3, dtype)
    there = cc.CubeMap(cube.to_convention(first), convention=first)
    assert np.array_equal(there.to_convention(second), cube.to_convention(second))


@given(sizes, st.lists(direction, min_size=1, max_size=20))
def test_lookups_stay_between_the_texels(size, directions):
    cube = cube_of(size, 3, np.float32)
    got = cube.sample(np.array(directions))
    assert (got >= cube.faces.min((0, 1, 2)) - 1e-6).all()
    assert (got <= cube.faces.max((0, 1, 2)) + 1e-6).all()


@given(sizes, direction, st.floats(1e-3, 1e3))
def test_the_length_of_a_direction_does_not_matter(size, towards, factor):
    cube = cube_of(size, 3, np.float32)
    a, b = cube.sample([towards, np.array(towards) * factor])
    assert np.abs(a - b).max() < 1e-3


@given(sizes, st.integers(1, 40).map(lambda n: 2 * n), st.floats(0, 1e4, width=32))
def test_one_color_stays_that_color(size, width, value):
    cube = cc.CubeMap(np.full((6, size, size, 1), value, np.float32))
    image = cube.to_equirect(width=width)
    assert np.array_equal(np.unique(image), [np.float32(value)])
    back = cc.CubeMap.from_equirect(image, size=size)
    assert np.allclose(back.faces, value, rtol=1e-6)
    assert np.allclose(cube.resize(7).faces, value, rtol=1e-6)


@given(vector, direction, st.floats(-720, 720), st.tuples(length, length, length))
def test_parts_of_a_node_are_its_matrix(position, axis, degrees, scale):
    node = cc.Scene().add(position=position, rotation=cc.axis_angle(axis, degrees), scale=scale)
    want = ref.trs(position, ref.axis_angle(axis, degrees), scale)
    assert np.allclose(node.world_matrix, want, rtol=1e-9, atol=1e-9)
    other = cc.Scene().add(matrix=node.matrix)
    assert np.allclose(other.world_matrix, want, rtol=1e-9, atol=1e-9)


@given(st.lists(vector, min_size=3, max_size=12), st.randoms(use_true_random=False))
def test_smooth_normals_are_unit_for_any_triangles(points, random):
    triangles = [random.sample(range(len(points)), 3) for _ in range(8)]
    normals = cc.Mesh(points, triangles).normals
    assert np.allclose(np.linalg.norm(normals, axis=-1), 1, atol=1e-5)
