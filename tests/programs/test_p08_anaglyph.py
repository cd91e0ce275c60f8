"""P8: red is the left eye's own frame, green and blue the right eye's; the eyes stand where the document turns them."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.examples import anaglyph as example
from tests.compare import assert_close, assert_identical
from tests.programs.oracle import Look, box, lit, mesh, moved, near_enough, ry, turned, unbroken

SIZE = (60, 60)
EYE = np.array([0, 1.5, 5])


def eye_turned(degrees):
    """The view as the document turns it: about its own y-axis, which passes through the origin, its target."""
    look = Look(EYE, (0, 0, 0), 45, 1, 100, SIZE)
    turn = turned(look.view[1, :3], degrees)
    look.view, look.eye = look.view @ np.linalg.inv(turn), turn[:3, :3] @ EYE
    return look


@pytest.mark.parametrize("kind", ["rgba8", "rgba32f"])
@pytest.mark.parametrize("frame", [0, 10, 47])
def test_channels_are_the_eyes_own_frames(any_path, frame, kind):
    program = example.build(document=True)
    got = example.draw(program, any_path, frame, SIZE, format=kind)
    eyes = [
        any_path.render(program.scene, camera, SIZE, format=kind).color
        for camera in (program.stereo.left, program.stereo.right)
    ]
    assert_identical(got[..., :1], eyes[0][..., :1])
    assert_identical(got[..., 1:3], eyes[1][..., 1:3])
    assert (got[..., 3] == got.dtype.type(255 if kind == "rgba8" else 1)).all()
    assert (eyes[0] != eyes[1]).any()


@pytest.mark.slow
@pytest.mark.parametrize("frame", [10, 70])
def test_both_eyes_against_ray_casting(renderer, frame):
    """All things are grey, so that red and green are the same picture seen from two places."""
    program = example.build(document=True, degrees=6)
    got = example.draw(program, renderer, frame, SIZE, format="rgba32f")
    nodes = [node for node in program.scene.nodes if node.mesh is not None]
    for channel, degrees in ((0, -3), (1, 3), (2, 3)):
        look = eye_turned(degrees)
        shapes = []
        for index, node in enumerate(nodes):
            matrix = ry(3 * frame) @ ry(90 * index) @ moved(1.5, 0, 0) @ ry(-90 * index)
            shapes.append(box(node, 0.8, matrix) if index == 1 else mesh(node, matrix))
        hits = look.hits(shapes)
        colors = dict.fromkeys((node.id for node in nodes), (0.7, 0.7, 0.7))
        want = lit(hits, colors, look.eye, (0, 0, 0), ks=0.3)
        mask = unbroken(hits)
        assert mask[hits.hit].mean() > 0.2
        # Ball and box are compared closely; bunny and teapot have inner edges everywhere.
        plain = mask & np.isin(hits.id, [nodes[1].id, nodes[3].id])
        assert plain.sum() > 100
        assert_close(got[..., channel], want[..., 0], "phong", mask=plain, least=0.02)
        near_enough(
            got[..., channel], want[..., 0], mask & hits.hit, 0.02, 0.04, f"channel {channel}"
        )
        opposite = eye_turned(-degrees)
        other = opposite.hits(shapes)
        both = mask & hits.hit & other.hit
        swapped = lit(other, colors, opposite.eye, (0, 0, 0), ks=0.3)[..., 0]
        assert np.abs(swapped - got[..., channel])[both].mean() > 0.02, "the other eye's is another"


def test_two_views_are_one_call(fresh_renderer):
    program = example.build(document=True)
    example.draw(program, fresh_renderer, 0, SIZE)
    assert fresh_renderer.stats.views_drawn == 2
    example.draw(program, fresh_renderer, 0, SIZE)
    assert fresh_renderer.stats.views_drawn == 0


def test_without_an_angle_it_is_flat(renderer):
    program = example.build(document=True, degrees=0)
    got = example.draw(program, renderer, 10, SIZE)
    assert_identical(got, renderer.render(program.scene, program.camera, SIZE).color)
    assert isinstance(program.stereo, cc.StereoCamera)


@pytest.mark.parametrize("document", [False, True])
def test_the_axis_is_the_views_own(document):
    """About its own y axis both eyes keep one direction upwards; about the world's they are rolled."""
    program = example.build(6, document=document)
    for camera, degrees in ((program.stereo.left, -3), (program.stereo.right, 3)):
        want = eye_turned(degrees)
        np.testing.assert_allclose(np.linalg.inv(camera.view)[:3, 3], want.eye, atol=1e-6)
        np.testing.assert_allclose(camera.view, want.view, atol=1e-6)
    about_world = example.build(6, "world", document=document).stereo
    for camera, degrees in ((about_world.left, -3), (about_world.right, 3)):
        np.testing.assert_allclose(
            np.linalg.inv(camera.view)[:3, 3], ry(degrees)[:3, :3] @ EYE, atol=1e-6
        )
        want = Look(EYE, (0, 0, 0), 45, 1, 100, SIZE).view @ ry(-degrees)
        np.testing.assert_allclose(camera.view, want, atol=1e-6)
    ups = [
        [np.asarray(camera.view)[1, :3] for camera in (stereo.left, stereo.right)]
        for stereo in (program.stereo, about_world)
    ]
    rolled = [np.degrees(np.arccos(min(1.0, float(a @ b)))) for a, b in ups]
    assert rolled[0] < 0.01
    assert rolled[1] == pytest.approx(6 * np.sin(np.arctan2(1.5, 5)), rel=0.01)


def test_other_axes_are_refused():
    with pytest.raises(ValueError, match='axis: expected "view" or "world", got \'x\''):
        example.build(axis="x")  # type: ignore[arg-type]


def test_the_still_has_the_borders_that_the_text_describes(renderer):
    """Light things before the dark: nearer than the target cyan on the left, farther away red on the left."""
    program = example.build()
    picture = example.draw(program, renderer, example.STILL, (256, 256)).astype(int)
    ids = renderer.render(program.scene, program.camera, (256, 256), outputs=("id",)).id
    redder = picture[..., 0] - picture[..., 1]
    assert (np.abs(redder) > 25).mean() > 0.05
    nodes = [node for node in program.scene.nodes if node.mesh is not None]
    for node, sign in ((nodes[3], -1), (nodes[1], 1)):  # the ball, the box
        rows, columns = np.nonzero(ids == node.id)
        assert len(rows) > 0.02 * ids.size
        left, right = [], []
        for row in np.unique(rows):
            ends = columns[rows == row]
            left.append(redder[row, max(ends.min() - 4, 0) : ends.min()].mean())
            right.append(redder[row, ends.max() + 1 : ends.max() + 5].mean())
        assert sign * np.median(left) > 20
        assert sign * np.median(right) < -20
