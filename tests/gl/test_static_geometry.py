"""Large meshes of which only a part is sent: the picture has the same bytes, and the stats say what was left out.

A renderer sends whole meshes in the first call that sees them: so does the one that draws a copy of the scene.
"""

import copy

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_identical
from tests.gl.world import OUTPUTS
from tests.helpers import need_equal_pixels, on_llvmpipe

#: Calls after which a renderer has made up its mind about each mesh.
WARM_UP = 12
STEPS = 5
#: Meshes with fewer triangles are always sent as a whole.
FEWEST = 2000


def tangle(rng, count=2500, spread=2.0, size=0.12, colors=True):
    """Small triangles in random order and two great ones; many lie in one plane, and some there twice."""
    middles = rng.uniform(-spread, spread, (count, 1, 3))
    corners = middles + size * rng.normal(size=(count, 3, 3)) * rng.exponential(
        size=(count, 1, 1)
    ).clip(0.1, 3)
    flat = rng.random(count) < 0.3
    corners[flat, :, 2] = 0.25 * spread
    again = rng.permutation(np.flatnonzero(flat))[: count // 10]
    corners[rng.permutation(np.flatnonzero(~flat))[: len(again)]] = corners[again]
    corners[rng.integers(count, size=2)] = spread * rng.normal(size=(2, 3, 3))
    numbers = rng.permutation(3 * count).reshape(-1, 3)
    positions = np.empty((3 * count, 3))
    positions[numbers.ravel()] = corners.reshape(-1, 3)
    return cc.Mesh(
        positions, numbers, colors=rng.uniform(0.1, 1, (3 * count, 4)) if colors else None
    )


def sheet(side, rng=None):
    """A square of 2 * side^2 triangles in the plane z = 0, from -1 to 1, in order or in a random one."""
    x, y = np.meshgrid(*2 * [np.linspace(-1, 1, side + 1)])
    positions = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    row, column = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    a = row * (side + 1) + column
    triangles = np.stack([a, a + 1, a + side + 2, a, a + side + 2, a + side + 1], axis=-1)
    triangles = triangles.reshape(-1, 3)
    return cc.Mesh(positions, triangles if rng is None else rng.permutation(triangles))


def world(rng):
    """Tangles that are placed in all ways, and two small things that move."""
    scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
    scene.add(cc.PointLight(position=(2, 5, 3)))
    mesh = tangle(rng)
    sheared = np.array([[1, 0.6, 0, -1], [0, 0.8, 0.3, 0.5], [0.2, 0, 1.1, -1], [0, 0, 0, 1]])
    scene.add(mesh, cc.BasicMaterial(double_sided=True))
    scene.add(mesh, cc.PhongMaterial(double_sided=True), matrix=sheared)
    scene.add(mesh, cc.PhongMaterial(color=(1, 0.4, 0.2)), position=(1, -1, 0), scale=(-0.7, 1, 1))
    veil = cc.BasicMaterial(color=(0.3, 0.9, 0.5), opacity=0.4, double_sided=True)
    scene.add(tangle(rng), veil, rotation=cc.axis_angle((1, 2, 3), 130))
    glow = cc.BasicMaterial(opacity=0.3, blend="additive")
    scene.add(tangle(rng, colors=False), glow, position=(0.5, 0, -1))
    movers = [
        scene.add(cc.Mesh.box(0.3), cc.PhongMaterial(color=color), position=place)
        for color, place in (("red", (0.4, 0.3, 1.2)), ("blue", (-0.8, -0.4, 0)))
    ]
    return scene, movers


def move(movers, rng):
    for mover in movers:
        mover.position = np.clip(np.array(mover.position) + rng.normal(size=3) * 0.08, -1.2, 1.2)
        mover.rotation = cc.axis_angle(rng.normal(size=3), 40)


def follow(live, scratch, draw, scene, change, names):
    """Draw what changes with both renderers; return the share of triangles that the first did not send.

    None: that of another driver than llvmpipe, which is not known.
    """
    for _ in range(WARM_UP):
        change()
        draw(live, scene)
    sent, skipped = 0, 0
    for step in range(STEPS):
        change()
        got = draw(live, scene)
        sent += live.stats.triangles
        skipped += live.stats.triangles_skipped
        want = draw(scratch, copy.deepcopy(scene))
        assert scratch.stats.triangles_skipped == 0
        assert getattr(want, names[0])[..., :3].std() > 0
        for name in names:
            assert_identical(getattr(got, name), getattr(want, name), f"{name} of step {step}")
    return skipped / (sent + skipped) if on_llvmpipe() else None


def check_share(share, least, most=1.0):
    """A GPU takes the triangles of these meshes faster than they are picked, and gets them all."""
    assert share is None or least <= share <= most


def camera():
    return cc.PerspectiveCamera(fov=50, position=(0.5, 1, 6), target=(0, 0, 0))


def camera_ahead():
    return cc.PerspectiveCamera(fov=35, position=(0, 0, 5), target=(0, 0, 0))


#: The options of a frame, and the least share of triangles that are not sent.
FRAMES = {
    "plain": ({}, 0.3),
    "outputs": ({"outputs": OUTPUTS}, 0.3),
    "float": ({"format": "rgba32f", "depth_format": "depth_component16"}, 0.3),
    "painter": ({"depth_format": None}, 0.3),
    "stencil": ({"depth_format": "depth24_stencil8", "outputs": ("stencil", "depth")}, 0.3),
    "graded": ({"tonemap": "aces", "encode": "srgb"}, 0.3),
    "samples": ({"samples": 4, "outputs": ("id",)}, 0),  # one rectangle round both movers
}


@pytest.mark.parametrize(("options", "least"), FRAMES.values(), ids=FRAMES)
def test_frames(new_renderer, options, least):
    need_equal_pixels()
    rng = np.random.default_rng(len(str(options)))
    scene, movers = world(rng)
    names = ("color", *options.get("outputs", ()))
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, camera(), (180, 130), **options),
        scene,
        lambda: move(movers, rng),
        names,
    )
    check_share(share, least)


