"""Batches: `capture_many`, `iter_captures`, `render_many` and `capture_scenes` against single calls, byte for byte."""

import gc
import pickle
import threading
import weakref
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.gl.full_world import full_world

SIZE = 16
SHAPED = ("distance", "z", "normal", "position", "id", "label")


def places(rng, count, reach=1.5):
    return rng.uniform(-reach, reach, (count, 3))


def turns(rng, count):
    return rng.normal(size=(count, 4))


def boxes(rng, count=20, light=None, **look):
    """Boxes round the middle, of one mesh, so that they are drawn together, and a ground."""
    scene = cc.Scene(background=(0.2, 0.4, 0.8))
    scene.add(light or cc.DirectionalLight((-0.3, -1, -0.2)))
    mesh = cc.Mesh.box(0.5)
    for _ in range(count):
        material = cc.PhongMaterial(color=tuple(rng.random(3)), **look)
        scene.add(mesh, material, position=rng.uniform(-3, 3, 3))
    scene.add(cc.Mesh.plane(8, 8), cc.PhongMaterial(color=(0.5, 0.5, 0.5)), position=(0, -2.5, 0))
    return scene


def assert_same(batch, cubes):
    cubes = list(cubes)
    assert len(batch) == len(cubes)
    for made, cube in zip(batch, cubes, strict=True):
        assert made.encoding == cube.encoding
        assert made.faces.dtype == cube.faces.dtype
        assert made.faces.tobytes() == cube.faces.tobytes()
        assert list(made.outputs) == list(cube.outputs)
        for name, values in cube.outputs.items():
            assert made.outputs[name].dtype == values.dtype
            assert made.outputs[name].tobytes() == values.tobytes(), name


@pytest.fixture(params=[None, True, False], ids=["default", "layered", "one by one"])
def path(request, new_renderer):
    """Renderers that choose, whose draw calls choose a layer, and that bind each layer."""
    return new_renderer(layered=request.param)


@pytest.mark.parametrize(
    "options",
    [
        {"outputs": SHAPED},
        {"outputs": ("depth", "stencil"), "depth_format": "depth24_stencil8"},
        {"outputs": ("depth",), "depth_format": "depth_component16", "depth_order": "farthest"},
        {"samples": 4, "outputs": ("distance", "depth")},
        {"format": "rgba8"},
        {"format": "rgba16f", "near": 0.3, "far": 4.0},
        {"format": "rgb565"},
        {"eye": (0.5, 0, 0)},
    ],
    ids=str,
)
def test_a_batch_has_the_bytes_of_single_captures(path, rng, options):
    scene = boxes(rng)
    positions, rotations = places(rng, 7), turns(rng, 7)
    batch = path.capture_many(scene, positions, SIZE, rotations=rotations, **options)
    singles = [
        path.capture(scene, place, SIZE, rotation=turn, **options)
        for place, turn in zip(positions, rotations, strict=True)
    ]
    assert_same(batch, singles)
    assert len({cube.faces.tobytes() for cube in singles}) == 7


def test_a_batch_longer_than_one_part(renderer, rng):
    scene = boxes(rng)
    positions = places(rng, 150)
    batch = renderer.capture_many(scene, positions, 8, format="rgba8", outputs=["distance"])
    some = (0, 1, 62, 63, 64, 65, 127, 128, 149)
    singles = [
        renderer.capture(scene, positions[i], 8, format="rgba8", outputs=["distance"]) for i in some
    ]
    assert_same(batch[list(some)], singles)


def test_large_faces_come_one_by_one(renderer, rng):
    scene = boxes(rng, 4)
    positions = places(rng, 3)
    batch = renderer.capture_many(scene, positions, 512)
    assert_same(batch, [renderer.capture(scene, place, 512) for place in positions])


