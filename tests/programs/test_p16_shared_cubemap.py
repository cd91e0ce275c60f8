"""P16: the error of a shared cubemap grows with the distance; a cubemap for each ball is nearer to the truth."""

import sys

import numpy as np
import pytest

from cubecam.examples import shared_cubemap as example
from cubecam.truth import shading
from tests.programs.oracle import GREY, Look, lit, mesh, moved, quad, scaled
from tests.reference import raycast
from tests.reference.raycast import interior

SIZE = (128, 64)
GOLD = np.array([0.95, 0.85, 0.4])


def exact(program, distance):
    """The exact picture: each ray is reflected by the ball's surface, and Phong shades the point that it hits."""
    ground, bunny, teapot = program.scene.nodes[:3]
    around = [
        quad(ground, 10, moved(-1, -2, 4)),
        mesh(bunny, moved(-0.9, -0.5, -2), ("bunny", 1.2)),
        mesh(teapot, moved(0.7, -1.2, 1.9), ("teapot", 1.2)),
    ]
    colors = {ground.id: (0.4, 0.4, 1), bunny.id: (0.4, 1, 0.4), teapot.id: (1, 0.4, 0.4)}
    balls = [
        mesh(ball, moved(x, 0, 0) @ scaled(0.3))
        for ball, x in zip(program.balls, (-distance, 0, distance), strict=True)
    ]
    look = Look((0, 0.9, 3.2), (0, 0, 0), 45, 1, 100, SIZE)
    hits = look.hits([*around, *balls])
    color = lit(hits, colors, look.eye)
    on_ball = np.isin(hits.id, [ball.id for ball in balls])
    start = hits.position[on_ball]
    bounced = shading.reflect(look.directions()[on_ball], hits.normal[on_ball])
    ends = raycast.cast(around, start, bounced)
    light = np.broadcast_to(GREY, start.shape).copy()
    for number, paint in colors.items():
        rows = ends.id == number
        light[rows] = shading.phong(
            ends.position[rows], ends.normal[rows], start[rows], paint, [shading.Point((5, 5, 5))]
        )
    color[on_ball] = 0.78 * light + 0.3 * GOLD
    return color, hits


def error(program, renderer, distance, whose, truth, hits):
    example.place(program, distance)
    example.share(program, whose)
    got = renderer.render(program.scene, program.camera, SIZE, format="rgba32f").color[..., :3]
    neighbours = np.isin(hits.id, [program.balls[0].id, program.balls[2].id])
    inside = interior(hits.id) & neighbours
    assert inside.sum() > 40
    return np.abs(got - truth)[inside].mean()


@pytest.mark.slow
def test_shared_grows_and_own_is_smaller(renderer):
    program = example.build(probe_size=64, probe_format="rgba32f", document=True)
    shared, own = [], []
    for distance in (0.65, 1.2, 2.0):
        truth, hits = exact(program, distance)
        shared.append(error(program, renderer, distance, "shared", truth, hits))
        own.append(error(program, renderer, distance, "own", truth, hits))
    assert shared[0] < shared[1] < shared[2]
    assert shared[2] > 1.5 * shared[0]
    assert all(mine < theirs for mine, theirs in zip(own, shared, strict=True))
    assert own[2] < 0.4 * shared[2]


@pytest.mark.slow
def test_the_truth_of_the_package_is_that_of_the_reference():
    pytest.importorskip("embreex")
    program = example.build(probe_size=8, document=True)
    for distance in (0.65, 1.7):
        example.place(program, distance)
        found = example.truth(program, SIZE)
        want, hits = exact(program, distance)
        mask = interior(hits.id)
        np.testing.assert_array_equal(found.id[mask], hits.id[mask])
        difference = np.abs(found.color[..., :3] - want)[mask]
        assert difference.mean() < 1e-4
        assert np.quantile(difference, 0.99) < 1e-4
        assert (found.color[..., 3] == 1).all()


def test_errors_over_distance(renderer):
    pytest.importorskip("embreex")
    program = example.build(probe_size=64, probe_format="rgba32f", document=True)
    found = example.error_over_distance(program, renderer, (0.65, 1.2, 2.0), size=(256, 128))
    assert found.distance.tolist() == [0.65, 1.2, 2.0]
    assert (np.diff(found.shared) > 0).all()
    assert (found.own < found.shared).all()
    assert found.own[2] < 0.4 * found.shared[2]


