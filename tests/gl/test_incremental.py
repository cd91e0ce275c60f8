"""A picture after any edits equals a picture drawn from scratch, bit for bit, with every renderer.

What is edited comes from the stubs: each property that can be set has an edit in edits.py.
"""

import copy
import functools
from pathlib import Path

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl import edits
from tests.gl.crowd import COLORLESS, COMBINATIONS, crowd, follow, masked_crowd
from tests.gl.full_world import full_world, pictures
from tests.gl.world import OUTPUTS
from tests.helpers import DEVICE, need_equal_pixels

SEEDS = range(3)


def same(got, want, what):
    """Compare all pictures; a picture that the other renderer has not drawn is skipped."""
    assert got.keys() >= want.keys(), what
    for name, picture in want.items():
        if isinstance(picture, str) and "renderer has drawn" in picture:
            continue
        if isinstance(picture, str) or isinstance(got[name], str):
            assert got[name] == picture, f"{name}: {what}"
        else:
            assert_identical(got[name], picture, f"{name}: {what}")


def is_refused(drawn):
    return any(isinstance(x, str) and "renderer has drawn" not in x for x in drawn.values())


def is_changed(before, after):
    return before.keys() != after.keys() or any(
        not np.array_equal(before[name], after[name], equal_nan=True)
        if not isinstance(before[name], str) and not isinstance(after[name], str)
        else before[name] is not after[name]
        for name in before
    )


def test_every_settable_property_has_an_edit():
    assert sorted(edits.VALUES) == sorted(edits.settable_properties())


def test_the_world_has_something_to_set_each_property_of():
    world = full_world(np.random.default_rng(0))
    for name in edits.VALUES:
        assert world.things(getattr(cc, name.split(".")[0])), name


def test_every_changing_method_has_an_edit():
    """What changes no object of a scene is named here; the rest must be called somewhere in edits.py."""
    elsewhere = {
        "Scene.save",
        "CubeMap.save",
        "Frame.save",
        "Renderer.close",
        "Renderer.update_probes",
    }
    text = Path(edits.__file__).read_text()
    for name in set(edits.changing_methods()) - elsewhere:
        assert f".{name.split('.')[1]}(" in text, name


def names_of_edits(seed):
    """The edits of one seed: a third of all, since each compiles programs."""
    return [*edits.NAMES, *edits.METHODS][seed :: len(SEEDS)]


@pytest.mark.slow  # it compiles about 100 programs; test_kept_snapshots.py is quicker
@pytest.mark.parametrize("seed", SEEDS)
def test_random_edits(new_renderer, seed):
    """Each edit is done once by one of the seeds, in random order; now and then an edit is undone.

    The expected picture is drawn from a deep copy: a renderer that has never drawn these objects keeps nothing of
    them. Only its programs are not compiled again.
    """
    need_equal_pixels()
    rng = np.random.default_rng(seed)
    world = full_world(rng)
    live, scratch = new_renderer(), new_renderer()
    before = pictures(live, world)
    assert not is_refused(before)
    names = names_of_edits(seed)
    seen, refused = 0, 0
    for name in rng.permutation(names):
        what, undo = edits.edit(name, world, rng, functools.partial(pictures, live, world))
        got = pictures(live, world)
        same(got, pictures(scratch, copy.deepcopy(world)), f"after {what}")
        seen += is_changed(before, got)
        refused += is_refused(got)
        if undo is not None and (is_refused(got) or rng.random() < 0.6):
            undo()
            got = pictures(live, world)
        before = got
    assert seen > 0.4 * len(names)  # early edits may leave little in view
    assert refused < 0.1 * len(names)
    with cc.Renderer(device=DEVICE) as fresh:
        same(got, pictures(fresh, world), "in the end")


def test_unused_frames_between_do_not_matter(new_renderer):
    """One renderer draws every step, the other only the last."""
    rng = np.random.default_rng(12)
    world = full_world(rng)
    busy, lazy = new_renderer(), new_renderer()
    pictures(lazy, world)
    for name in rng.permutation([name for name in edits.VALUES if name.startswith("Node.")]):
        edits.edit_property(name, world, rng, lambda: None)
        pictures(busy, world)
    # A probe that no node shows after the edits would keep the picture that it had last.
    for probe in world.probes:
        world.scene.add(cc.Mesh.box(0.2), cc.MirrorMaterial(), environment=probe)
    same(pictures(busy, world), pictures(lazy, world), "in the end")


def test_unchanged_it_draws_nothing(any_path):
    world = full_world(np.random.default_rng(22))
    first = pictures(any_path, world)
    any_path.render(world.scene, world.cameras[1], (24, 20), effects=world.effects, samples=4)
    assert any_path.stats.views_drawn == 0
    same(pictures(any_path, world), first, "again")


def test_layered_equals_one_pass(shared_renderers):
    world = full_world(np.random.default_rng(23))
    same(pictures(shared_renderers(None), world), pictures(shared_renderers(False), world), "")


def test_a_copy_draws_the_same(new_renderer):
    world = full_world(np.random.default_rng(24))
    other = copy.deepcopy(world)
    assert other.textures[1].scene is other.scene
    same(pictures(new_renderer(), world), pictures(new_renderer(), other), "copy")


