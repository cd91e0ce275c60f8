"""`cubecam doctor --selftest`: it passes on a driver that draws right, and fails for each mistake that it looks for."""

import time
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from cubecam.doctor.drawing import child
from cubecam.doctor.proofs import reference
from cubecam.doctor.proofs.formats import prove_formats
from cubecam.doctor.proofs.measurement import Measurement, worst
from cubecam.doctor.proofs.mirrors import prove_mirrors
from cubecam.doctor.proofs.orientation import prove_orientation
from cubecam.doctor.proofs.run import NAMES, prove, prove_apart
from cubecam.doctor.proofs.seams import prove_seams
from cubecam.doctor.proofs.shader import prove_shader
from cubecam.doctor.system import Ran, System
from tests.fake_system import FakeSystem
from tests.helpers import DEVICE
from tests.reference import cube_faces


class Wrong:
    """A renderer whose results pass through functions that make a mistake."""

    def __init__(self, renderer, capture=None, render=None, probe=None):
        self.renderer = renderer
        self.of_capture, self.of_render, self.of_probe = capture, render, probe

    def capture(self, scene, **options):
        return self._changed(self.renderer.capture(scene, **options), self.of_capture)

    def render(self, scene, camera, size, **options):
        return self._changed(self.renderer.render(scene, camera, size, **options), self.of_render)

    def read_probe(self, probe):
        return self._changed(self.renderer.read_probe(probe), self.of_probe)

    @staticmethod
    def _changed(result, change):
        names = [
            name
            for name in (
                "faces",
                "color",
                "position",
                "normal",
                "distance",
                "z",
                "depth",
                "id",
                "label",
            )
            if getattr(result, name, None) is not None
        ]
        arrays = {name: np.array(getattr(result, name)) for name in names}
        return SimpleNamespace(
            **{name: change(name, a) if change else a for name, a in arrays.items()}
        )


def on_arrays(function, *only):
    """Make a mistake in some of the arrays of a result, or in all."""
    return lambda name, array: function(array) if not only or name in only else array


def failed(measurements):
    return [measured.what for measured in measurements if not measured.passed]


def test_this_driver_passes(renderer):
    found = list(prove(renderer))
    assert [(m.what, m.error, m.failure) for m in found if not m.passed] == []
    assert {measured.name for measured in found} == set(NAMES)


def flipped_face(faces, face, axis):
    faces = faces.copy()
    faces[face] = np.flip(faces[face], axis)
    return faces


SWAPS: dict[str, Callable[[Any], Any]] = {
    "+X and -X exchanged": lambda faces: faces[[1, 0, 2, 3, 4, 5]],
    "all mirrored": lambda faces: faces[:, :, ::-1],
    "all upside down": lambda faces: faces[:, ::-1],
    **{f"face {face} mirrored": partial(flipped_face, face=face, axis=1) for face in range(6)},
    **{f"face {face} upside down": partial(flipped_face, face=face, axis=0) for face in range(6)},
    "all turned": lambda faces: np.rot90(faces, axes=(1, 2)),
    "+Y turned": lambda faces: np.concatenate(
        [faces[:2], np.rot90(faces[2:3], axes=(1, 2)), faces[3:]]
    ),
    "a texel beside": lambda faces: np.roll(faces, 1, axis=2),
    "red and blue exchanged": lambda faces: faces[..., [2, 1, 0, *range(3, faces.shape[-1])]],
}


@pytest.mark.parametrize("mistake", SWAPS)
def test_wrong_faces_fail_the_orientation(renderer, mistake):
    assert failed(prove_orientation(Wrong(renderer, on_arrays(SWAPS[mistake], "faces"))))


@pytest.mark.parametrize("mistake", [name for name in SWAPS if "red" not in name])
def test_wrong_faces_fail_the_seams(renderer, mistake):
    def change(array):
        return SWAPS[mistake](array)

    assert failed(prove_seams(Wrong(renderer, on_arrays(change, "position"))))


def test_a_step_at_an_edge_fails_the_seams(renderer):
    def shift(position):
        position = position.copy()
        position[3, -1] += 0.01
        return position

    steps, _ = prove_seams(Wrong(renderer, on_arrays(shift, "position")))
    assert steps.error == pytest.approx(0.01 * 3**0.5, abs=0.01)
    assert not steps.passed


@pytest.mark.parametrize("name", ["z", "distance", "depth", "normal", "id", "label"])
def test_a_wrong_output_fails_the_formats(renderer, name):
    found = failed(prove_formats(Wrong(renderer, on_arrays(lambda array: array + 1, name))))
    assert found == [{"id": "ids", "label": "labels", "normal": "normals"}.get(name, name)]


def test_a_wrong_type_or_rounding_fails_the_formats(renderer):
    doubles = Wrong(renderer, on_arrays(lambda array: array.astype(np.float64), "faces"))
    assert {what for what in failed(prove_formats(doubles)) if what.endswith("drawn")} == {
        "rgba8, drawn",
        "rgba16f, drawn",
        "rgba32f, drawn",
    }
    # Half floats behind the name of floats.
    rough = Wrong(renderer, on_arrays(lambda a: a.astype(np.float16).astype(a.dtype), "faces"))
    assert "rgba32f, a colour drawn and read" in failed(prove_formats(rough))