CAMERAS = {
    "orthographic": lambda turn: cc.OrthographicCamera(
        height=0.8, position=(3 * turn, 4, 5), target=(0, 0, 0)
    ),
    "inside": lambda turn: cc.PerspectiveCamera(
        fov=60, position=(0.1, 0.2, 0.3), target=(1, turn, 0), near=0.02
    ),
    "a part": lambda turn: cc.PerspectiveCamera(
        fov=12, position=(2, 1, 6), target=(1.5 + turn, 1, 0)
    ),
    "cut by near and far": lambda turn: cc.PerspectiveCamera(
        fov=30, position=(2 + turn, 1.5, 5), target=(0, 0, 0), near=5.1, far=5.3
    ),
}


@pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
def test_cameras_that_move(new_renderer, make):
    """A camera that moves has its whole picture drawn, but not what lies outside of it."""
    need_equal_pixels()
    rng = np.random.default_rng(3)
    scene, _ = world(rng)
    turn = [0.0]

    def change():
        turn[0] += 0.03

    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, make(turn[0]), (96, 70)),
        scene,
        change,
        ["color"],
    )
    check_share(share, 0.1)


@pytest.mark.parametrize("distance", [1e3, 1e6])
def test_far_from_the_origin(new_renderer, distance):
    need_equal_pixels()
    rng = np.random.default_rng(4)
    scene, movers = world(rng)
    place = distance * np.array([1, 0.3, -0.7])
    root = scene.add(position=place)
    for node in scene.nodes:
        if node.mesh is not None:
            node.parent = root
    view = cc.PerspectiveCamera(fov=50, position=place + np.array((0.5, 1, 6)), target=place)
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, view, (180, 130)),
        scene,
        lambda: move(movers, rng),
        ["color"],
    )
    check_share(share, 0.3)


