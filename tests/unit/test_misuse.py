"""Mistakes in the use of the C++ extension raise an exception, and the interpreter does not crash."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from cubecam import _core

CLASSES = [thing for thing in vars(_core).values() if type(thing).__name__ == "pybind11_type"]
REFUSALS = (TypeError, RuntimeError, AttributeError, pickle.PicklingError)


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.__name__)
def test_an_object_without_its_init_raises(kind):
    raw = kind.__new__(kind)
    refused = 0
    for use in (repr, hash, bool, lambda o: o == o, pickle.dumps, lambda o: pickle.dumps(o, 0)):
        try:
            use(raw)
        except REFUSALS:
            refused += 1
    for name in dir(kind):
        try:
            getattr(raw, name)
        except REFUSALS:
            refused += 1
    assert refused > 0  # the interpreter has not crashed either


def test_a_subclass_that_touches_itself_too_early_is_told():
    class Early(cc.PhongMaterial):
        def __init__(self):
            self.color = (1, 0, 0)
            super().__init__()

    with pytest.raises(TypeError, match="__init__"):
        Early()


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickling_works_or_is_refused(renderer, protocol):
    frame = renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 2), outputs=("id",))
    copy = pickle.loads(pickle.dumps(frame, protocol))
    assert copy.size == frame.size
    assert np.array_equal(copy.color, frame.color)
    for thing in (renderer, renderer.info, renderer.stats, cc.devices()[0]):
        with pytest.raises(TypeError, match="cannot pickle a cubecam"):
            pickle.dumps(thing, protocol)


def test_sizes_that_no_memory_holds_are_refused():
    cube = cc.CubeMap(np.zeros((6, 1, 1, 3), np.float32))
    with pytest.raises(ValueError, match="MiB of memory"):
        cube.resize(1_000_000)
    with pytest.raises(ValueError, match="MiB of memory"):
        cube.to_equirect(width=1_000_000)
    with pytest.raises(ValueError, match="MiB of memory"):
        cc.CubeMap.from_equirect(np.zeros((2, 4, 3), np.float32), size=1_000_000)


@pytest.mark.parametrize(
    "options", [{"size": np.array([4])}, {"outputs": None}, {"exclude": 5}, {"size": 4.0}]
)
def test_arguments_of_the_wrong_kind(renderer, options):
    with pytest.raises(TypeError):
        renderer.capture(cc.Scene(), **options)


@pytest.mark.parametrize(
    "misuse",
    [
        lambda: cc.ShaderMaterial("// \udc80\nvec3 shade(Surface s) { return vec3(1); }"),
        lambda: cc.BasicMaterial(blend="\ud800"),  # type: ignore[arg-type]
        lambda: cc.Renderer(device="\ud800"),
        lambda: cc.Scene(environment=cc.CubeMap.__new__(cc.CubeMap)),
        lambda: setattr(cc.PointLight(), "shadow", cc.Shadow.__new__(cc.Shadow)),
    ],
)
def test_what_has_no_meaning_in_cpp_is_a_type_error(misuse):
    with pytest.raises(TypeError, match=r"^expected text that is valid Unicode"):
        misuse()


@pytest.mark.parametrize("frames", [0, -1, 2**31, 2**70])
def test_probes_are_updated_every_so_many_frames(frames):
    with pytest.raises(ValueError, match=r"^update: expected an int from 1 to 2147483647, got"):
        cc.Probe(update=frames)


def test_a_nul_in_glsl_is_told_where_it_is():
    with pytest.raises(ValueError, match=r"^fragment: expected GLSL, got a NUL at byte 40$"):
        cc.ShaderMaterial("vec3 shade(Surface s) { return vec3(1); }"[:40] + "\0 }")
