"""`python -m benchmarks.batches` and `.curves`: what they draw, compare and write for tiny fields. No test times."""

import json
from dataclasses import asdict

import numpy as np
import pytest

from benchmarks import batches, curves
from benchmarks.field import GROUND, HEIGHT, Field
from benchmarks.peers.batches_cubecam import Batch, Scenes, Single
from benchmarks.processes import ROOT, CpuWorker
from benchmarks.scene import FACE_FORWARD

TINY = {"nodes": 3, "triangles": 600, "colors": 2, "lights": 2, "probes": 2, "size": 16}
ALL = [*curves.OUTPUTS]


@pytest.fixture
def programs(monkeypatch):
    # It would hold for all tests of this process.
    monkeypatch.setattr("benchmarks.field.keep_freed_memory", lambda: None)
    made = []

    def make(kind, **options):
        made.append(kind(**options))
        return made[-1]

    yield make
    for program in made:
        program.renderer.close()


class TestField:
    def test_options_are_what_is_drawn(self):
        plan = Field.of({**TINY, "outputs": ["distance", "normal"]})
        assert plan.places.shape == (3, 3)
        assert plan.palette.shape == (2, 3)
        assert plan.light_places[:, 3].tolist() == [0, 1]
        assert 3 * len(plan.mesh.indices) == pytest.approx(600, rel=0.2)
        assert np.ptp(plan.mesh.positions, axis=0).max() == pytest.approx(2, rel=1e-4)
        assert np.abs(plan.places[:, [0, 2]]).max() <= GROUND / 2
        assert np.ptp(plan.ground.positions, axis=0).tolist() == [GROUND, 0, GROUND]
        shapes = {name: array.shape for name, array in plan.results(5).items()}
        faces = (5, 6, 16, 16)
        assert shapes == {"faces": (*faces, 4), "distance": faces, "normal": (*faces, 3)}

    def test_places_differ_from_frame_to_frame_and_lie_above_the_objects(self):
        plan = Field(probes=50)
        first, second = plan.positions(0), plan.positions(1)
        assert np.array_equal(first, plan.positions(0))
        assert not np.isclose(first, second).any()
        assert first[:, 1].min() > HEIGHT + plan.radius

    def test_no_object_that_shows_is_culled(self, rng):
        plan = Field(nodes=40, triangles=4000)
        positions = plan.positions(3)[:4]
        seen = plan.seen(positions)
        inside = rng.normal(size=(400, 3))
        inside *= plan.radius / np.linalg.norm(inside, axis=1, keepdims=True)
        kept = 0
        for place, faces in zip(positions, seen, strict=True):
            for forward, nodes in zip(FACE_FORWARD, faces, strict=True):
                kept += len(nodes)
                away = plan.places[:, None] + inside - place
                ahead = away @ np.array(forward, float)
                shows = ((ahead > 0) & (np.abs(away).max(axis=-1) <= ahead)).any(axis=1)
                assert set(np.flatnonzero(shows).tolist()) <= set(nodes)
        assert kept < 4 * 6 * 40 / 2


class TestPrograms:
    @pytest.mark.parametrize("memory", ["recycled", "fresh"])
    def test_a_batch_draws_the_bytes_of_single_captures(self, programs, memory):
        options = {**TINY, "outputs": ALL, "memory": memory}
        batch, single = (programs(kind, **options).arrays(4) for kind in (Batch, Single))
        assert set(batch) == {"faces", *ALL}
        assert batches.same_bytes(batch, single) is None
        assert np.ptp(batch["faces"][..., :3]) > 50
        assert np.isfinite(batch["distance"]).any()
        one = {**single, "faces": single["faces"] + np.uint8(1)}
        assert batches.same_bytes(batch, one) == "faces: other bytes"

    def test_fresh_memory_is_kept_and_recycled_memory_is_not(self, programs):
        for memory, count in (("fresh", 4), ("recycled", None)):
            program = programs(Batch, **TINY, memory=memory)
            program.prepare(0)
            for _ in range(4):
                program.draw(0)
            assert (None if program.kept is None else len(program.kept)) == count

    @pytest.mark.parametrize("peer", curves.PEERS)
    @pytest.mark.parametrize("samples", [1, 4])
    def test_peers_draw_the_same(self, programs, peer, samples):
        if peer not in curves.installed():
            pytest.skip(f"{peer} is not installed")
        if peer in curves.ONE_SAMPLE and samples > 1:
            pytest.skip(f"{peer} has one sample")
        outputs = [] if samples > 1 or peer in curves.COLORS_ALONE else ALL
        options = {**TINY, "outputs": outputs, "samples": samples}
        program = CpuWorker(curves.PEERS[peer], **options)
        try:
            other = batches.arrays_of(program, 2)
        finally:
            program.close()
        own = programs(Single, **options).arrays(2)
        assert batches.difference(own, other) is None

    def test_memory_is_told_at_each_count(self):
        found = Scenes().memory(12, [3, 11])
        assert len(found) == 2
        assert min(found) > 1


