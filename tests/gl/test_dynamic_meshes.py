"""Meshes with replaced vertices: the next picture equals that of a new mesh with these vertices, bit for bit."""

import threading
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.helpers import DEVICE

NAMES = ("positions", "normals", "uvs", "colors")
RAW = "vec3 shade(Surface surface) { return vec3(surface.uv, 0.0) + 0.3 * surface.color.rgb; }"
CAMERA: dict[str, Any] = {"fov": 60, "position": (0, 1, 4), "target": (0, 0, 0)}


def sheet(rng, colors=True):
    """A grid of 8 x 8 vertices that is not flat."""
    x, z = np.meshgrid(np.linspace(-1, 1, 8), np.linspace(-1, 1, 8))
    corner = np.arange(56).reshape(7, 8)[:, :-1].ravel()
    return cc.Mesh(
        np.stack([x, 0.2 * rng.normal(size=x.shape), z], axis=-1).reshape(-1, 3),
        np.concatenate(
            [
                np.stack([corner, corner + 8, corner + 9], axis=1),
                np.stack([corner, corner + 9, corner + 1], axis=1),
            ]
        ),
        uvs=rng.random((64, 2)),
        colors=rng.random((64, 3)) if colors else None,
    )


class Stage:
    """A scene whose sheets share a mesh: one shows the colours, one the texture, one the raw values."""

    def __init__(self, mesh, picture):
        self.mesh = mesh
        self.scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
        self.scene.add(cc.PointLight(position=(1, 4, 2), shadow=cc.Shadow(size=32)))
        self.scene.add(cc.Mesh.plane(8, 8), cc.PhongMaterial(), position=(0, -1, 0))
        painted = cc.PhongMaterial(vertex_colors=True, double_sided=True)
        shown = cc.PhongMaterial(map=picture, double_sided=True)
        self.scene.add(mesh, painted, position=(-1, 0, 0))
        self.scene.add(mesh, shown, position=(1, 0.3, 0), rotation=cc.axis_angle((1, 0, 0), 50))
        raw = cc.ShaderMaterial(RAW, double_sided=True)
        self.scene.add(mesh, raw, position=(0, 1.6, -0.5), rotation=cc.axis_angle((1, 0, 0), 60))
        ball = self.scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), position=(0, 0.5, 1.5))
        ball.environment = cc.Probe(position=(0, 0.5, 1.5), size=24)
        self.camera = cc.PerspectiveCamera(**CAMERA)

    def pictures(self, renderer):
        frame = renderer.render(self.scene, self.camera, size=(96, 64), outputs=("normal", "id"))
        cube = renderer.capture(self.scene, position=(0, 0.6, 0), size=32, outputs=("distance",))
        shadow = renderer.shadow_map(self.scene, self.scene.lights[0])
        return [frame.color, frame.normal, frame.id, cube.faces, cube.distance, np.asarray(shadow)]


def again(mesh):
    """A new mesh that its constructor makes from the same arrays."""
    arrays = {name: getattr(mesh, name) for name in NAMES}
    return cc.Mesh(indices=mesh.indices, **arrays)


def from_scratch(stage, picture):
    with cc.Renderer(device=DEVICE) as fresh:
        return Stage(again(stage.mesh), picture).pictures(fresh)


def new_values(name, rng):
    if name == "positions":
        return rng.normal(size=(64, 3)) * 0.7
    if name == "normals":
        return rng.normal(size=(64, 3))
    return rng.random((64, 2 if name == "uvs" else 4))


@pytest.fixture
def picture(rng):
    return cc.Image(rng.random((4, 4, 3)).astype(np.float32))


@pytest.mark.parametrize(
    "names", [(name,) for name in NAMES] + [("positions", "normals"), NAMES], ids="+".join
)
def test_an_update_is_drawn_as_a_new_mesh_is(renderer, rng, picture, names):
    stage = Stage(sheet(rng), picture)
    before = stage.pictures(renderer)
    for _ in range(3):  # the first update replaces the GPU's buffers, later ones write into them
        stage.mesh.update(**{name: new_values(name, rng) for name in names})
        after = stage.pictures(renderer)
        for got, wanted in zip(after, from_scratch(stage, picture), strict=True):
            assert_identical(got, wanted)
    assert not np.array_equal(before[0], after[0])


@pytest.mark.parametrize("name", NAMES)
def test_a_property_is_drawn_as_an_update_is(renderer, rng, picture, name):
    stage = Stage(sheet(rng), picture)
    stage.pictures(renderer)
    setattr(stage.mesh, name, new_values(name, rng))
    for got, wanted in zip(stage.pictures(renderer), from_scratch(stage, picture), strict=True):
        assert_identical(got, wanted)


@pytest.mark.parametrize("name", ["normals", "uvs", "colors"])
def test_arrays_go_and_come_back(renderer, rng, picture, name):
    stage = Stage(sheet(rng), picture)
    first = stage.pictures(renderer)
    kept = getattr(stage.mesh, name)
    setattr(stage.mesh, name, None)
    without = stage.pictures(renderer)
    for got, wanted in zip(without, from_scratch(stage, picture), strict=True):
        assert_identical(got, wanted)
    if name != "normals":  # computed normals are smooth, as before
        assert not np.array_equal(first[0], without[0])
    setattr(stage.mesh, name, kept)
    for got, wanted in zip(stage.pictures(renderer), first, strict=True):
        assert_identical(got, wanted)


