"""Pages of captures and pictures: their programs give what the pages say."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
import zarr

import cubecam as cc
from cubecam.plot import EDGE_NAMES, seam_ratios
from tests.compare import assert_close
from tests.documents import fenced, text_of
from tests.howto.pages import printed
from tests.reference.cube_faces import unit_texel_directions


def measured(picture):
    """The mean and the spread of an 8-bit picture's colours, in 0..1."""
    colors = picture[..., :3] / 255
    return colors.mean(), colors.std()


def stored(data: zarr.Group, name: str) -> zarr.Array:
    """The array of this name in a group, not yet read."""
    array = data[name]
    assert isinstance(array, zarr.Array)
    return array


def bad_edges(cube):
    return [name for name, ratio in zip(EDGE_NAMES, seam_ratios(cube), strict=True) if ratio > 2.5]


@pytest.mark.slow
class TestSeams:
    NAME = "docs/howto/seams.md"

    def test_the_edges_are_those_that_the_page_prints(self, pages):
        _, scope = pages(self.NAME)
        cubes = (scope[name] for name in ("right", "mirrored", "moved"))
        assert [str(bad_edges(cube)) for cube in cubes] == printed(self.NAME).splitlines()
        assert seam_ratios(scope["right"]).max() < 1.5

    def test_the_picture_shows_something(self, pages):
        folder, _ = pages(self.NAME)
        mean, spread = measured(cc.load_image(folder / "seams.png"))
        assert 0.5 < mean < 0.99
        assert spread > 0.1

    def test_what_the_questions_say_is_true(self, pages, tmp_path):
        _, scope = pages(self.NAME)
        path = str(tmp_path / "{face}.png")
        scope["right"].save(path)
        with pytest.warns(cc.ConventionWarning, match="convention='gl', and it is read"):
            bad = bad_edges(cc.load_cubemap(path, convention="inside"))
        assert bad == [name for name in EDGE_NAMES if "Z" in name]
        with pytest.warns(cc.ConventionWarning):
            assert bad_edges(cc.load_cubemap(path, convention="three")) == []


@pytest.mark.slow
class TestRandomScenes:
    NAME = "docs/howto/random_scenes.md"

    def test_the_arrays_are_those_of_the_page(self, pages):
        folder, _ = pages(self.NAME)
        data = zarr.open_group(folder / "scenes.zarr", mode="r")
        faces = "(200, 6, 64, 64"
        expected = {
            "faces": (f"{faces}, 4)", "float16"),
            "distance": (f"{faces})", "float32"),
            "id": (f"{faces})", "int32"),
            "label": (f"{faces})", "int32"),
        }
        for name, (shape, dtype) in expected.items():
            array = stored(data, name)
            assert (str(array.shape), str(array.dtype)) == (shape, dtype)
            assert f"| `{name}` | {shape} | {dtype} |" in text_of(self.NAME)
            assert array.chunks == (1, *array.shape[1:])
        assert dict(data.attrs)["convention"] == "gl"
        for name in ("place", "kind", "color"):
            assert stored(data, name).shape[:2] == (200, 12)

    @pytest.mark.parametrize("index", [0, 7, 199])
    def test_a_scene_built_again_from_the_file_gives_the_same_numbers(self, index, pages):
        folder, scope = pages(self.NAME)
        data = zarr.open_group(folder / "scenes.zarr", mode="r")
        scene = cc.Scene(background=scope["sky"])
        scene.add(cc.DirectionalLight((-1, -2, -1)))
        for kind, color, place in zip(
            *(data[n][index] for n in ("kind", "color", "place")), strict=True
        ):
            scene.add(
                scope["meshes"][kind], cc.PhongMaterial(color=color), position=place, label=kind + 1
            )
        with cc.Renderer() as renderer:
            cube = renderer.capture(
                scene, size=64, format="rgba16f", outputs=("distance", "id", "label")
            )
        np.testing.assert_array_equal(data["faces"][index], cube.faces)
        np.testing.assert_array_equal(data["distance"][index], cube.distance)
        np.testing.assert_array_equal(data["id"][index], cube.id)
        np.testing.assert_array_equal(data["label"][index], cube.label)

    def test_ids_and_distances_belong_to_the_things(self, pages):
        folder, _ = pages(self.NAME)
        data = zarr.open_group(folder / "scenes.zarr", mode="r")
        ids, distance, label, kind, place = (
            np.asarray(stored(data, name)[:50])
            for name in ("id", "distance", "label", "kind", "place")
        )
        assert ids.min() == 0
        assert ids.max() == 12
        assert ((ids == 0) == np.isinf(distance)).all()
        assert 0.05 < (ids > 0).mean() < 0.6
        kinds = np.take_along_axis(kind, np.maximum(ids - 1, 0).reshape(50, -1), axis=1)
        expected = np.where(ids == 0, 0, kinds.reshape(ids.shape) + 1)
        np.testing.assert_array_equal(label, expected)
        away = np.linalg.norm(place, axis=-1)
        for sample in range(50):
            for k in np.unique(ids[sample][ids[sample] > 0]):
                seen = distance[sample][ids[sample] == k]
                assert (
                    np.abs(seen - away[sample, k - 1]).max() < 0.9
                )  # the largest radius of a thing

    def test_the_picture_shows_something(self, pages):
        folder, _ = pages(self.NAME)
        mean, spread = measured(cc.load_image(folder / "sample.png"))
        assert 0.3 < mean < 0.99
        assert spread > 0.1