def test_without_embreex_the_message_says_what_to_install(monkeypatch):
    for name in ("embreex", "embreex.mesh_construction", "embreex.rtcore_scene"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=r"embreex.*pip install \"cubecam\[truth\]\""):
        example.truth(example.build(probe_size=8, document=True), (8, 4))


def test_one_probe_serves_three_balls(fresh_renderer):
    program = example.build(probe_size=16, document=True)
    camera = program.camera
    example.share(program, "shared")
    fresh_renderer.render(program.scene, camera, (32, 16))
    assert fresh_renderer.stats.probes_updated == 1
    example.share(program, "own")
    fresh_renderer.render(program.scene, camera, (32, 16))
    assert fresh_renderer.stats.probes_updated == 2  # the middle ball's probe is up to date already


def test_what_is_shown(renderer):
    program = example.build(probe_size=32, document=True)
    size, frame = (64, 64), 30
    both = example.draw(program, renderer, frame, size=size)
    assert both.shape == (64, 64, 4)
    pictures = {}
    for whose in ("shared", "own"):
        example.share(program, whose)
        pictures[whose] = renderer.render(program.scene, program.camera, (64, 32)).color
    np.testing.assert_array_equal(both, np.concatenate([pictures["shared"], pictures["own"]]))
    apart = example.draw(program, renderer, frame, size=size, show="difference")
    want = np.abs(pictures["shared"].astype(int) - pictures["own"])
    np.testing.assert_array_equal(apart[32:, :, :3], want[..., :3])
    assert (apart[..., 3] == 255).all()
    # The middle ball shows its own probe in both; only the neighbours differ.
    columns = np.flatnonzero(want[..., :3].any(axis=(0, 2)))
    assert len(columns)
    assert not ((columns > 24) & (columns < 40)).any()


@pytest.mark.parametrize(("frame", "distance"), [(0, 0.65), (30, 2.0), (60, 0.65), (15, 1.325)])
def test_the_balls_move_apart_and_together(renderer, frame, distance):
    program = example.build(probe_size=8, document=True)
    example.draw(program, renderer, frame, size=(8, 8))
    assert [ball.position.tolist() for ball in program.balls] == [
        [pytest.approx(x), 0, 0] for x in (-distance, 0, distance)
    ]


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda p, r: example.draw(p, r, 0, show="truth"), "show: expected .*'truth'"),  # type: ignore[arg-type]
        (lambda p, r: example.share(p, "mine"), "whose: expected .*'mine'"),  # type: ignore[arg-type]
    ],
)
def test_unknown_words_are_refused(renderer, call, text):
    with pytest.raises(ValueError, match=text):
        call(example.build(probe_size=8, document=True), renderer)


def test_numbers_of_the_document():
    program = example.build(document=True)
    for probe in program.probes:
        assert (probe.size, probe.near, probe.far, probe.format) == (256, 1, 100, "rgba8")
        assert probe.depth_format == "depth_component16"


def test_the_staged_still_is_the_difference_picture(renderer):
    """Below is twice the difference: black but on the neighbours, and bright on a good part of these."""
    program = example.build()
    size, half = (256, 256), (256, 128)
    got = example.draw(program, renderer, example.STILL, size=size, labels=False)
    pictures = {}
    for whose in ("shared", "own"):
        example.share(program, whose)
        pictures[whose] = renderer.render(program.scene, program.camera, half).color
    np.testing.assert_array_equal(got[:128], pictures["shared"])
    want = 2 * np.abs(pictures["shared"].astype(int) - pictures["own"])[..., :3]
    np.testing.assert_array_equal(got[128:, :, :3], np.minimum(want, 255))
    ids = renderer.render(program.scene, program.camera, half, outputs=("id",)).id
    neighbours = np.isin(ids, [program.balls[0].id, program.balls[2].id])
    assert not want[~neighbours].any()
    assert (want[neighbours].max(axis=-1) > 50).mean() > 0.3
    assert neighbours.mean() > 0.15