def test_two_renderers_and_two_scenes_see_an_update(renderer, rng, picture):
    mesh = sheet(rng)
    stages = [Stage(mesh, picture), Stage(mesh, picture)]
    with cc.Renderer(device=DEVICE) as other:
        for stage in stages:
            stage.pictures(renderer)
            stage.pictures(other)
        mesh.update(positions=new_values("positions", rng))
        wanted = from_scratch(stages[0], picture)
        for stage in stages:
            for who in (renderer, other):
                for got, right in zip(stage.pictures(who), wanted, strict=True):
                    assert_identical(got, right)


def test_only_an_update_draws_again(renderer):
    scene = cc.Scene()
    mesh, beside = cc.Mesh.box(1), cc.Mesh.box(1)
    scene.add(mesh, cc.BasicMaterial(color=(1, 0, 0)))
    scene.add(beside, cc.BasicMaterial(color=(0, 1, 0)), position=(0, 0, 50))
    camera = cc.PerspectiveCamera(**CAMERA)

    def views_drawn():
        renderer.render(scene, camera, size=(32, 32))
        return renderer.stats.views_drawn

    assert views_drawn() == 1
    assert views_drawn() == 0
    mesh.update()
    assert views_drawn() == 0
    mesh.update(positions=mesh.positions * 0.5)
    assert views_drawn() == 1
    assert views_drawn() == 0
    beside.update(positions=beside.positions * 2)
    assert views_drawn() == 0  # `beside` is still behind the camera


def test_what_an_update_leaves_is_drawn_over(renderer):
    """The rectangle that is drawn again covers the place where the mesh was and the place where it is now."""
    scene = cc.Scene(background=(0, 0, 0, 1))
    mesh = cc.Mesh.box(0.5)
    scene.add(mesh, cc.BasicMaterial())
    camera = cc.OrthographicCamera(height=8, position=(0, 0, 5))
    renderer.render(scene, camera, size=(64, 64))
    mesh.update(positions=np.add(mesh.positions, (3, 0, 0)))
    got = renderer.render(scene, camera, size=(64, 64)).color[..., 0] > 0
    rows, columns = np.nonzero(got)
    assert columns.min() == 54
    assert columns.max() == 57
    assert rows.min() == 30
    assert rows.max() == 33


def test_colors_make_a_surface_translucent(renderer):
    scene = cc.Scene(background=(0, 0, 0, 1))
    mesh = cc.Mesh.plane(4, 4)
    mesh.colors = np.ones((4, 4))
    scene.add(mesh, cc.BasicMaterial(vertex_colors=True))
    camera = cc.OrthographicCamera(height=2, position=(0, 3, 0), target=(0, 0, 0), up=(0, 0, -1))
    assert renderer.render(scene, camera, size=(4, 4), format="rgba32f").color[1, 1, 0] == 1
    mesh.update(colors=np.full((4, 4), [1, 1, 1, 0.25]))
    got = renderer.render(scene, camera, size=(4, 4), format="rgba32f").color[1, 1, 0]
    assert got == pytest.approx(0.25)


@pytest.mark.parametrize("vertices", [65_535, 65_536, 65_537, 65_538])
def test_the_last_vertex_is_drawn_where_16_bits_end(renderer, vertices):
    """Only three vertices, one of them the last, are in view; a wrong index would change the picture."""
    positions = np.zeros((vertices, 3))
    positions[:, 2] = 100
    positions[[1, vertices - 2, vertices - 1]] = [(-1, -1, 0), (1, -1, 0), (0, 1, 0)]
    scene = cc.Scene(background=(0, 0, 0, 1))
    mesh = cc.Mesh(positions, [[1, vertices - 2, vertices - 1]])
    node = scene.add(mesh, cc.BasicMaterial())
    camera = cc.OrthographicCamera(height=3, position=(0, 0, 5))
    got = renderer.render(scene, camera, size=(32, 32)).color
    node.mesh = cc.Mesh([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [[0, 1, 2]])
    assert_identical(got, renderer.render(scene, camera, size=(32, 32)).color)
    assert (got[..., 0] > 0).sum() > 50


def test_a_picture_shows_one_moment_of_a_mesh(renderer):
    """A thread sets a square's place and colour together: red on the left or green on the right."""
    left = cc.Mesh.box(1).positions - [1, 0, 0]
    states = [
        {"positions": left, "colors": np.tile([1, 0, 0], (24, 1))},
        {"positions": np.add(left, (2, 0, 0)), "colors": np.tile([0, 1, 0], (24, 1))},
    ]
    mesh = cc.Mesh.box(1)
    mesh.update(**states[0])
    scene = cc.Scene(background=(0, 0, 0, 1))
    scene.add(mesh, cc.BasicMaterial(vertex_colors=True))
    scene.add(mesh, cc.BasicMaterial(vertex_colors=True), position=(0, 1.5, 0))
    camera = cc.OrthographicCamera(height=4, position=(0, 0, 5))
    done = threading.Event()

    def keep_setting():
        while not done.is_set():
            for state in states:
                mesh.update(**state)

    thread = threading.Thread(target=keep_setting)
    thread.start()
    try:
        seen: set[bool] = set()
        for turn in range(3000):
            if turn > 100 and len(seen) == 2:
                break
            color = renderer.render(scene, camera, size=(32, 32)).color
            red, green = (color[..., channel] > 0 for channel in (0, 1))
            assert red.any() != green.any()
            assert not red[:, 16:].any()
            assert not green[:, :16].any()
            assert (red | green)[:12].any()  # both boxes show the same moment
            assert (red | green)[16:].any()
            seen.add(bool(red.any()))
    finally:
        done.set()
        thread.join()
    mesh.update(**states[1])
    assert renderer.render(scene, camera, size=(32, 32)).color[16, 20, 1] > 0
    assert seen == {False, True}