class TestComparison:
    def arrays(self):
        faces = np.full((1, 6, 8, 8, 4), 100, np.uint8)
        return {"faces": faces, "distance": np.full((1, 6, 8, 8), np.inf, np.float32)}

    def test_rounding_is_no_difference(self):
        other = self.arrays()
        other["faces"] += np.uint8(batches.STEPS)
        assert batches.difference(self.arrays(), other) is None

    def test_other_colors_numbers_shapes_and_names_are_told(self):
        darker, nearer, smaller = self.arrays(), self.arrays(), self.arrays()
        darker["faces"][0, 2] -= np.uint8(batches.STEPS + 1)
        nearer["distance"][0, 2] = 3
        smaller["distance"] = smaller["distance"][:, :3]
        own = self.arrays()
        assert batches.difference(own, darker) == "faces: 16.67% of the numbers differ"
        assert batches.difference(own, nearer) == "distance: 16.67% of the numbers differ"
        assert "(1, 3, 8, 8)" in str(batches.difference(own, smaller))
        assert "['faces']" in str(batches.difference({"faces": own["faces"]}, own))


def point(curve, value, own, other=None):
    times = {"cubecam": own} | ({} if other is None else {"moderngl": other})
    ratios = {} if other is None else {"moderngl": own / other}
    return curves.Point(curve, value, times, times, ratios, ratios, 0.01, 100)


class TestCurves:
    def test_a_point_has_times_of_the_programs_that_draw_the_same(self):
        curve = curves.Curve("nodes", "node", "", (1,), lambda n: {"nodes": n})
        found, notes = curves.measure(curve, 2, 1, {**TINY, "outputs": []})
        assert found is not None
        assert found.bytes == 2 * 6 * 16 * 16 * 4
        assert found.copy > 0
        assert found.cpu["cubecam"] > 0
        assert found.cpu.keys() == found.wall.keys()
        assert found.cpu_ratio.keys() == found.cpu.keys() - {"cubecam"}
        assert found.cpu.keys() == {"cubecam", *curves.installed()}
        assert notes == []

    def test_what_cubecam_refuses_is_told(self):
        curve = curves.Curve("samples", "sample", "", (1,), lambda n: {"samples": n})
        found, notes = curves.measure(curve, 4096, 1, TINY)
        assert found is None
        assert "samples 4096, cubecam: ValueError: samples: expected" in notes[0]

    def test_a_line_is_found(self):
        xs = np.array([1, 4, 20, 100])
        assert curves.line(xs, 2 + 0.5 * xs) == pytest.approx((2, 0.5))

    def test_relative_errors_count(self):
        # Errors of a tenth at the far end must not move the near end.
        xs = np.array([1, 10, 100, 1000])
        a, b = curves.line(xs, (2 + 0.5 * xs) * [1, 1, 0.9, 1.1])
        assert a == pytest.approx(2, abs=0.1)
        assert b == pytest.approx(0.5, abs=0.02)

    def test_each_curve_has_four_to_six_points(self):
        assert {curve.name for curve in curves.CURVES} >= {"triangles", "face size", "samples"}
        assert all(4 <= len(curve.values) <= 6 for curve in curves.CURVES)
        for curve in curves.CURVES:
            for value in curve.values:
                Field.of({**curves.BASE, **curve.options(value)})

    def test_tables_have_the_numbers(self):
        points = [point("lights", 1, 2.5, 5), point("lights", 2, 3, 6), point("lights", 4, 4)]
        lines = curves.lines_markdown(points).splitlines()
        others = (len(curves.PEERS) - 1) * "|  "  # have no numbers
        assert lines[2] == f"| lights | 20 teapots | 2 + 0.5 | 4 + 1 {others}| light |"
        rows = curves.points_markdown(points).splitlines()
        assert rows[3] == f"| lights | 2 | 3 / 3 | 6 / 6 {others}| 0.5 {others}| 0.01 |"
        assert rows[4] == f"| lights | 4 | 4 / 4 |  {others}|  {others}| 0.01 |"

    def test_a_run_is_a_file_of_the_history(self, tmp_path):
        points = [point("lights", 1, 2.5)]
        found = {"cpu": "x", "gl": "llvmpipe", "zengl": "absent"}
        entry = curves.record(points, ["samples 8: no"], found)
        path = curves.write_history(tmp_path / "new", entry)
        read = json.loads(path.read_text())
        assert read["driver"] == "llvmpipe"
        assert read["machine"] == {"cpu": "x"}
        assert read["points"] == [asdict(points[0])]
        assert read["commit"]
        assert read["time"].endswith("+00:00")

    def test_a_page_keeps_what_is_outside_of_the_marks(self, tmp_path):
        page = tmp_path / "page.md"
        page.write_text(f"a\n{curves.BEGIN}\nold\n{curves.END}\nb\n")
        curves.put_into(page, "new")
        assert page.read_text() == f"a\n{curves.BEGIN}\n\nnew\n\n{curves.END}\nb\n"
        page.write_text("a")
        with pytest.raises(SystemExit, match="expected the marks"):
            curves.put_into(page, "new")

    def test_the_figure_has_a_panel_for_each_curve(self, tmp_path):
        pytest.importorskip("matplotlib")
        path = tmp_path / "curves.svg"
        curves.draw([point("lights", n, n + 1.0, 2.0 * n) for n in (1, 2, 4)], path)
        text = path.read_text()
        assert all(f">{curve.name}<" in text for curve in curves.CURVES)
        assert all(name in text for name in curves.STYLES)

    def test_the_page_has_all_curves(self):
        page = (ROOT / "docs/explanation/cost_curves.md").read_text()
        table = page.partition(curves.BEGIN)[2].partition(curves.END)[0]
        assert all(f"| {curve.name} |" in table for curve in curves.CURVES)
        assert curves.PICTURE.name in page