def test_a_mesh_far_from_its_own_origin(new_renderer):
    """Its float32 corners are coarse, and so is the GPU's arithmetic."""
    need_equal_pixels()
    rng = np.random.default_rng(5)
    near = tangle(rng, count=4000)
    far = cc.Mesh(near.positions + np.float32(20_000), near.indices, colors=near.colors)
    scene = cc.Scene(background=(0.1, 0.2, 0.3, 1))
    scene.add(far, cc.BasicMaterial(double_sided=True), position=3 * [-20_000])
    mover = scene.add(cc.Mesh.box(0.3), cc.BasicMaterial(color="red"), position=(0, 0, 1))
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, camera(), (180, 130)),
        scene,
        lambda: move([mover], rng),
        ["color"],
    )
    check_share(share, 0.3)


@pytest.mark.parametrize("layered", [True, False], ids=["layered", "one_pass"])
@pytest.mark.parametrize("depth_order", ["nearest", "farthest"])
def test_captures(new_renderer, layered, depth_order):
    """From within the tangles each face shows a part of every mesh: also where all faces are drawn anew."""
    need_equal_pixels()
    rng = np.random.default_rng(6)
    scene, movers = world(rng)
    place = [0.1, 0.2, 0.3]

    def change():
        move(movers, rng)
        if rng.random() < 0.5:
            place[0] += 0.05

    share = follow(
        new_renderer(layered=layered),
        new_renderer(layered=layered),
        lambda renderer, scene: renderer.capture(
            scene, place, size=48, outputs=("id",), near=0.02, depth_order=depth_order
        ),
        scene,
        change,
        ["faces", "id"],
    )
    check_share(share, 0.4)


@pytest.mark.parametrize("kind", ["probe", "planar mirror"])
def test_mirrors(new_renderer, kind):
    need_equal_pixels()
    rng = np.random.default_rng(7)
    scene, movers = world(rng)
    where = cc.Probe(size=32) if kind == "probe" else cc.PlanarMirror()
    shape = cc.Mesh.sphere(0.7) if kind == "probe" else cc.Mesh.plane(5, 5)
    scene.add(shape, cc.MirrorMaterial(), position=(0, -1.2, 1), environment=where)
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, camera(), (120, 90)),
        scene,
        lambda: move(movers, rng),
        ["color"],
    )
    check_share(share, 0.2)


@pytest.mark.parametrize("kind", ["point", "sun"])
def test_shadows(new_renderer, kind):
    """The map of a light that stands among the triangles shows a part of them in each layer."""
    need_equal_pixels()
    rng = np.random.default_rng(8)
    scene, movers = world(rng)
    shadow = cc.Shadow(size=64)
    if kind == "point":
        scene.add(cc.PointLight(position=(0.2, 0.4, 0.3), shadow=shadow))
    else:
        scene.add(cc.DirectionalLight((-1, -2, -1), shadow=shadow))
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, camera(), (90, 60)),
        scene,
        lambda: move(movers, rng),
        ["color"],
    )
    check_share(share, 0.2 if kind == "point" else 0)


def test_many_vertices_and_many_nodes(new_renderer):
    """More vertices than 16 bits count, in nodes that one call draws where all are sent as a whole."""
    need_equal_pixels()
    rng = np.random.default_rng(9)
    scene = cc.Scene(background=(0, 0, 0, 1))
    scene.add(cc.DirectionalLight((-1, -1, -2)))
    mesh, material = sheet(260, rng), cc.PhongMaterial(color=(0.4, 0.6, 0.9))
    for x in (-1.05, 1.05):
        scene.add(mesh, material, position=(x, 0, 0), rotation=cc.axis_angle((1, 0, 0), 20 * x))
    mover = scene.add(cc.Mesh.box(0.2), cc.PhongMaterial(color="red"), position=(0.9, 0, 0.3))
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, camera(), (200, 120)),
        scene,
        lambda: move([mover], rng),
        ["color"],
    )
    check_share(share, 0.7)