# The next tests make small edits in a crowd, whose pictures are drawn again in rectangles, with
# different cameras, formats, samples and targets.

CAMERAS = {
    "in the crowd": lambda: cc.PerspectiveCamera(
        fov=100, position=(0.3, 0.2, 0.1), target=(1, 0, 0), near=0.3
    ),
    "from afar": lambda: cc.PerspectiveCamera(fov=4, position=(20, 30, 60), target=(0, 0, 0)),
    "orthographic": lambda: cc.OrthographicCamera(height=4, position=(3, 4, 5), target=(0, 0, 0)),
    "a corner of the picture": lambda: cc.PerspectiveCamera(
        fov=30, position=(2, 1, 6), target=(3, 2, 0)
    ),
    "cut by near and far": lambda: cc.PerspectiveCamera(
        fov=50, position=(2, 1.5, 5), target=(0, 0, 0), near=4, far=6
    ),
}
FRAMES = {
    "plain": {},
    "float": {"format": "rgba32f"},
    "samples": {"samples": 4},
    "graded samples": {"tonemap": "aces", "encode": "srgb", "samples": 4},
    "outputs": {"outputs": OUTPUTS},
    "outputs and samples": {"outputs": OUTPUTS, "samples": 4, "format": "rgba16f"},
    **COMBINATIONS,
    **COLORLESS,
}
STENCILS = ("depth24_stencil8", "depth32f_stencil8", "stencil_index8")
LAYOUTS = {"anaglyph": (60, 44), "side_by_side": (120, 44), "top_bottom": (60, 88)}
STEREO = {"plain": {}, "samples": {"samples": 4}, "graded": {"tonemap": "aces"}}
STEREO["painter"] = {"depth_format": None}


def usual_camera(offset=(0, 0, 0)):
    return cc.PerspectiveCamera(fov=50, position=np.add(offset, (2, 1.5, 5)), target=offset)


@pytest.fixture
def both(new_renderer):
    """Two renderers: the first keeps pictures, the second keeps none."""
    return new_renderer(), new_renderer(cache_bytes=0)


def names_of(options):
    """The names of the arrays that a frame with these options has."""
    colors = () if options.get("format", "rgba8") is None else ("color",)
    return (*colors, *options.get("outputs", ()))


@pytest.mark.parametrize("options", FRAMES.values(), ids=FRAMES)
def test_frames(both, options):
    rng = np.random.default_rng(len(str(options)))
    scene, camera = crowd(rng), usual_camera()
    for node in scene.nodes[::3]:
        node.render_order = rng.integers(-1, 2)
    follow(
        both[0],
        both[1],
        lambda r: r.render(scene, camera, (97, 71), **options),
        scene,
        rng,
        names_of(options),
    )


@pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
def test_cameras(both, make):
    rng = np.random.default_rng(7)
    scene, camera = crowd(rng), make()
    follow(both[0], both[1], lambda r: r.render(scene, camera, (80, 60)), scene, rng, ["color"])


@pytest.mark.parametrize("distance", [1e3, 1e5, 1e6, 4e6])
def test_far_from_the_origin(both, distance):
    """Far from the origin, as on maps in metres, single precision would move vertices by several pixels."""
    rng = np.random.default_rng(12)
    offset = np.array([distance, 0.3 * distance, -0.7 * distance])
    scene, camera = crowd(rng, offset), usual_camera(offset)
    camera.fov = 40
    follow(both[0], both[1], lambda r: r.render(scene, camera, (128, 96)), scene, rng, ["color"])


@pytest.mark.parametrize("layered", [None, False], ids=["layered", "one_pass"])
@pytest.mark.parametrize("samples", [1, 4])
def test_captures(new_renderer, layered, samples):
    rng = np.random.default_rng(8)
    scene = crowd(rng)
    pair = new_renderer(layered=layered), new_renderer(layered=layered, cache_bytes=0)
    options = {"size": 40, "samples": samples, "outputs": ("id", "distance")}
    follow(
        pair[0],
        pair[1],
        lambda r: r.capture(scene, (0.1, 0.2, 0.3), **options),
        scene,
        rng,
        ["faces", "id", "distance"],
    )


@pytest.mark.parametrize("depth_format", STENCILS)
@pytest.mark.parametrize("samples", [1, 4])
def test_stencils(both, depth_format, samples):
    """With a stencil, nodes affect each other only where they overlap, so rectangles stay correct."""
    rng = np.random.default_rng(21)
    scene, camera = masked_crowd(rng), usual_camera()
    outputs = ("stencil",) if depth_format == "stencil_index8" else ("stencil", "depth", "id")
    options = {"depth_format": depth_format, "outputs": outputs, "samples": samples}
    follow(
        both[0],
        both[1],
        lambda r: r.render(scene, camera, (97, 71), **options),
        scene,
        rng,
        names_of(options),
    )


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("options", STEREO.values(), ids=STEREO)
def test_stereo(both, layout, options):
    rng = np.random.default_rng(41)
    scene = crowd(rng)
    eyes = cc.StereoCamera.off_axis(usual_camera(), separation=0.4, convergence=5.0, layout=layout)
    follow(
        both[0],
        both[1],
        lambda r: r.render(scene, eyes, LAYOUTS[layout], **options),
        scene,
        rng,
        ["color"],
    )
