"""The calls `truth.render` and `truth.capture`: what they take, give, refuse, and when they end."""

import os
import signal
import sys
import time

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth import drawing, workers
from tests.helpers import run_python

SIZE = (16, 12)


def noisy():
    """A rough floor in the light of a small sun, beside a glass ball."""
    faces = np.full((6, 8, 8, 3), 0.1, np.float32)
    faces[2, 3, 3] = 100
    scene = cc.Scene(environment=cc.CubeMap(faces))
    scene.add(
        cc.Mesh.plane(4, 4), cc.StandardMaterial(metallic=0, roughness=0.4), position=(0, -1, 0)
    )
    scene.add(cc.Mesh.sphere(0.6, 24, 12), cc.GlassMaterial())
    return scene


def camera():
    return cc.PerspectiveCamera(position=(0, 1, 4), target=(0, 0, 0))


def rendered(scene=None, **options):
    return cc.truth.render(scene or noisy(), camera(), SIZE, **{"processes": 1, **options})


def test_what_a_picture_has():
    picture = rendered(samples=20, outputs=("id", "distance", "normal", "position", "z", "label"))
    assert picture.color.shape == (12, 16, 4)
    assert picture.color.dtype == np.float32
    assert np.array_equal(np.asarray(picture), picture.color)
    assert isinstance(picture.frame, cc.Frame)
    assert (picture.size, picture.encoding) == (SIZE, "linear")
    assert picture.complete
    assert (picture.samples == 20).all()
    assert picture.seconds > 0
    kinds = {name: array.dtype.name for name, array in picture.outputs.items()}
    assert kinds == {
        "id": "int32", "label": "int32", "distance": "float32", "z": "float32", "normal": "float32",
        "position": "float32",
    }  # fmt: skip
    nothing = picture.id == 0
    assert nothing.any()
    assert np.isposinf(picture.distance[nothing]).all()
    assert np.isnan(picture.position[nothing]).all()
    assert (picture.normal[nothing] == 0).all()
    with pytest.raises(AttributeError):
        _ = picture.no_such_thing


def test_the_deviation_is_that_of_many_pictures():
    """The spread of pictures of different seeds is at most the one that each of them states."""
    pictures = [rendered(samples=16, seed=seed) for seed in range(24)]
    luminance = [p.color[..., :3] @ [0.2126, 0.7152, 0.0722] for p in pictures]
    spread = np.sqrt(np.mean(np.var(luminance, axis=0, ddof=1)))
    stated = np.sqrt(np.mean([p.deviation.astype(float) ** 2 for p in pictures]))
    assert 0.5 * stated < spread < 1.2 * stated
    assert not np.array_equal(pictures[0].color, pictures[1].color)


def test_noise_falls_with_samples():
    few, many = rendered(samples=16), rendered(samples=256)
    assert many.noise < few.noise / 2


def test_the_same_seed_gives_the_same_bytes_in_any_number_of_processes(monkeypatch):
    from cubecam.truth import work

    monkeypatch.setattr(work, "PATHS", 512)  # several pieces
    alone = rendered(samples=24, seed=5)
    again = rendered(samples=24, seed=5)
    shared = rendered(samples=24, seed=5, processes=2)
    for other in (again, shared):
        assert other.color.tobytes() == alone.color.tobytes()
        assert other.deviation.tobytes() == alone.deviation.tobytes()
    monkeypatch.setattr(work, "PATHS", 1 << 16)
    assert rendered(samples=24, seed=5).color.tobytes() == alone.color.tobytes()


def test_a_target_ends_a_picture_early():
    target = rendered(samples=16).noise * 0.6
    picture = rendered(samples=4096, target_error=target)
    assert picture.complete
    assert picture.noise <= target
    assert 16 < picture.samples.max() < 4096
    missed = rendered(samples=16, target_error=1e-6)
    assert not missed.complete
    assert missed.noise > 1e-6


def test_a_deadline_ends_a_picture():
    picture = rendered(samples=65536, deadline=0.2)
    assert not picture.complete
    assert 0.2 < picture.seconds < 20
    assert 0 < picture.samples.max() < 65536
    assert np.isfinite(picture.color).all()


def test_ctrl_c_gives_what_is_done(monkeypatch):
    original = workers.Workers.draw
    passes = []

    def draw(self, pieces):
        for piece in original(self, pieces):
            passes.append(piece)
            if len(passes) == 3:
                os.kill(os.getpid(), signal.SIGINT)
                time.sleep(5)  # the signal arrives here
            yield piece

    monkeypatch.setattr(workers.Workers, "draw", draw)
    monkeypatch.setattr(drawing, "_PASS_PATHS", 0)  # passes of 16 samples
    picture = rendered(samples=160)
    assert not picture.complete
    assert (picture.samples == 32).all()  # the third pass was not yet added
    assert np.array_equal(picture.color, rendered(samples=160, target_error=1e9).color) is False


def test_a_worker_that_dies_is_an_error(monkeypatch):
    made = []
    original = workers.Workers.__enter__

    def enter(self):
        result = original(self)
        made.extend(self._processes)
        self._processes[0].kill()
        return result

    monkeypatch.setattr(workers.Workers, "__enter__", enter)
    with pytest.raises(RuntimeError, match=r"a worker process ended with SIGKILL; expected"):
        rendered(samples=64, processes=2)
    assert not any(process.lives for process in made)