@pytest.mark.slow
class TestReflection:
    NAME = "docs/howto/reflection.md"

    def test_the_directions_and_faces_are_those_of_the_page(self, pages):
        _, scope = pages(self.NAME)
        (up, above), (right, beside) = scope["found"]
        np.testing.assert_allclose(up, (0, 1, 0), atol=1e-6)
        np.testing.assert_allclose(right, (1, 0, 0), atol=1e-6)
        assert [texel.places["gl"].face for texel in (above, beside)] == ["+Y", "+X"]

    def test_the_picture_shows_both(self, pages):
        folder, _ = pages(self.NAME)
        picture = cc.load_image(folder / "reflection.png")
        assert picture.shape == (1200, 960, 3)
        assert (picture[:600] != picture[600:]).any(axis=-1).mean() > 0.02


@pytest.mark.slow
class TestSeveralProbes:
    NAME = "docs/howto/several_probes.md"

    def test_the_rooms_are_lit_as_the_page_says(self, pages):
        _, scope = pages(self.NAME)
        lit, door, dark = (strip.astype(float) / 255 for strip in scope["strips"])
        assert lit.mean() > door.mean() > dark.mean() > 0.02
        grid = scope["scene"].probe_grid
        assert grid.active.size == 108
        light = grid.coefficients[..., 0, :].mean(axis=(0, 1, 3))
        assert light[0] > 5 * light[-1] > 0  # from the lit room to the dark one

    def test_leaving_out_visibility_leaks(self, pages):
        _, scope = pages(self.NAME)
        scene, ball = scope["scene"], scope["ball"]
        camera = cc.PerspectiveCamera(position=(2, 1.5, -1.5), target=(0.1, 1.5, -1.5), fov=50)
        ball.visible = False
        means = []
        with cc.Renderer() as renderer:
            for visibility in (True, False):
                scene.probe_grid.visibility = visibility
                means.append(
                    renderer.render(scene, camera, (40, 30), format="rgba32f").color[..., :3].mean()
                )
        assert means[1] > 1.8 * means[0]


@pytest.mark.slow
class TestPlots:
    NAME = "docs/howto/plots.md"

    def test_the_picture_shows_six_plots(self, pages):
        folder, scope = pages(self.NAME)
        picture = cc.load_image(folder / "plots.png")
        height, width = picture.shape[0] // 3, picture.shape[1] // 2
        for row in range(3):
            for column in range(2):
                part = picture[row * height :, column * width :][:height, :width]
                mean, spread = measured(part)
                assert 0.2 < mean < 0.98
                assert spread > 0.1
        assert len(scope["figure"].axes) == 9  # six plots and three bars

    def test_the_table_names_all_functions(self):
        named = set(re.findall(r"^\| `(\w+)\(", text_of(self.NAME), flags=re.MULTILINE))
        assert named == set(cc.plot.__all__) - {
            "EDGE_NAMES", "seam_steps", "inner_steps", "seam_ratios",
        }  # fmt: skip