def worlds(rng):
    """Scenes whose captures depend on other pictures, or on the place."""
    lit = boxes(rng, light=cc.PointLight((1, 2, 0.5), shadow=cc.Shadow(size=64)))
    lit.add(cc.SpotLight((0, 2, 2), direction=(0, -1, -1)))
    sky = boxes(rng)
    sky.background = sky.environment = cc.CubeMap(rng.random((6, 8, 8, 3), np.float32))
    sky.environment_rotation = cc.axis_angle((0, 1, 0), 40)
    mirrors = boxes(rng, light=cc.PointLight((0, 2, 0)))
    ball = mirrors.add(cc.Mesh.sphere(0.6, 16, 8), cc.MirrorMaterial(), position=(1.2, 0, 0))
    ball.environment = cc.Probe(parent=ball, size=16, parallax="distance")
    other = mirrors.add(cc.Mesh.sphere(0.4, 16, 8), cc.MirrorMaterial(), position=(-1, 0.5, 0))
    other.environment = cc.Probe(parent=other, size=16, update=2)
    sheet = mirrors.add(cc.Mesh.plane(2, 2), cc.MirrorMaterial(), position=(0, -1, 0))
    sheet.environment = cc.PlanarMirror()
    glass = boxes(rng, opacity=0.5)
    pane = cc.StandardMaterial(transmission=0.9, thickness=0.2, roughness=0.2)
    glass.add(cc.Mesh.box(0.7), pane, position=(0, 0, 1))
    glass.add(cc.Mesh.sphere(0.5), cc.GlassMaterial(), position=(0.5, 0.5, -1))
    own = boxes(rng)
    source = "out vec2 heat; vec3 shade(Surface s) { heat = s.uv; return s.position; }"
    for x in (-1, 1):
        own.add(cc.Mesh.box(0.6), cc.ShaderMaterial(fragment=source), position=(x, 0, 1))
    return {"lit": lit, "sky": sky, "mirrors": mirrors, "glass": glass, "own": own}


@pytest.mark.parametrize("name", ["lit", "sky", "mirrors", "glass", "own"])
def test_what_depends_on_other_pictures(path, rng, name):
    options = {"outputs": ["heat"] if name == "own" else ["distance"]}
    scene, again = worlds(rng)[name], worlds(np.random.default_rng(20240229))[name]
    positions = places(rng, 5, 0.4)
    batch = path.capture_many(scene, positions, SIZE, **options)
    # A world of its own, since the probe that is drawn every second call counts calls.
    assert_same(batch, [path.capture(again, place, SIZE, **options) for place in positions])


def test_a_world_with_everything(any_path, rng):
    world = full_world(rng)
    positions = places(rng, 3, 0.5)
    batch = any_path.capture_many(world.scene, positions, 12, outputs=SHAPED)
    singles = [any_path.capture(world.scene, place, 12, outputs=SHAPED) for place in positions]
    assert_same(batch, singles)


@pytest.mark.parametrize("background", [(0.1, 0.2, 0.3), (1e-9, 7e4, 0.5, 0.25)])
@pytest.mark.parametrize("texels", ["rgba8", "rgba16f", "rgba32f", "rgb565"])
def test_faces_that_show_nothing(renderer, texels, background):
    """They are filled without the driver, with the numbers that it would have written."""
    scene = cc.Scene(background=background)
    scene.add(cc.Mesh.box(0.2), cc.BasicMaterial(), position=(0, 0, -2))
    options = {"format": texels, "outputs": [*SHAPED, "depth"]}
    positions = [(0, 0, 0), (0, 0, -4), (0, 0, 500)]
    batch = renderer.capture_many(scene, positions, 13, far=100, **options)
    assert_same(batch, [renderer.capture(scene, p, 13, far=100, **options) for p in positions])
    assert renderer.capture_many(scene, positions, 8, far=100).distance is None


def test_only_views_that_show_something_are_drawn(renderer):
    scene = cc.Scene()
    scene.add(cc.Mesh.box(0.2), cc.BasicMaterial(), position=(0, 0, -2))
    renderer.capture_many(scene, [(0, 0, 0), (0, 0, 0.5), (0, 0, -4)], 8)
    assert renderer.stats.views_drawn == 3
    renderer.capture_many(scene, [(0, 500, 0)], 8, far=100)
    assert renderer.stats.views_drawn == 0


def test_nodes_that_are_left_out(renderer, rng):
    scene = boxes(rng, 6)
    hidden = scene.nodes[:3]
    scene.nodes[4].in_captures = False
    positions = places(rng, 2)
    batch = renderer.capture_many(scene, positions, SIZE, exclude=hidden, outputs=["id"])
    assert_same(
        batch,
        [renderer.capture(scene, p, SIZE, exclude=hidden, outputs=["id"]) for p in positions],
    )
    assert not set(np.unique(batch.id)) & {node.id for node in [*hidden, scene.nodes[4]]}