def test_a_script_needs_no_guard(tmp_path):
    """The processes do not run the user's script again, unlike those of multiprocessing."""
    script = tmp_path / "picture.py"
    script.write_text(
        "import cubecam as cc\n"
        "print('once')\n"
        "scene = cc.Scene(background=(1, 0, 0))\n"
        "found = cc.truth.render(scene, cc.PerspectiveCamera(), (8, 8), samples=4, processes=2)\n"
        "print(found.color[0, 0].tolist())\n"
    )
    code = f"import runpy; runpy.run_path({str(script)!r}, run_name='__main__')"
    assert run_python(code).stdout.split("\n")[:2] == ["once", "[1.0, 0.0, 0.0, 1.0]"]


def test_the_bar_is_shown_on_demand(capsys):
    rendered(samples=1, progress=True)
    rendered(samples=1, progress=False)
    rendered(samples=1)
    assert capsys.readouterr().out == ""


def test_a_cube_has_what_a_cubemap_has(tmp_path):
    cube = cc.truth.capture(noisy(), (0, 1, 0), 8, samples=4, outputs=("id",), processes=1)
    assert isinstance(cube.cube, cc.CubeMap)
    assert cube.faces.shape == (6, 8, 8, 4)
    assert cube.deviation.shape == cube.samples.shape == cube.id.shape == (6, 8, 8)
    assert cube.sample((0, 1, 0)).shape == (4,)
    cube.save(tmp_path / "cube.exr", layout="cross")
    assert (tmp_path / "cube.exr").stat().st_size > 1000
    assert cube.to_equirect().shape[2] == 4
    assert cc.truth.capture(noisy(), samples=1, size=2, processes=1).size == 2


# --- refusals ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"bounces": -1}, "bounces: expected an int from 0 to 1000, got -1"),
        ({"samples": 0}, "samples: expected an int from 1 to 65536, got 0"),
        ({"seed": 2**32}, "seed: expected an int from 0 to 4294967295, got 4294967296"),
        ({"target_error": 0.0}, "target_error: expected a number above 0, got 0.0"),
        ({"deadline": -1.0}, "deadline: expected a number above 0, got -1.0"),
        ({"processes": 0}, "processes: expected an int from 1 to 1024, got 0"),
        ({"outputs": ("depth",)}, "outputs: expected .*, got 'depth'"),
    ],
)
def test_wrong_numbers(options, message):
    with pytest.raises(ValueError, match=message):
        rendered(**options)
    with pytest.raises(ValueError, match=message):
        cc.truth.capture(noisy(), size=2, **{"processes": 1, **options})


def test_wrong_things():
    with pytest.raises(TypeError, match="outputs: expected a sequence of names, got 'id'"):
        rendered(outputs="id")
    with pytest.raises(TypeError, match=r"camera: expected a Camera, got StereoCamera"):
        cc.truth.render(noisy(), cc.StereoCamera(camera(), camera()), SIZE)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="camera: expected a Camera, got Scene"):
        cc.truth.render(noisy(), noisy(), SIZE)
    with pytest.raises(ValueError, match="size: expected an int of at least 1, got 0"):
        cc.truth.render(noisy(), camera(), (0, 4))
    with pytest.raises(
        ValueError, match=r"near, far: expected 0 < near < far, finite, got 2.0 and 1.0"
    ):
        cc.truth.capture(noisy(), size=2, near=2.0, far=1.0)
    with pytest.raises(
        ValueError, match=r"position: expected 3 numbers, got an array of shape \(2,\)"
    ):
        cc.truth.capture(noisy(), (0, 1), 2)
    with pytest.raises(ValueError, match="rotation: expected a quaternion of a length above 0"):
        cc.truth.capture(noisy(), size=2, rotation=(0, 0, 0, 0))
    with pytest.raises(TypeError, match=r"render\(\) has no option 'sample'"):
        rendered(sample=3)


def test_what_rays_cannot_follow_is_refused_by_name():
    scene = noisy()
    scene.add(
        cc.Mesh.box(1),
        cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1.0); }"),
        name="my box",
    )
    with pytest.raises(ValueError, match="my box"):
        rendered(scene)


def test_a_picture_that_shows_itself():
    inner = cc.Scene()
    texture = cc.RenderTexture(inner, camera(), size=(4, 4), name="monitor")
    inner.add(cc.Mesh.box(1), cc.BasicMaterial(map=texture))
    with pytest.raises(
        ValueError, match="render texture 'monitor': expected a picture that does not"
    ):
        rendered(inner, samples=1)


def test_without_embreex(monkeypatch):
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    with pytest.raises(ImportError, match=r'pip install "cubecam\[truth\]"'):
        rendered(samples=1)


def test_an_empty_scene():
    picture = rendered(cc.Scene(background=(0.25, 0.5, 1, 0.5)), samples=3, outputs=("id",))
    assert np.array_equal(
        picture.color, np.broadcast_to(np.array([0.25, 0.5, 1, 0.5], np.float32), (12, 16, 4))
    )
    assert picture.noise == 0
    assert drawing.render is cc.truth.render
