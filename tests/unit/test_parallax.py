"""Lookups that know where things are, against rooms of which the first hit is known in closed form."""

import numpy as np
import pytest

from cubecam.truth.shading import normalised, parallax
from cubecam.truth.shading.cubes import directions_of_texels, largest_part, sample_cube
from tests.reference.cube_faces import texel_directions
from tests.reference.pattern import random_faces
from tests.reference.sampling import sample_faces

LOW, HIGH = np.array([-3.0, -1.5, -2.0]), np.array([4.0, 1.5, 3.0])
CENTER = np.array([0.4, -0.2, 0.3])


@pytest.fixture
def rays(rng):
    """Positions up to .8 from C, and directions all around."""
    return CENTER + rng.uniform(-0.8, 0.8, (400, 3)), normalised(rng.normal(size=(400, 3)))


def room_hit(position, direction):
    """t where rays from inside of the room leave it: the nearest of the three planes ahead, one after the other."""
    t = np.full(len(position), np.inf)
    for axis in range(3):
        for plane in (LOW[axis], HIGH[axis]):
            with np.errstate(divide="ignore"):
                way = (plane - position[:, axis]) / direction[:, axis]
            t = np.where((way > 0) & (way < t), way, t)
    return t


def room_z(size):
    """What a capture of the empty room in C gives as "z": the axis' component of a texel's direction is 1."""
    d = texel_directions(size).reshape(-1, 3)
    return room_hit(np.broadcast_to(CENTER, d.shape), d).reshape(6, size, size)


def ball_hit(position, direction, middle, radius):
    """The two t where lines meet a ball, nan where they miss it."""
    p = position - np.asarray(middle)
    along = (p * direction).sum(-1)
    square = along**2 - ((p * p).sum(-1) - radius**2)
    root = np.sqrt(np.where(square < 0, np.nan, square))
    return -along - root, -along + root


def at_infinity(found, direction):
    np.testing.assert_array_equal(found.direction, direction)
    assert np.isinf(found.distance).all()
    assert (found.layer == parallax.NOTHING).all()
    assert not found.accepted.any()


class TestCubes:
    """`shading.cubes` against tests/reference, which is written from the same section of the specification."""

    @pytest.mark.parametrize("size", [1, 3, 16])
    def test_lookups_are_opengl_s(self, size, rng):
        faces = random_faces(rng, size)
        directions = rng.normal(size=(3000, 3))
        np.testing.assert_allclose(
            sample_cube(faces, directions), sample_faces(faces, directions), atol=1e-12
        )

    def test_faces_of_single_numbers(self, rng):
        faces, directions = rng.random((6, 5, 5)), rng.normal(size=(7, 40, 3))
        expected = sample_faces(faces[..., None], directions)[..., 0]
        np.testing.assert_allclose(sample_cube(faces, directions), expected, atol=1e-12)

    def test_directions_of_texels(self):
        np.testing.assert_allclose(directions_of_texels(6), texel_directions(6), atol=1e-15)