def test_captures_one_after_the_other(renderer, rng):
    scene = boxes(rng)
    positions = places(rng, 70)
    singles = [renderer.capture(scene, place, 8, outputs=["id"]) for place in positions]
    loop = renderer.iter_captures(scene, positions, 8, outputs=["id"])
    kept = [next(loop)]
    scene.clear()  # the scene is that of the call
    kept.extend(loop)
    assert_same(kept, singles)


def test_a_loop_holds_no_more_than_a_part(renderer):
    """A million captures of 6 MB would need 6 TB."""
    loop = renderer.iter_captures(cc.Scene(), np.zeros((1_000_000, 3)), 256)
    cubes = [weakref.ref(next(loop)) for _ in range(3)]
    gc.collect()
    assert [cube() for cube in cubes] == [None] * 3
    with pytest.raises(ValueError, match=r"positions: expected what fits into .* 1000000 captures"):
        renderer.capture_many(cc.Scene(), np.zeros((1_000_000, 3)), 4096)


def test_a_batch_of_none(renderer):
    batch = renderer.capture_many(cc.Scene(), np.zeros((0, 3)), 8, outputs=["normal"])
    assert batch.faces.shape == (0, 6, 8, 8, 4)
    assert batch.normal.shape == (0, 6, 8, 8, 3)
    assert list(batch) == list(renderer.iter_captures(cc.Scene(), np.zeros((0, 3)), 8)) == []


@pytest.mark.parametrize(
    ("wrong", "error", "message"),
    [
        ({"positions": (0, 0, 0)}, ValueError, r"positions: expected shape \(P, 3\), got \(3,\)"),
        ({"positions": [(0, np.nan, 0)]}, ValueError, "positions: expected finite"),
        ({"rotations": [(0, 0, 0, 1)] * 3}, ValueError, "one for each of the 2 positions, got 3"),
        ({"rotations": [(0, 0, 0, 0)] * 2}, ValueError, "length other than 0"),
        ({"size": 0}, ValueError, "size: expected 1 to"),
        ({"size": 2.5}, TypeError, "size: expected int"),
        ({"outputs": ["heat"]}, ValueError, 'outputs: expected .* got "heat"'),
        ({"format": None}, TypeError, "format"),
        ({"near": 2.0, "far": 1.0}, ValueError, "near, far"),
        ({"scene": None}, TypeError, "scene"),
        ({"exclude": [cc.Scene().add()]}, ValueError, "exclude: expected nodes of this scene"),
        ({"progress": "no"}, TypeError, "progress"),
    ],
)
def test_wrong_arguments(renderer, wrong, error, message):
    given = {"scene": cc.Scene(), "positions": np.zeros((2, 3)), **wrong}
    for call in (renderer.capture_many, renderer.iter_captures):  # at the call, not in the loop
        with pytest.raises(error, match=message):
            call(**given)


def test_a_closed_renderer(new_renderer):
    renderer = new_renderer()
    loop = renderer.iter_captures(cc.Scene(), np.zeros((100, 3)), 8)
    next(loop)
    renderer.close()
    with pytest.raises(cc.ContextError, match="closed"):
        list(loop)
    with pytest.raises(cc.ContextError, match="closed"):
        renderer.capture_many(cc.Scene(), np.zeros((2, 3)))


def test_batches_in_threads(renderer, rng):
    scene = boxes(rng)
    positions = places(rng, 40)
    expected = renderer.capture_many(scene, positions, 8).faces
    found = {}

    def work(number):
        found[number] = renderer.capture_many(scene, positions, 8).faces

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(found[i], expected) for i in range(4))


def test_frames_of_many_cameras(renderer, rng):
    scene = boxes(rng)
    single = [cc.PerspectiveCamera(position=p, target=(0, 0, 0)) for p in places(rng, 4, 4)]
    cameras = [*single, cc.StereoCamera(single[0], single[1], layout="top_bottom")]
    options = {"outputs": ["distance", "normal"], "tonemap": "aces", "encode": "srgb", "samples": 4}
    batch = renderer.render_many(scene, cameras, (24, 16), **options)
    assert batch.color.shape == (5, 16, 24, 4)
    for i, camera in enumerate(cameras):
        frame = renderer.render(scene, camera, (24, 16), **options)
        assert np.array_equal(batch.color[i], frame.color)
        assert np.array_equal(batch.distance[i], frame.distance)
        assert np.array_equal(batch.normal[i], frame.normal)
        assert batch.encoding == frame.encoding == "srgb"
    assert np.shares_memory(np.from_dlpack(batch), batch.color)
    assert batch.__dlpack_device__() == (1, 0)