@pytest.mark.slow
class TestOwnPictures:
    NAME = "docs/howto/own_pictures.md"

    def test_panorama_and_six_faces_show_the_same_photograph(self, pages):
        _, scope = pages(self.NAME)
        # The stand-in went through the tone curve once, so it is not mapped again.
        first, again = (
            cc.to_screen(scope[name].resize(512), tonemap=None).astype(int)
            for name in ("panorama", "six")
        )
        original = cc.to_screen(scope["forest"]).astype(int)
        assert np.abs(first - original).mean() < 6
        np.testing.assert_array_equal(again, original)

    def test_the_picture_is_neither_pale_nor_dark(self, pages):
        folder, scope = pages(self.NAME)
        picture = cc.load_image(folder / "ball.png")
        assert picture.shape[:2] == (360, 480)
        mean, spread = measured(picture)
        assert 0.2 < mean < 0.6
        assert spread > 0.18
        # Without srgb=True the same picture is much brighter.
        scope["scene"].environment = cc.load_environment(folder / "forest.jpg")
        with cc.Renderer() as renderer:
            pale = renderer.render(scope["scene"], scope["camera"], **scope["look"])
        assert measured(cc.to_screen(pale, exposure=0.3))[0] > mean + 0.15

    def test_the_head_goes_round_in_the_animation(self, pages):
        from PIL import Image as Picture

        folder, _ = pages(self.NAME)
        with Picture.open(folder / "turn.gif") as film:
            assert film.n_frames == 24
            assert film.info["duration"] == 80
            centers = []
            for index in (0, 8):
                film.seek(index)
                red, green, blue = np.moveaxis(np.asarray(film.convert("RGB")).astype(int), -1, 0)
                centers.append(
                    np.nonzero((red > 1.5 * green) & (red > 150) & (blue < 120))[1].mean()
                )
            assert centers[0] > 300
            assert centers[1] < 180

    def test_the_commands_of_the_page_run(self, pages, tmp_path, monkeypatch):
        import shlex
        import shutil

        from click.testing import CliRunner

        from cubecam.cli import app

        folder, _ = pages(self.NAME)
        for path in folder.iterdir():
            shutil.copy(path, tmp_path)
        shutil.copy(cc.sample_data("suzanne.glb"), tmp_path / "model.glb")
        monkeypatch.chdir(tmp_path)
        lines = re.findall(r"^cubecam .*", text_of(self.NAME), flags=re.MULTILINE)
        assert len(lines) == 4
        for line in lines:
            result = CliRunner().invoke(app, shlex.split(line, comments=True)[1:])
            assert result.exit_code == 0, result.output
        assert {"panorama.png", "mirror.png", "model.exr"} <= {p.name for p in tmp_path.iterdir()}


class TestCameras:
    NAME = "docs/howto/cameras.md"

    def test_it_prints_what_the_page_says(self, pages):
        _, scope = pages(self.NAME)
        apart, wrong = (np.abs(scope[name]).max() for name in ("apart", "wrong"))
        assert f"{apart:.2f} pixels, {wrong:.4f} metres apart\n" == printed(self.NAME)
        assert len(scope["pixels"]) > 3000
        assert set(np.unique(scope["frame"].label)) == {0, 1, 2, 3}

    def test_the_points_of_the_cube_are_its_positions(self, pages):
        _, scope = pages(self.NAME)
        cube = scope["cube"]
        seen = cube.label > 0
        assert 0.05 < seen.mean() < 0.8
        np.testing.assert_allclose(scope["points"][seen], cube.position[seen], atol=1e-5)

        np.testing.assert_allclose(scope["rays"], unit_texel_directions(64), atol=1e-12)

    def test_the_files_hold_all_arrays(self, pages):
        folder, scope = pages(self.NAME)
        held = dict(np.load(folder / "frame.npz"))
        assert set(held) == {"color", "K", "extrinsics", *scope["wanted"]}
        assert set(np.load(folder / "cube.npz")) == {"faces", "rays", *scope["wanted"]}

    def test_dlpack_gives_the_shapes_of_the_page(self, pages):
        _, scope = pages(self.NAME)
        assert np.from_dlpack(scope["frame"]).shape == (240, 320, 4)
        assert np.from_dlpack(scope["cube"]).shape == (6, 64, 64, 4)