def test_labels_are_two_lines_of_text(renderer):
    program = example.build(probe_size=16)
    for show in ("difference", "both", None):
        plain = example.draw(program, renderer, 0, size=(256, 256), show=show, labels=False)
        named = example.draw(program, renderer, 0, size=(256, 256), show=show)
        rows = np.flatnonzero((plain != named).any(axis=(1, 2)))
        assert rows.min() < 20
        assert rows.max() > 235
        assert ((rows < 30) | (rows > 225)).all()


def test_the_error_of_the_staged_scene(renderer):
    """Photographs, tiles and shadows are those of the renderer: where no ball is, there is no error but at edges."""
    program = example.build(probe_size=256)
    size, half = (192, 192), (192, 96)
    got = example.draw(program, renderer, example.STILL, size=size, show="error", labels=False)
    example.place(program, example.distance(program, example.STILL))
    exact = example.truth(program, half)
    balls = np.isin(exact.id, [ball.id for ball in program.balls])
    inside = interior(exact.id, radius=2)
    neighbours = inside & np.isin(exact.id, [program.balls[0].id, program.balls[2].id])
    shared, own = (part[..., :3].max(axis=-1) for part in (got[:96], got[96:]))
    assert np.median(shared[inside & ~balls]) <= 4
    assert own[neighbours].mean() < 0.9 * shared[neighbours].mean()
    assert neighbours.mean() > 0.1


# ----- methods of parallax


@pytest.mark.parametrize("document", [False, True])
def test_a_method_is_that_of_all_probes_and_can_be_taken_back(document):
    classic = example.build(document=document)
    program = example.build(document=document, method="layers")
    assert [probe.parallax for probe in program.probes] == ["layers"] * 3
    for method in (*example.METHODS, "none"):
        example.correct(program, method)
        assert program.method == method
        assert [probe.parallax for probe in program.probes] == [method] * 3
    for probe, want in zip(program.probes, classic.probes, strict=True):
        assert probe.depth_format == want.depth_format
    assert classic.method == "none"


def test_the_proxy_ends_at_the_floor():
    for document, height in ((False, -example.SITTING), (True, -2)):
        program = example.build(document=document, method="box")
        box, mesh = program.probes[0].box, program.ground.mesh
        assert box is not None
        assert mesh is not None
        low, high = box
        edge = np.abs(mesh.positions).max()  # half of it, since the plane is centred
        middle = program.ground.world_matrix[:3, 3]
        np.testing.assert_allclose(low[[0, 2]], (middle - edge)[[0, 2]])
        np.testing.assert_allclose(high[[0, 2]], (middle + edge)[[0, 2]])
        assert low[1] == middle[1] == pytest.approx(height)


@pytest.mark.slow
def test_methods_bring_the_shared_cubemap_nearer_to_the_truth(renderer):
    """The floor is the box's bottom; a march finds figures, too, and two layers what these hide."""
    pytest.importorskip("embreex")
    program = example.build(probe_size=128, probe_format="rgba32f")
    apart = (program.nearest + program.farthest) / 2
    found = {}
    for method in example.METHODS:
        example.correct(program, method)
        found[method] = example.error_over_distance(program, renderer, (apart,), size=(192, 96))
    shared = {method: float(one.shared[0]) for method, one in found.items()}
    own = {method: float(one.own[0]) for method, one in found.items()}
    assert shared["layers"] < 0.5 * shared["none"]
    assert shared["layers"] <= shared["distance"] * 1.02 < shared["box"]
    assert shared["box"] < shared["none"]
    assert own["layers"] < 0.3 * own["none"]
    # One for all by a march is better than one for each without.
    assert shared["layers"] < own["none"]


def test_the_label_names_the_method(renderer):
    program = example.build(probe_size=16)
    columns = {}
    for method in ("none", "layers"):
        example.correct(program, method)
        plain, named = (
            example.draw(program, renderer, 0, size=(512, 256), labels=one) for one in (False, True)
        )
        changed = (plain != named)[:40].any(axis=(0, 2))  # the line at the top
        columns[method] = np.flatnonzero(changed).max()
    assert columns["none"] < columns["layers"] < 511


def test_an_unknown_method_is_refused():
    with pytest.raises(ValueError, match=r"method: expected one of none, box, .*, got 'ray'"):
        example.build(method="ray")  # type: ignore[arg-type]
