"""The scenes of `python -m benchmarks.reflections`, and what it measures, on pictures of which the answer is known."""

import math

import numpy as np
import pytest

import cubecam as cc
from benchmarks.reflections import measure
from benchmarks.reflections.reflectors import REFLECTORS, World
from benchmarks.reflections.scenes import FOLDER, PLACES
from benchmarks.reflections.stage import PLACE
from benchmarks.reflections.table import Case, Row, cases, markdown
from tests.scenes_equal import assert_scenes_equal

ALL = np.ones((4, 5), bool)


class TestScenes:
    @pytest.mark.parametrize("name", PLACES)
    def test_the_file_is_what_the_code_makes(self, name):
        assert_scenes_equal(cc.load_scene(FOLDER / f"{name}.glb"), PLACES[name].build())

    @pytest.mark.parametrize("name", ["room_a", "room_b"])
    def test_a_room_fills_its_box(self, name):
        bounds = cc.load_scene(FOLDER / f"{name}.glb").bounds
        np.testing.assert_allclose(
            bounds, np.array([PLACES[name].low, PLACES[name].high]), atol=1e-6
        )
        assert (bounds[1] - bounds[0]).round(6).tolist() == [10, 6, 8]

    @pytest.mark.parametrize("name", PLACES)
    def test_the_ball_is_in_view_and_large(self, name):
        """From its middle it reaches over more than half of the way to the frame's edge, and not beyond."""
        scene = cc.load_scene(FOLDER / f"{name}.glb")
        (camera,), (place,) = scene.cameras, scene.find(PLACE)
        assert isinstance(camera, cc.PerspectiveCamera)
        assert camera.target is not None
        away = np.linalg.norm(camera.position - place.position)
        reach = math.tan(math.asin(PLACES[name].radius / away))
        assert 0.6 < reach / math.tan(math.radians(camera.fov / 2)) < 0.95
        np.testing.assert_allclose(camera.target - place.position, 0, atol=1e-12)

    def test_nothing_in_the_rooms_reflects(self):
        for name in PLACES:
            scene = cc.load_scene(FOLDER / f"{name}.glb")
            kinds = {type(node.material) for node in scene.nodes if node.mesh is not None}
            assert kinds == {cc.BasicMaterial}

    @pytest.mark.parametrize("reflector", REFLECTORS)
    def test_reflectors_are_added(self, reflector):
        world = World("room_a", reflector)
        assert len(world.nodes) == (2 if reflector.startswith("facing") else 1)
        assert all(node in world.scene.nodes for node in world.nodes)


class TestColors:
    def test_a_known_difference(self):
        exact = np.full((4, 5, 3), 0.5)
        got = exact.copy()
        got[0, 0, 1] += 0.3
        found = measure.compare(got, exact, ALL)
        assert found.rmse == pytest.approx(0.3 / math.sqrt(4 * 5 * 3))
        assert found.within == pytest.approx(19 / 20)
        assert found.largest == pytest.approx(0.3)

    def test_pixels_outside_of_the_mask_do_not_count(self):
        exact = np.zeros((4, 5, 3))
        got = exact.copy()
        got[0] = 1
        on = ALL.copy()
        on[0] = False
        assert measure.compare(got, exact, on) == measure.Colors(0, 1, 0)

    def test_four_steps_are_within_and_five_are_not(self):
        exact = np.zeros((4, 5, 3))
        assert measure.compare(exact + 4 / 255, exact, ALL).within == 1
        assert measure.compare(exact + 5 / 255, exact, ALL).within == 0

    def test_what_a_screen_shows(self):
        color = np.array([[[-1, 0.5, 7, 1]]])
        np.testing.assert_array_equal(measure.shown(color, linear=False), [[[0, 0.5, 1]]])
        light = np.array([[[0.002, 0.21404114, 9.0]]])
        expected = [[[0.002 * 12.92, 0.5, 1]]]
        np.testing.assert_allclose(measure.shown(light, linear=True), expected, atol=1e-7)

    def test_the_inner_pixels(self):
        on = np.zeros((5, 6), bool)
        on[1:4, 1:5] = True
        assert np.argwhere(measure.inner(on)).tolist() == [[2, 2], [2, 3]]
        assert not measure.inner(np.ones((2, 9), bool)).any()


class TestHits:
    def test_one_percent_of_the_ray(self):
        position = np.zeros((1, 4, 3))
        hit = np.tile((2.0, 0, 0), (1, 4, 1))
        other = hit + np.array(((0, 0, 0), (0, 0.019, 0), (0, 0.021, 0), (-1, 0, 0)))
        got, exact = ((x / 128 + 1) / 2 for x in (other, hit))
        found = measure.hits_found(got, exact, position, np.ones((1, 4), bool))
        assert found == 0.5

    def test_the_sky(self):
        up = np.array((0, 1.0, 0))
        slightly, much = ((0.0, math.cos(a), math.sin(a)) for a in (0.009, 0.011))
        exact = np.tile(2.5 + up / 2, (1, 4, 1))
        got = np.stack([2.5 + np.array(d) / 2 for d in (up, slightly, much)] + [up])[None]
        found = measure.hits_found(got, exact, np.zeros((1, 4, 3)), np.ones((1, 4), bool))
        assert found == 0.5  # the last one is a point of the scene

    def test_coded_scenes_say_where_things_are(self):
        scene = cc.Scene(background=(1, 0, 0))
        box = scene.add(
            cc.Mesh.box(2), cc.BasicMaterial(), position=(0.5, 0.2, -3), scale=(1, 0.5, 2)
        )
        box.rotation = cc.axis_angle((1, 2, 3), 40)
        mirror = scene.add(cc.Mesh.sphere(0.1), cc.MirrorMaterial(), position=(0, 0, 9))
        measure.code_positions(scene, [mirror])
        assert isinstance(mirror.material, cc.MirrorMaterial)
        camera = cc.PerspectiveCamera(fov=70)
        found = cc.truth.render(scene, camera, (24, 24), samples=1, outputs=("position", "id"))
        on = found.outputs["id"] == box.id
        assert 0.1 < on.mean() < 0.9
        at = (2 * found.color[..., :3].astype(float) - 1) * 128
        np.testing.assert_allclose(at[on], found.outputs["position"][on], atol=1e-4)
        sky = 2 * (found.color[~on][:, :3].astype(float) - 2.5)
        np.testing.assert_allclose(np.linalg.norm(sky, axis=-1), 1, atol=1e-3)
        assert (sky[:, 2] < -0.5).all()  # the camera looks along -Z


class TestTable:
    def test_every_group_begins_with_its_plain_probe(self):
        for quick in (True, False):
            seen: set[Case] = set()
            for case in cases(quick=quick):
                assert case.baseline in seen | {case}
                seen.add(case)

    def test_no_case_is_twice(self):
        for quick in (True, False):
            found = cases(quick=quick)
            assert len(set(found)) == len(found)
        assert len(cases(quick=True)) < len(cases(quick=False))

    def test_markdown(self):
        done = Row(Case("room_a", "mirror", "box"), 0.123, 0.5, 0.25, 0.9, 0.75, 12, 1.5)
        missing = Row(Case("room_a", "facing balls", "plain", bounces=2), missing="no such thing")
        text = markdown([done, missing]).splitlines()
        assert text[2] == (
            "| room_a | mirror | 256 |  | box | 0.1230 | 0.50 | 25.0% | 75.0% | 1.5 x (12 ms) |"
        )
        assert text[3].startswith("| room_a | facing balls | 256 | 2 | plain | not yet: no such")
        assert len({line.count("|") for line in text}) == 1