@pytest.mark.slow
class TestGlbInAProbe:
    NAME = "docs/howto/glb_in_a_probe.md"

    def test_the_picture_is_neither_dark_nor_clipped(self, pages):
        folder, _ = pages(self.NAME)
        picture = cc.load_image(folder / "ball.png")
        assert picture.shape[:2] == (600, 800)
        mean, spread = measured(picture)
        assert 0.25 < mean < 0.75
        assert spread > 0.15
        assert (picture[..., :3] < 12).mean() < 0.1
        assert (picture[..., :3] > 250).mean() < 0.12

    def test_the_probe_shows_the_model_where_it_is_and_the_photograph_elsewhere(self, pages):
        _, scope = pages(self.NAME)
        probe, scene, ball = scope["probe"], scope["scene"], scope["ball"]
        model = scope["suzanne"]
        towards = model.position - ball.position
        here, photo = probe.sample(towards)[:3], scene.environment.sample(towards)
        assert np.abs(here - photo).max() > 0.1
        assert here[1] > here[0]  # turquoise
        away = np.array([[1, 0.2, -1], [0, 1, 0], [0, 0.1, -1]])
        photo = scene.environment.sample(away)
        difference = np.abs(probe.sample(away)[:, :3] - photo)
        assert (difference / np.maximum(photo, 0.1)).max() < 0.05

    def test_the_panorama_holds_the_light_of_the_probe(self, pages):
        folder, scope = pages(self.NAME)
        light = cc.load_image(folder / "panorama.exr")
        np.testing.assert_array_equal(light, scope["probe"].to_equirect())
        assert light[..., :3].max() > 1
        shown = cc.load_image(folder / "panorama.png")
        assert shown.shape[:2] == light.shape[:2] == (1024, 2048)
        mean, spread = measured(shown)
        assert 0.2 < mean < 0.75
        assert spread > 0.15

    def test_the_ball_shows_the_model(self, pages):
        """Without the probe the pixels of the ball change, and all others stay."""
        _, scope = pages(self.NAME)
        scene, camera, ball = scope["scene"], scope["camera"], scope["ball"]
        with cc.Renderer() as renderer:
            size = (200, 150)
            with_probe = renderer.render(scene, camera, size, format="rgba32f", outputs=("id",))
            probe, ball.environment = ball.environment, None
            without = renderer.render(scene, camera, size, format="rgba32f")
            ball.environment = probe
        on_ball = with_probe.id == ball.id
        changed = np.abs(with_probe.color - without.color).max(axis=-1) > 0.05
        assert (changed & on_ball).sum() > 0.01 * on_ball.sum()
        assert_close(
            with_probe.color[~on_ball], without.color[~on_ball], "exact", name="besides the ball"
        )


@pytest.mark.slow
class TestProjections:
    NAME = "docs/howto/projections.md"

    def test_every_picture_shows_the_courtyard(self, pages):
        folder, scope = pages(self.NAME)
        pictures = sorted(folder.glob("*.jpg"))
        assert len(pictures) == 10
        for path in pictures:
            mean, spread = measured(cc.load_image(path))
            assert 0.15 < mean < 0.7
            assert spread > 0.15
        turned = scope["level"].sample([-0.5, 0, -np.sqrt(0.75)])
        assert np.abs(turned - scope["probe"].sample([0, 0, -1])).max() < 0.05

    def test_the_page_names_every_method(self):
        methods = {name for name in dir(cc.CubeMap) if name.startswith("to_")}
        methods -= {"to_convention", "to_equirect", "to_layout"}
        assert methods == set(re.findall(r"^\| `(to_\w+)\(", text_of(self.NAME), re.MULTILINE))


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        "docs/howto/babylon_js.md",
        "docs/howto/blender.md",
        "docs/howto/godot.md",
        "docs/howto/load_scene.md",
        "docs/howto/outputs.md",
        "docs/howto/render.md",
        "docs/howto/save_scene.md",
        "docs/howto/three_js.md",
        "docs/howto/unity.md",
        "docs/howto/view.md",
    ],
)
def test_a_page_without_claims_of_its_own_writes_what_it_names(name, pages):
    """What these pages say of files is tried by tests of the files, and by tests/interop."""
    folder, _ = pages(name)
    assert any(folder.iterdir())


class TestAsynchronous:
    NAME = "docs/howto/asynchronous.md"

    def test_the_program_prints_what_the_page_says(self, pages):
        _, scope = pages(self.NAME)
        mean = scope["brightness"]
        assert printed(self.NAME).strip() == (
            f"{len(mean)} panoramas, none of them black: {min(mean) > 0.1}"
        )
        assert len(scope["around"]) == 20


class TestManyProcesses:
    NAME = "docs/howto/many_processes.md"

    def test_the_program_prints_what_the_page_says(self, pages):
        _, scope = pages(self.NAME)
        batch, moved, same = scope["batch"], scope["moved"], scope["same"]
        assert printed(self.NAME).startswith("CubeMapBatch(100, size=32, ")
        assert printed(self.NAME).endswith(" True\n")
        assert moved.faces.tobytes() == same.faces.tobytes()
        with cc.Renderer() as renderer:  # the threads drew the scene as it is in the end
            again = renderer.capture_many(scope["scene"], scope["places"], 32)
        assert batch.faces.tobytes() == again.faces.tobytes()

    def test_the_script_prints_what_the_page_says(self, tmp_path):
        [code] = fenced(self.NAME, "py")
        path = tmp_path / "scenes.py"
        path.write_text(code, encoding="utf-8")
        done = subprocess.run(
            [sys.executable, str(path)],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            capture_output=True,
            text=True,
            timeout=60,
        )
        assert done.stdout == fenced(self.NAME, "text")[1], done.stderr