class TestBox:
    def test_from_inside_the_exit(self, rays):
        position, direction = rays
        found = parallax.box_direction(position, direction, CENTER, LOW, HIGH)
        t = room_hit(position, direction)
        np.testing.assert_allclose(found.distance, t, rtol=1e-12)
        np.testing.assert_allclose(
            found.direction, position + t[:, None] * direction - CENTER, atol=1e-12
        )
        assert found.accepted.all()

    def test_from_outside_the_exit_where_the_box_is_met(self):
        box = np.array(((0, 0, 0), (-1, -1, -1), (1, 1, 1)))
        hit = parallax.box_direction((-5, 0.5, 0), (1, 0, 0), *box)
        np.testing.assert_allclose(hit.direction, (1, 0.5, 0))
        assert hit.distance == 6
        at_infinity(parallax.box_direction((-5, 0.5, 0), (-1, 0, 0), *box), (-1, 0, 0))  # behind
        at_infinity(parallax.box_direction((-5, 1.5, 0), (1, 0, 0), *box), (1, 0, 0))  # beside
        slant = normalised((1, 1, 0))
        at_infinity(parallax.box_direction((-5, 0.5, 0), slant, *box), slant)

    def test_rays_along_the_axes_have_no_nan(self):
        """0 / 0 in a slab: P on the plane of a side, and R along that side."""
        found = parallax.box_direction((1, 0, 0), np.eye(3), (0, 0, 0), (-1, -1, -1), (1, 1, 1))
        np.testing.assert_array_equal(found.distance, (np.inf, 1, 1))  # the first one leaves
        np.testing.assert_array_equal(found.direction, ((1, 0, 0), (1, 1, 0), (1, 0, 1)))

    def test_a_box_of_its_own_space(self, rays, rng):
        """Turned, stretched and moved: the exit is on one of its sides in its space, and t counts in the world."""
        position, direction = rays
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = turn @ np.diag([2, 0.5, 3]), (0.7, -0.1, 0.1)
        low, high = (-2, -7, -1.5), (3, 9, 1)
        found = parallax.box_direction(position, direction, CENTER, low, high, matrix)
        hit = CENTER + found.direction
        np.testing.assert_allclose(hit, position + found.distance[:, None] * direction, atol=1e-12)
        inside = (hit - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T
        place = (inside - low) / np.subtract(high, low)
        np.testing.assert_allclose(np.abs(place - 0.5).max(-1), 0.5, atol=1e-12)
        assert (found.distance > 0).all()

    def test_shapes_broadcast(self):
        found = parallax.box_direction(np.zeros((5, 1, 3)), np.eye(3), CENTER, LOW, HIGH)
        assert found.direction.shape == (5, 3, 3)
        assert found.distance.shape == found.layer.shape == found.accepted.shape == (5, 3)


class TestSphere:
    def test_from_inside_the_exit(self, rays):
        position, direction = rays
        middle, radius = np.array((0.6, -0.5, 0.4)), 2.5
        low, high = middle - radius, middle + radius
        found = parallax.sphere_direction(position, direction, CENTER, low, high)
        t = ball_hit(position, direction, middle, radius)[1]
        np.testing.assert_allclose(found.distance, t, rtol=1e-12)
        np.testing.assert_allclose(
            found.direction, position + t[:, None] * direction - CENTER, atol=1e-12
        )

    def test_an_ellipsoid_in_its_own_space(self, rays):
        position, direction = rays
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = ((0, 0, 2), (1, 0, 0), (0, 3, 0)), CENTER
        low, high = np.array((-2, -1, -1.5)), np.array((3, 1, 2))
        found = parallax.sphere_direction(position, direction, CENTER, low, high, matrix)
        hit = CENTER + found.direction
        np.testing.assert_allclose(hit, position + found.distance[:, None] * direction, atol=1e-12)
        inside = (hit - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T
        place = (inside - (low + high) / 2) / ((high - low) / 2)
        np.testing.assert_allclose((place**2).sum(-1), 1, atol=1e-12)
        assert (found.distance > 0).all()

    def test_from_outside(self):
        ball = np.array(((0, 0, 0), (-1, -1, -1), (1, 1, 1)))
        hit = parallax.sphere_direction((-5, 0.6, 0), (1, 0, 0), *ball)
        np.testing.assert_allclose(hit.direction, (0.8, 0.6, 0), atol=1e-12)
        np.testing.assert_allclose(hit.distance, 5.8)
        at_infinity(parallax.sphere_direction((-5, 0.6, 0), (-1, 0, 0), *ball), (-1, 0, 0))
        at_infinity(parallax.sphere_direction((-5, 1.1, 0), (1, 0, 0), *ball), (1, 0, 0))
        # Inside of the box, but outside of the ball that it encloses.
        corner = normalised((1, 1, 1))
        at_infinity(parallax.sphere_direction((0.9, 0.9, 0.9), corner, *ball), corner)


class TestMarch:
    def test_planes_are_exact(self, rays):
        """W of a plane is linear on a face, so that only lookups across an edge of the room or the cube are off."""
        position, direction = rays
        size = 32
        found = parallax.march(position, direction, CENTER, room_z(size))
        t = room_hit(position, direction)
        off = np.abs(found.distance / t - 1)
        assert (off < 1e-8).mean() > 0.75
        assert off.max() < 3 / size
        assert (found.layer == parallax.NEAR).all()
        assert found.accepted.all()

    def test_the_direction_is_that_of_the_box(self, rays):
        position, direction = rays
        found = parallax.march(position, direction, CENTER, room_z(64)).direction
        exact = parallax.box_direction(position, direction, CENTER, LOW, HIGH).direction
        angle = np.linalg.norm(normalised(found) - normalised(exact), axis=-1)
        assert angle.max() < 1 / 64  # half a texel
        plain = np.linalg.norm(direction - normalised(exact), axis=-1)
        assert np.median(plain) > 0.1

    def test_a_round_room(self, rays):
        """The error of linear interpolation falls with the square of the texel's size."""
        position, direction = rays
        middle, radius = np.array((0.7, 0.0, 0.2)), 2.0
        t = ball_hit(position, direction, middle, radius)[1]
        off = []
        for size in (32, 64):
            d = directions_of_texels(size).reshape(-1, 3)
            length = np.linalg.norm(d, axis=-1)
            ball = ball_hit(CENTER, d / length[:, None], middle, radius)[1]
            z = (ball / length).reshape(6, size, size)
            found = parallax.march(position, direction, CENTER, z)
            off.append(np.median(np.abs(found.distance / t - 1)))
        assert off[0] < 1e-3
        assert 3 < off[0] / off[1] < 5

    def test_from_the_place_of_the_capture(self, rays):
        _, direction = rays
        found = parallax.march(CENTER, direction, CENTER, room_z(32))
        along = found.direction / np.linalg.norm(found.direction, axis=-1, keepdims=True)
        np.testing.assert_allclose(along, direction, atol=1e-12)
        t = room_hit(np.broadcast_to(CENTER, direction.shape), direction)
        np.testing.assert_allclose(found.distance, t, rtol=3 / 32)
        assert (np.abs(found.distance / t - 1) < 1e-8).mean() > 0.75
        beside = parallax.march(CENTER + 1e-7, direction, CENTER, room_z(32))
        np.testing.assert_allclose(beside.distance, found.distance, rtol=1e-5)

    def test_nothing_was_captured(self, rays):
        position, direction = rays
        empty = np.full((6, 8, 8), np.inf)
        at_infinity(parallax.march(position, direction, CENTER, empty), direction)

    def test_half_of_the_world_is_sky(self, rays):
        """A floor, and no more: rays that go down meet it, rays that go up see their own direction."""
        position, direction = rays
        d = directions_of_texels(64)
        with np.errstate(divide="ignore"):
            z = np.where(d[..., 1] < 0, -1.5 / d[..., 1], np.inf)
        found = parallax.march(position, direction, CENTER, z)
        up, down = direction[:, 1] > 0.05, direction[:, 1] < -0.1
        np.testing.assert_array_equal(found.direction[up], direction[up])
        t = (CENTER[1] - 1.5 - position[:, 1]) / direction[:, 1]
        assert (np.abs(found.distance / t - 1)[down] < 3 / 64).all()

    def test_from_outside_of_what_was_captured(self):
        """P lies behind the captured wall: walls count from their front, so that the next one is met."""
        z = np.full((6, 16, 16), 2.0)
        found = parallax.march((-5, 0.25, 0.5), (1, 0, 0), (0, 0, 0), z)
        np.testing.assert_allclose(found.direction, (2, 0.25, 0.5), atol=1e-8)
        np.testing.assert_allclose(found.distance, 7)


class TestSilhouettes:
    """A plate hides a part of the wall behind it from C: the wall is at x = 8, the plate at x = 4 with |y|, |z| < 1."""

    SIZE = 128

    def z(self):
        d = directions_of_texels(self.SIZE)
        wall = np.full(d.shape[:3], 8.0)
        plate = (d[..., 0] > 0.99) & (np.abs(d[..., 1:]).max(-1) < 0.25)
        return np.where(plate, 4.0, wall), wall

    def test_the_wall_that_shows_beside_the_plate(self):
        """Rays from beside C pass the plate, and end where C sees the wall."""
        near, _ = self.z()
        found = parallax.march((0, 2, 0), normalised((8, 2, 0)), (0, 0, 0), near)
        np.testing.assert_allclose(found.direction, (8, 4, 0), atol=1e-6)
        assert found.accepted

    def test_the_plate_itself(self):
        near, far = self.z()
        found = parallax.march((0, 0.5, 0), (1, 0, 0), (0, 0, 0), near, far)
        np.testing.assert_allclose(found.direction, (4, 0.5, 0), atol=1e-8)
        assert (int(found.layer), bool(found.accepted)) == (parallax.NEAR, True)

    def test_what_only_the_far_layer_knows(self):
        """The ray passes beside the plate and goes on behind it, to a part of the wall that C does not see."""
        near, far = self.z()
        target = np.array((8, 1.5, 0))
        start = np.array((0, 2.5, 0))
        direction = normalised(target - start)
        two = parallax.march(start, direction, (0, 0, 0), near, far)
        np.testing.assert_allclose(two.direction, target, atol=1e-6)
        assert (int(two.layer), bool(two.accepted)) == (parallax.FAR, True)
        one = parallax.march(start, direction, (0, 0, 0), near)
        # The guess: where the ray goes behind the plate's edge, as C sees it.
        assert (int(one.layer), bool(one.accepted)) == (parallax.NEAR, False)
        edge = 2.0 / 8  # the slope at which C sees the edge of the plate
        y = one.direction / one.direction[0]
        assert abs(y[1] - edge) < 2 / self.SIZE

    def test_the_tolerance_decides(self):
        near, _ = self.z()
        start, direction = (0, 2.5, 0), normalised((8, -1, 0))
        assert parallax.march(start, direction, (0, 0, 0), near, tolerance=0.9).accepted

    def test_the_far_layer_counts_from_behind(self):
        """A ray from outside enters through a wall: the near layer lets it in, the far layer is met."""
        z = np.full((6, 16, 16), 2.0)
        found = parallax.march((-5, 0.25, 0.5), (1, 0, 0), (0, 0, 0), z, z)
        np.testing.assert_allclose(found.direction, (-2, 0.25, 0.5), atol=1e-8)
        assert found.layer == parallax.FAR


class TestInverseDepth:
    def test_values(self):
        np.testing.assert_array_equal(parallax.inverse_depth([4.0, np.inf, 0.5]), [0.25, 0, 2])

    def test_it_is_the_maximum_norm_of_captured_points(self):
        d = directions_of_texels(8)
        np.testing.assert_allclose(largest_part(d), 1)


class TestRoughness:
    def test_footprints_agree(self, rays):
        """The cones of the lobes from P and from C are equally wide where they meet the wall."""
        position, direction = rays
        found = parallax.box_direction(position, direction, CENTER, LOW, HIGH)
        rough = parallax.roughness_at(0.3, found)
        kept = rough < 1
        from_center = np.linalg.norm(found.direction, axis=-1)
        from_there, here = (np.tan(2 * np.arctan(r**2)) for r in (rough, 0.3))
        np.testing.assert_allclose(
            (from_there * from_center)[kept], (here * found.distance)[kept], rtol=1e-12
        )
        assert rough.min() < 0.28
        assert rough.max() > 0.32

    def test_limits(self):
        def seen_from(position, center):
            found = parallax.box_direction(position, (1, 0, 0), center, (-1,) * 3, (1,) * 3)
            return parallax.roughness_at(0.5, found)

        # A hundredth of the way: the tangent of 2 atan(.25) is 8 / 15.
        assert seen_from((0.99, 0, 0), (0, 0, 0)) == pytest.approx((0.08 / 30) ** 0.5, rel=1e-5)
        assert 0.99 < seen_from((-9, 0, 0), (0.999, 0, 0)) < 1
        assert seen_from((9, 0, 0), (0, 0, 0)) == 0.5  # nothing is met