def test_frames_without_a_colour(renderer, rng):
    batch = renderer.render_many(
        boxes(rng), [cc.PerspectiveCamera()], (8, 6), format=None, outputs=["id"]
    )
    assert batch.color is None
    assert batch.id.shape == (1, 6, 8)
    for read in (np.asarray, np.from_dlpack):
        with pytest.raises(ValueError, match="a colour"):
            read(batch)


@pytest.mark.parametrize(
    ("cameras", "error", "message"),
    [
        ([], ValueError, "cameras: expected at least one camera, got none"),
        (cc.PerspectiveCamera(), TypeError, "cameras: expected a sequence of cameras"),
        ([None], TypeError, "cameras: expected cameras, Camera or StereoCamera, got None"),
    ],
)
def test_wrong_cameras(renderer, cameras, error, message):
    with pytest.raises(error, match=message):
        renderer.render_many(cc.Scene(), cameras, (8, 8))


def test_scenes_live_until_they_are_captured(renderer):
    mesh = cc.Mesh.box(1)
    made: list[weakref.ref[cc.Scene]] = []

    def make_scene(number):
        gc.collect()
        assert all(scene() is None for scene in made), "an earlier scene is still held"
        scene = cc.Scene(background=(number / 8, 0, 0))
        scene.add(mesh, cc.BasicMaterial(), position=(0, 0, -2 - number))
        made.append(weakref.ref(scene))
        return scene

    at = np.array([(0, 0, -0.1 * i) for i in range(5)])
    batch = cc.capture_scenes(
        make_scene, 5, position=at, size=8, renderer=renderer, outputs=["distance"]
    )
    assert not renderer.closed
    assert batch.positions is not None
    assert np.array_equal(batch.positions, at)
    for number in range(5):
        made.clear()
        scene = make_scene(number)
        single = renderer.capture(scene, at[number], 8, outputs=["distance"])
        assert_same([batch[number]], [single])
        del scene


def test_wrong_scenes(renderer):
    nothing: Any = lambda number: None  # noqa: E731
    broken: Any = lambda number: 1 / 0  # noqa: E731
    with pytest.raises(TypeError, match="make_scene: expected it to give a Scene, got None"):
        cc.capture_scenes(nothing, 2, size=8, renderer=renderer)
    with pytest.raises(ZeroDivisionError):
        cc.capture_scenes(broken, 2, size=8, renderer=renderer)
    with pytest.raises(
        ValueError, match=r"position: expected shape \(3,\) or \(2, 3\), got \(2,\)"
    ):
        cc.capture_scenes(lambda number: cc.Scene(), 2, position=(0, 0), size=8, renderer=renderer)
    with pytest.raises(ValueError, match="size"):
        cc.capture_scenes(lambda number: cc.Scene(), 0, size=0, renderer=renderer)

    def one_in_srgb(number):
        photograph = cc.CubeMap(np.full((6, 2, 2, 3), 9, np.uint8), encoding="srgb")
        return cc.Scene(background=photograph if number == 1 else (0.5, 0.5, 0.5))

    with pytest.raises(ValueError, match=r"same outputs and encoding.*'srgb' from number 1"):
        cc.capture_scenes(one_in_srgb, 2, size=8, renderer=renderer)


def test_a_batch_is_pickled_and_labelled(renderer, rng):
    positions = places(rng, 3)
    batch = renderer.capture_many(boxes(rng), positions, 8, outputs=["normal", "id"])
    again = pickle.loads(pickle.dumps(batch))
    assert_same(again, batch)
    assert np.array_equal(again.positions, positions)
    data = batch.to_xarray()
    assert data.color.dims == ("probe", "face", "row", "column", "channel")
    assert np.array_equal(data.color.sel(face="-y", channel="g")[2], batch.faces[2, 3, :, :, 1])
    assert np.array_equal(data.normal.sel(axis="z"), batch.normal[..., 2])
    assert np.array_equal(data.y, positions[:, 1])
    assert np.shares_memory(data.id.values, batch.id)
    frames = renderer.render_many(boxes(rng), [cc.PerspectiveCamera()], (8, 6)).to_xarray()
    assert frames.color.dims == ("frame", "row", "column", "channel")
