"""Captures of boxes, spheres, planes and meshes against the ray caster, all outputs, all faces."""

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.world import (
    OUTPUTS,
    Sphere,
    World,
    capture_hits,
    inner,
    inner_smooth,
    label_of,
    room,
)
from tests.helpers import faces
from tests.reference.cube_faces import texel_directions
from tests.reference.raycast import interior

SIZE = 32
POSITIONS = {"origin": (0, 0, 0), "off": (0.31, -0.23, 0.17)}


@pytest.fixture(scope="module", params=list(POSITIONS.values()), ids=list(POSITIONS))
def seen(request, shared_renderers):
    """(captured cube, hits of the ray caster, world): the room seen from one position."""
    world = room()
    renderer = shared_renderers(None)
    cube = renderer.capture(world.scene, position=request.param, size=SIZE, outputs=OUTPUTS)
    return cube, capture_hits(world, request.param, SIZE), world


@faces
def test_every_face_sees_something_and_its_own(seen, face):
    cube, hits, _ = seen
    assert hits.hit[face].mean() > 0.1
    assert len(np.unique(hits.id[face])) >= 2
    assert_close(
        cube.id[face], hits.id[face], "exact", mask=interior(hits.id)[face], name=f"id {face}"
    )


def test_label(seen):
    cube, hits, _ = seen
    assert (cube.label.shape, cube.label.dtype) == ((6, SIZE, SIZE), np.int32)
    assert_close(cube.label, label_of(hits.id), "exact", mask=interior(hits.id))
    np.testing.assert_array_equal(cube.label, label_of(cube.id))


def test_color(seen):
    cube, hits, world = seen
    assert cube.faces.dtype == np.float32
    assert_close(cube.faces, world.paint(hits), "float32_maths", mask=interior(hits.id))


def test_silhouettes_are_where_they_should_be(seen):
    """Also at the silhouettes, which other tests mask, only a few pixels in a thousand may have another id."""
    cube, hits, _ = seen
    assert (cube.id != hits.id).mean() < 0.002


def test_distance(seen):
    cube, hits, _ = seen
    assert_close(cube.distance, hits.distance, "distance", mask=interior(hits.id))


def test_z(seen):
    cube, hits, _ = seen
    assert_close(cube.z, hits.t, "distance", mask=interior(hits.id))


def test_position(seen):
    cube, hits, _ = seen
    assert_close(cube.position, hits.position, "position", mask=interior(hits.id))


def test_normal(seen):
    cube, hits, _ = seen
    mask = np.where(hits.id == 6, inner_smooth(hits), inner(hits))  # 6 is the sphere
    assert_close(cube.normal, hits.normal, "normal", mask=mask)
    towards = -(cube.normal * texel_directions(SIZE)).sum(-1)
    assert (towards[mask & hits.hit] > 0).all()


def test_background_outputs(seen):
    cube, hits, _ = seen
    nothing = ~hits.hit & interior(hits.id)
    assert nothing.any()
    assert (cube.distance[nothing] == np.inf).all()
    assert (cube.z[nothing] == np.inf).all()
    assert np.isnan(cube.position[nothing]).all()
    assert not cube.normal[nothing].any()
    assert not cube.id[nothing].any()
    assert not cube.faces[nothing].any()


def test_position_is_distance_along_the_ray(seen):
    cube, *_ = seen
    directions = texel_directions(SIZE)
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    hit = cube.id > 0
    start = cube.position[hit] - directions[hit] * cube.distance[hit][:, None]
    assert np.ptp(start, axis=0).max() < 1e-2


def test_shapes_and_dtypes_of_outputs(seen):
    cube, *_ = seen
    for name in ("distance", "z"):
        assert (getattr(cube, name).shape, getattr(cube, name).dtype) == (
            (6, SIZE, SIZE),
            np.float32,
        )
    for name in ("normal", "position"):
        assert (getattr(cube, name).shape, getattr(cube, name).dtype) == (
            (6, SIZE, SIZE, 3),
            np.float32,
        )
    assert (cube.id.shape, cube.id.dtype) == ((6, SIZE, SIZE), np.int32)


@pytest.mark.parametrize("name", OUTPUTS)
def test_one_output_alone_is_the_same_and_the_rest_is_none(renderer, name):
    scene = room().scene
    every = renderer.capture(scene, size=16, outputs=OUTPUTS)
    alone = renderer.capture(scene, size=16, outputs=(name,))
    assert_identical(getattr(alone, name), getattr(every, name))
    assert_identical(alone.faces, every.faces)
    for other in set(OUTPUTS) - {name}:
        assert getattr(alone, other) is None


def test_outputs_are_read_only_views_that_outlive_their_cube(renderer):
    cube = renderer.capture(room().scene, size=16, outputs=("distance",))
    view, kept = cube.distance, cube.distance.copy()
    with pytest.raises(ValueError, match="read-only"):
        view[0, 0, 0] = 1
    del cube
    assert_identical(view, kept)