@pytest.mark.parametrize("layered", [True, False], ids=["layered", "one_pass"])
def test_nodes_of_one_mesh_in_part_and_as_a_whole(new_renderer, layered):
    """The nearest is at the edge of the picture, so that it is sent in part, the others as a whole."""
    need_equal_pixels()
    scene = cc.Scene(background=(0, 0, 0, 1))
    mesh, material = sheet(60), cc.BasicMaterial(color="orange")
    for place in ((1.9, 1.2, 1), (0, 0, -1), (0.3, 0.2, -2), (-2, -1.3, 0.8)):
        scene.add(mesh, material, position=place)
    turn = [0]

    def change():
        turn[0] += 1
        scene.background = (0, 0, 0.01 * turn[0], 1)

    share = follow(
        new_renderer(layered=layered),
        new_renderer(layered=layered),
        lambda renderer, scene: renderer.render(scene, camera_ahead(), (90, 60)),
        scene,
        change,
        ["color"],
    )
    check_share(share, 0.1, 0.5)


SHADE = "vec3 shade(Surface s) { return abs(s.normal) * 0.5 + vec3(0.1, 0.2, 0.3); }"
COUNT = "vec3 shade(Surface s) { return vec3(float(gl_PrimitiveID % 7), 1.0, 3.0) / 7.0; }"
WAVE = "void vertex(inout Vertex v) { v.position.z += 0.1 * sin(9.0 * v.position.x); }"
SOURCES = {
    "a fragment": (cc.ShaderMaterial(SHADE), True),
    "a count of triangles": (cc.ShaderMaterial(COUNT), False),
    "a count in pieces": (cc.ShaderMaterial(COUNT.replace("gl_Prim", "gl_Prim\\\n")), False),
    "vertices that may be anywhere": (cc.ShaderMaterial(SHADE, vertex=WAVE), False),
    "vertices that are moved so far": (
        cc.ShaderMaterial(SHADE, vertex=WAVE, displacement=0.1), True
    ),
}  # fmt: skip


@pytest.mark.parametrize(("material", "in_parts"), SOURCES.values(), ids=SOURCES)
def test_users_sources(new_renderer, material, in_parts):
    need_equal_pixels()
    rng = np.random.default_rng(10)
    scene = cc.Scene(background=(0, 0, 0, 1))
    scene.add(sheet(60, rng), material, scale=2.5)
    mover = scene.add(cc.Mesh.box(0.2), cc.BasicMaterial(color="red"), position=(0.3, 0, 0.6))
    view = cc.PerspectiveCamera(fov=50, position=(4, 1, 5), target=(0, 0, 0))
    share = follow(
        new_renderer(),
        new_renderer(),
        lambda renderer, scene: renderer.render(scene, view, (120, 90)),
        scene,
        lambda: move([mover], rng),
        ["color"],
    )
    check_share(share, 0.3 if in_parts else 0, 1 if in_parts else 0)


def flat_view(side=100, **options):
    """A sheet that fills a picture of 200 x 200 pixels, each pixel 0.01 wide, and a small box before it."""
    scene = cc.Scene()
    sheet_node = scene.add(sheet(side, np.random.default_rng(1)), cc.BasicMaterial(color="green"))
    box = scene.add(cc.Mesh.box(0.1), cc.BasicMaterial(color="red"), position=(0, 0, 1))
    view = cc.OrthographicCamera(height=2, position=(0, 0, 5), target=(0, 0, 0))

    def draw(renderer, x):
        box.position = (x, 0.2, 1)
        return renderer.render(scene, view, (200, 200), **options)

    return sheet_node, draw