def test_faces_of_a_sky_that_come_back_exchanged_fail_the_formats(renderer):
    wrong = Wrong(renderer, on_arrays(SWAPS["+X and -X exchanged"], "faces"))
    assert (
        len([what for what in failed(prove_formats(wrong)) if "to the GPU and back" in what]) == 3
    )


@pytest.mark.parametrize(
    "change",
    [
        lambda color: color[:, ::-1],
        lambda color: color[..., [2, 1, 0, 3]],
        lambda color: color * 1.01,
        lambda color: 1 - color,
    ],
)
def test_a_wrong_reflection_fails_the_mirrors(renderer, change):
    assert (
        "MirrorMaterial"
        in failed(prove_mirrors(Wrong(renderer, render=on_arrays(change, "color"))))[0]
    )


def test_a_picture_without_a_ball_fails_the_mirrors(renderer):
    empty = Wrong(renderer, render=on_arrays(lambda ids: ids * 0, "id"))
    assert "expected a ball" in prove_mirrors(empty)[0].failure


def test_a_probe_that_does_not_follow_fails_the_mirrors(renderer):
    kept = []

    def first(array):
        kept.append(array)
        return kept[0]

    found = prove_mirrors(Wrong(renderer, probe=on_arrays(first)))[1]
    assert not found.passed
    assert "expected other faces after the box moved" in found.failure


def test_a_wrong_colour_fails_the_shader(renderer):
    wrong = Wrong(renderer, render=on_arrays(lambda color: color * 0.99, "color"))
    assert failed(prove_shader(wrong))


def test_a_shader_without_a_trial_fails(renderer):
    class Untried(Wrong):
        def render(self, *arguments, **options):
            import warnings

            from cubecam.doctor.process import UNAVAILABLE

            warnings.warn(f"new GLSL, since {UNAVAILABLE}: no", cc.RendererWarning, stacklevel=1)
            return super().render(*arguments, **options)

    assert "cannot be started" in prove_shader(Untried(renderer))[0].failure


def test_an_exception_fails_its_test_and_no_other(renderer):
    class Refusing(Wrong):
        def read_probe(self, probe):
            raise cc.Error("out of memory")

    found = list(prove(Refusing(renderer)))
    assert [m.name for m in found if not m.passed] == ["mirrors"]
    assert [m.failure for m in found if not m.passed] == ["Error: out of memory"]
    assert found[-1].name == "shader"


def test_a_driver_that_crashes_fails_a_test(tmp_path):
    """What was measured before counts; the test that did not answer fails."""
    line = '{"name": "orientation", "what": "w", "error": 0, "tolerance": 0, "failure": ""}'
    system = FakeSystem(
        root=tmp_path, programs={FakeSystem().python: Ran(-11, line + "\n", "boom\n")}
    )
    done, crashed = prove_apart(system, None)
    assert done.passed
    assert (crashed.name, crashed.passed) == ("seams", False)
    assert crashed.failure == "the process was ended by SIGSEGV: boom"


def test_a_driver_that_ends_the_process_without_an_error_fails_a_test(tmp_path):
    system = FakeSystem(root=tmp_path, programs={FakeSystem().python: Ran(0, "", "")})
    (ended,) = prove_apart(system, None)
    assert (ended.name, ended.passed) == ("orientation", False)
    assert ended.failure == "the process ended with status 0"


def test_a_device_that_does_not_start_fails_a_test():
    (refused,) = prove_apart(System(), "no such card")
    assert (refused.name, refused.passed) == ("orientation", False)
    assert refused.failure.startswith('ContextError: no device "no such card": ')


def test_a_measurement_that_is_no_number_fails():
    assert not Measurement("a", "b", float("nan"), 1.0).passed
    assert Measurement("a", "b", 1.0, 1.0).passed
    assert worst([1, np.inf], [1, np.inf]) == 0
    assert worst([1, np.nan], [1, 2]) == np.inf
    with pytest.raises(ValueError, match=r"expected an array of shape \(2,\), got \(1,\)"):
        worst([1], [1, 2])


def test_the_references_agree_with_those_of_the_tests():
    np.testing.assert_allclose(reference.directions(5), cube_faces.texel_directions(5))
    rays = np.random.default_rng(1).normal(size=(500, 3))
    face, s, t = cube_faces.direction_to_face_uv(rays)
    got = reference.texel_of(rays, 7)
    np.testing.assert_array_equal(got, (face, np.floor(t * 7), np.floor(s * 7)))


def test_neighbours_are_those_of_twelve_edges():
    here, there = reference.neighbours(4)
    pairs = {frozenset(pair) for pair in zip(here[0].tolist(), there[0].tolist(), strict=True)}
    assert len(pairs) == 12
    rays = reference.unit(reference.directions(64))
    here, there = reference.neighbours(64)
    assert np.linalg.norm(rays[here] - rays[there], axis=-1).max() < 2 / 64


@pytest.mark.slow
def test_it_takes_less_than_ten_seconds():
    """In a process of its own, with the start of the interpreter and the driver."""
    import os
    import resource
    import subprocess
    import sys

    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run(
        [sys.executable, *child("proofs.run", DEVICE)], capture_output=True, text=True, check=True
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert done.stdout.count("tolerance") > 15
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    assert seconds < 10, (seconds, time.monotonic() - start, os.getloadavg())