def test_captured_outputs_survive_pickling(renderer):
    import pickle

    cube = renderer.capture(room().scene, size=8, outputs=OUTPUTS)
    other = pickle.loads(pickle.dumps(cube))
    for name in OUTPUTS:
        assert_identical(getattr(other, name), getattr(cube, name))


@pytest.mark.parametrize(("near", "far"), [(1.5, 1000), (0.05, 2.2), (1.2, 2.4)])
def test_near_and_far_cut_along_the_axis(renderer, near, far):
    world = room()
    hits = capture_hits(world, size=SIZE, near=near, far=far)
    whole = capture_hits(world, size=SIZE)
    assert (hits.id != whole.id).mean() > 0.02
    cube = renderer.capture(world.scene, size=SIZE, near=near, far=far, outputs=("id", "distance"))
    mask = interior(hits.id)
    assert_close(cube.id, hits.id, "exact", mask=mask)
    assert_close(cube.distance, hits.distance, "distance", mask=mask)


@pytest.mark.parametrize("size", [1, 2, 3, 17, 33])
def test_sizes_that_are_no_powers_of_two(renderer, size):
    world = room()
    hits = capture_hits(world, (0.31, -0.23, 0.17), size)
    cube = renderer.capture(world.scene, position=(0.31, -0.23, 0.17), size=size, outputs=("id",))
    assert cube.faces.shape == (6, size, size, 4)
    mask = interior(hits.id) if size > 16 else np.ones_like(hits.hit)
    assert (cube.id == hits.id)[mask].mean() > 0.95


def test_a_large_background_is_uploaded_in_parts(renderer):
    """Each face has more than a million texels; the picture's texels lie on those of the cube, in their middle."""
    faces = np.random.default_rng(5).integers(0, 256, (6, 1100, 1100, 1), dtype=np.uint8)
    scene = cc.Scene(background=cc.CubeMap(faces))
    got = renderer.capture(scene, size=1100, format="rgba8").faces[..., :1]
    # The ray of a texel meets the next one's middle by the rounding of float32, so a mean has at most one step.
    assert np.abs(got.astype(int) - faces).max() <= 1


def test_a_fine_sphere_is_a_sphere(renderer):
    """The capture is compared with a true sphere: the tolerances allow for the sphere's 64 x 32 facets."""
    world = World()
    world.add(cc.Mesh.sphere(0.8), Sphere(0, radius=0.8), (1, 0, 0), position=(0.3, 0.4, -2))
    hits = capture_hits(world, size=64)
    cube = renderer.capture(world.scene, size=64, outputs=("distance", "normal", "id"))
    mask = inner_smooth(hits) & (hits.facing > 0.3)
    assert mask.sum() > 300
    mask &= hits.hit
    assert np.abs(cube.distance[mask] - hits.distance[mask]).max() < 5e-3
    assert np.abs(cube.normal - hits.normal)[mask].max() < 2e-2
    assert (cube.id != hits.id).mean() < 2e-3


@pytest.mark.slow
def test_a_real_mesh(renderer):
    world = World()
    world.mesh(
        cc.load_mesh(cc.sample_data("teapot.obj"), size=2),
        (1, 1, 1),
        position=(0.4, 0.1, -1.6),
        degrees=30,
    )
    world.plane(6, 6, (0, 1, 0), position=(0, -1, 0))
    hits = capture_hits(world, size=24)
    cube = renderer.capture(world.scene, size=24, outputs=("id", "distance", "normal"))
    mask = inner_smooth(hits) & interior(hits.part)
    assert_close(cube.id, hits.id, "exact", mask=interior(hits.id))
    assert_close(cube.distance, hits.distance, "distance", mask=mask)


def test_exclude_covers_subtrees(renderer):
    world = World()
    parent = world.box(0.5, (1, 0, 0), position=(0, 0, -2))
    world.box(0.5, (0, 1, 0), position=(2, 0, 0), parent=parent)
    world.plane(4, 4, (0, 0, 1), position=(0, -1, 0))
    cube = renderer.capture(world.scene, size=16, exclude=[parent], outputs=("id",))
    assert set(np.unique(cube.id)) == {0, 3}
    assert set(np.unique(renderer.capture(world.scene, size=16, outputs=("id",)).id)) == {
        0,
        1,
        2,
        3,
    }


def test_order_of_adding_does_not_change_what_is_in_front(renderer):
    """Nodes are added from near to far or from far to near: depth decides what is in front."""
    for order in (1, -1):
        scene = cc.Scene()
        for z, color in [(-1, (1, 0, 0)), (-2, (0, 1, 0)), (-3, (0, 0, 1))][::order]:
            scene.add(cc.Mesh.box(0.5), cc.BasicMaterial(color=color), position=(0, 0, z))
        np.testing.assert_array_equal(renderer.capture(scene, size=8).faces[5, 4, 4], [1, 0, 0, 1])