@pytest.mark.llvmpipe("a GPU gets all triangles of a mesh of this size")
def test_the_stats_say_what_was_left_out(fresh_renderer):
    """The box is 10 pixels wide and moves by 5; bounds have a few pixels more, and groups of triangles as well.

    A triangle is 2 pixels wide, so the least is 15 x 10 pixels of 2 triangles for each 4, and the most that of 50 x 45.
    """
    _, draw = flat_view()
    draw(fresh_renderer, 0.0)
    assert fresh_renderer.stats.triangles == 20_000 + 12
    assert fresh_renderer.stats.triangles_skipped == 0
    for step in range(1, WARM_UP + 1):
        draw(fresh_renderer, 0.05 * (step % 2))
    stats = fresh_renderer.stats
    assert stats.triangles + stats.triangles_skipped == 20_000 + 12
    assert 15 * 10 / 2 + 12 < stats.triangles < 50 * 45 / 2 + 12
    assert f"triangles_skipped={stats.triangles_skipped}" in repr(stats)
    draw(fresh_renderer, 0.05 * (step % 2))
    assert fresh_renderer.stats.triangles == fresh_renderer.stats.triangles_skipped == 0


@pytest.mark.llvmpipe("a GPU gets all triangles of a mesh of this size")
def test_pictures_with_samples_are_drawn_in_a_rectangle(new_renderer):
    live, scratch = new_renderer(), new_renderer(cache_bytes=0)
    _, draw = flat_view(samples=4, format="rgba16f", outputs=("id",))
    for step in range(WARM_UP):
        draw(live, 0.013 * step)
    got, want = draw(live, 0.2), draw(scratch, 0.2)
    # Colour and outputs are two passes.
    assert live.stats.triangles < 2 * 20_000 / 4
    assert scratch.stats.triangles == 2 * (20_000 + 12)
    assert_identical(got.color, want.color, "color")
    assert_identical(got.id, want.id, "id")


def test_a_small_mesh_is_sent_as_a_whole(fresh_renderer):
    _, draw = flat_view(side=int(np.sqrt(FEWEST / 2)) - 1)
    for step in range(WARM_UP):
        draw(fresh_renderer, 0.05 * (step % 2))
        assert fresh_renderer.stats.triangles_skipped == 0


@pytest.mark.llvmpipe("a GPU gets all triangles of a mesh of this size")
def test_vertices_that_move_are_found_where_they_are(new_renderer):
    """What is known of the places of triangles is forgotten with an update."""
    live, scratch = new_renderer(), new_renderer()
    node, draw = flat_view(side=60)
    for step in range(WARM_UP):
        draw(live, 0.05 * (step % 2))
    assert live.stats.triangles_skipped > 0
    positions = np.array(node.mesh.positions)
    node.mesh.update(positions=positions[:, [1, 0, 2]] * (1, -1, 1))
    got = draw(live, 0.1)
    assert_identical(got.color, draw(scratch, 0.1).color, "after the update")
    draw(live, 0.15)
    assert_identical(draw(live, 0.2).color, draw(scratch, 0.2).color, "later")
    for step in range(WARM_UP):
        draw(live, 0.05 * (step % 2))
    assert live.stats.triangles_skipped > 0
    assert_identical(draw(live, -0.3).color, draw(scratch, -0.3).color, "at last")


def test_a_mesh_that_changes_in_each_call_is_not_parted(fresh_renderer):
    node, draw = flat_view(side=60)
    positions = np.array(node.mesh.positions)
    for step in range(WARM_UP):
        node.mesh.update(positions=positions * (1 + 0.01 * step))
        draw(fresh_renderer, 0.05 * (step % 2))
        assert fresh_renderer.stats.triangles_skipped == 0


@pytest.mark.llvmpipe("a GPU gets all triangles of a mesh of this size")
def test_other_streams_may_change(new_renderer):
    """New colours leave the triangles where they are."""
    live, scratch = new_renderer(), new_renderer()
    node, draw = flat_view(side=60)
    rng = np.random.default_rng(2)
    for step in range(WARM_UP):
        draw(live, 0.05 * (step % 2))
    node.mesh.update(colors=rng.random((len(node.mesh.positions), 4)))
    draw(live, 0.0)
    got = draw(live, 0.05)
    assert live.stats.triangles_skipped > 0
    assert_identical(got.color, draw(scratch, 0.05).color)
