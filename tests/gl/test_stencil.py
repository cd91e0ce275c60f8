"""Stencils of materials against the numpy painter, and what a mask lets through."""

import dataclasses
import itertools
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.crowd import masked_crowd, ours, random_stencil
from tests.gl.world import OUTPUTS, World, inner, inner_smooth, perspective
from tests.helpers import copies
from tests.reference.stencil import FUNCS, OPS, Canvas, Stencil

SIZE = (24, 16)
UPRIGHT = cc.axis_angle((1, 0, 0), 90)
DEPTHS = {"depth24_stencil8": True, "depth32f_stencil8": True, "stencil_index8": False}
depths = pytest.mark.parametrize("depth_format", DEPTHS)


def screen():
    """One world unit is one pixel; the bottom-left corner is the origin."""
    width, height = SIZE
    return cc.OrthographicCamera(
        height=height, position=(width / 2, height / 2, 10), near=0, far=20
    )


def card(scene, rect, z, color, stencil, order, **more):
    """A rectangle of pixels (x0, y0, x1, y1), y upwards."""
    x0, y0, x1, y1 = rect
    return scene.add(
        cc.Mesh.plane(x1 - x0, y1 - y0),
        cc.BasicMaterial(color=color, stencil=stencil, **more),
        position=((x0 + x1) / 2, (y0 + y1) / 2, z),
        rotation=UPRIGHT,
        render_order=order,
    )


def covered(rect):
    x0, y0, x1, y1 = rect
    mask = np.zeros(SIZE[::-1], bool)
    mask[SIZE[1] - y1 : SIZE[1] - y0, x0:x1] = True
    return mask


def random_cards(rng, count, depth):
    """Return the same random cards as the product's scene and as the oracle's canvas."""
    scene = cc.Scene(background=(0.25, 0.5, 0.75))
    canvas = Canvas(SIZE[::-1], (0.25, 0.5, 0.75, 1), depth)
    for index in range(count):
        x0, y0 = rng.integers(0, SIZE[0] - 3), rng.integers(0, SIZE[1] - 3)
        x1, y1 = rng.integers(x0 + 3, SIZE[0] + 1), rng.integers(y0 + 3, SIZE[1] + 1)
        z, color, stencil = float(rng.permutation(15)[0]), rng.random(3), random_stencil(rng)
        z = z / 2 + index / 1000  # no two cards have one depth
        card(scene, (x0, y0, x1, y1), z, color, ours(stencil), index)
        canvas.draw(covered((x0, y0, x1, y1)), -z, (*color, 1), stencil)
    return scene, canvas


@depths
@pytest.mark.parametrize("seed", range(8))
def test_random_cards_against_the_painter(any_path, depth_format, seed):
    scene, canvas = random_cards(np.random.default_rng(seed), 30, DEPTHS[depth_format])
    frame = any_path.render(
        scene, screen(), SIZE, format="rgba32f", depth_format=depth_format, outputs=("stencil",)
    )
    assert frame.stencil.dtype == np.uint8
    assert len(np.unique(canvas.stencil)) > 3
    np.testing.assert_array_equal(frame.stencil, canvas.stencil)
    assert_close(frame.color, canvas.color, "float32_maths")


@pytest.mark.parametrize(("func", "read_mask"), list(itertools.product(FUNCS, (255, 3, 0x82))))
def test_every_comparison(renderer, func, read_mask):
    """Bars write 0, 1, 2, 3, 254 and 255; then a sheet over all bars compares with 2."""
    scene = cc.Scene()
    values = (0, 1, 2, 3, 254, 255)
    for index, value in enumerate(values):
        card(
            scene,
            (4 * index, 0, 4 * index + 4, SIZE[1]),
            0,
            (0, 0, 0),
            cc.Stencil(reference=value, depth_pass="replace"),
            index,
        )
    card(
        scene,
        (0, 0, *SIZE),
        1,
        (1, 1, 1),
        cc.Stencil(func=func, reference=2, read_mask=read_mask),
        9,
    )
    frame = renderer.render(scene, screen(), SIZE, depth_format="depth24_stencil8")
    want = Stencil(func, 2, read_mask).test(np.array(values))
    np.testing.assert_array_equal(frame.color[5, 2::4, 0] == 255, want)


@pytest.mark.parametrize("op", OPS)
@pytest.mark.parametrize("place", ["fail", "depth_fail", "depth_pass"])
@pytest.mark.parametrize("write_mask", [255, 0x0F])
def test_every_operation(renderer, op, place, write_mask):
    scene = cc.Scene()
    values = (0, 1, 77, 254, 255, 128)
    for index, value in enumerate(values):
        start = cc.Stencil(reference=value, depth_pass="replace")
        card(scene, (4 * index, 0, 4 * index + 4, SIZE[1]), 0, (0, 0, 0), start, index)
    func = "never" if place == "fail" else "always"
    z = -1 if place == "depth_fail" else 1
    setting = {"func": func, "reference": 99, "write_mask": write_mask, place: op}
    card(scene, (0, 0, *SIZE), z, (1, 1, 1), cc.Stencil(**setting), 9)
    got = renderer.render(
        scene, screen(), SIZE, depth_format="depth32f_stencil8", outputs=("stencil",)
    ).stencil
    stored = np.array(values)
    passed = np.full(6, place != "fail")
    want = Stencil(**setting).updated(stored, passed, np.full(6, place == "depth_pass"))
    np.testing.assert_array_equal(got[5, 2::4], want)


def disc_and_plane(func, depth_first=-1):
    """A disc behind a wall that shows where the disc is, or where it is not."""
    world = World()
    world.mesh(
        cc.Mesh.icosphere(0.8, subdivisions=3),
        (0.2, 1, 0.3),
        material=cc.BasicMaterial(
            color=(0.2, 1, 0.3), stencil=cc.Stencil(reference=5, depth_pass="replace")
        ),
        position=(0.3, -0.2, -1),
    ).render_order = depth_first
    world.box(
        (2.4, 2, 0.2),
        (1, 0.2, 0.1),
        material=cc.BasicMaterial(color=(1, 0.2, 0.1), stencil=cc.Stencil(func=func, reference=5)),
        position=(-0.3, 0.1, 0.6),
        degrees=20,
    )
    return world


@pytest.mark.parametrize("func", ["equal", "notequal"])
def test_a_disc_masks_a_plane(any_path, func):
    """The disc masks the plane inside or outside it; the ray caster meets each shape alone."""
    world, view = disc_and_plane(func), perspective((0.4, 0.3, 4), (0, 0, 0), size=(60, 45))
    frame = any_path.render(
        world.scene,
        view.camera,
        view.size,
        format="rgba32f",
        depth_format="depth24_stencil8",
        outputs=(*OUTPUTS, "stencil"),
    )
    disc, wall = (view.hits([shape]) for shape in world.shapes)
    here = disc.hit if func == "equal" else ~disc.hit
    want = np.where(wall.hit & here, wall.id, disc.id)
    mask = inner_smooth(disc) & inner(wall)
    assert (want[mask] == 2).sum() > 50
    assert (disc.hit & wall.hit & mask).sum() > 50
    assert_close(frame.id, want, "exact", mask=mask)
    assert_close(frame.stencil, 5 * disc.hit, "exact", mask=mask)
    seen = np.where(want[..., None] == 2, world.paint(wall), world.paint(disc))
    assert_close(frame.color, seen, "float32_maths", mask=mask)


def test_the_order_of_drawing_decides(renderer):
    """The disc masks nothing when it is drawn after the wall, from near to far."""
    world, view = disc_and_plane("equal", 1), perspective((0.4, 0.3, 4), (0, 0, 0))
    frame = renderer.render(
        world.scene, view.camera, view.size, depth_format="depth24_stencil8", outputs=("id",)
    )
    assert set(np.unique(frame.id)) == {0, 1}


@pytest.mark.parametrize("samples", [1, 4])
def test_a_window_leaves_nothing_of_itself(any_path, samples):
    """A mask without colour and depth before a wall shows the wall through it, and no id of its own."""
    world, view = World(), perspective((0.4, 0.3, 4), (0, 0, 0), size=(60, 45))
    world.scene.background = (0.5, 0.5, 0.5, 1)
    hole = cc.BasicMaterial(
        color_write=False,
        depth_write=False,
        stencil=cc.Stencil(reference=5, depth_pass="replace"),
    )
    world.mesh(cc.Mesh.icosphere(0.8, subdivisions=3), material=hole, position=(-0.4, -0.2, 1.2))
    seen = cc.BasicMaterial(color=(1, 0.2, 0.1), stencil=cc.Stencil(func="equal", reference=5))
    world.box((2.4, 2, 0.2), (1, 0.2, 0.1), material=seen, position=(0.3, 0.1, 0), degrees=20)
    world.scene.nodes[0].render_order = -1
    frame = any_path.render(
        world.scene, view.camera, view.size, format="rgba32f", samples=samples,
        depth_format="depth24_stencil8", outputs=("id", "depth", "stencil", "normal"),
    )  # fmt: skip
    disc, wall = (view.hits([shape]) for shape in world.shapes)
    shown = disc.hit & wall.hit
    mask = inner_smooth(disc) & inner(wall)
    assert (shown & mask).sum() > 100
    assert (disc.hit & ~wall.hit & mask).sum() > 50
    assert_close(frame.id, np.where(shown, 2, 0), "exact", mask=mask)
    assert_close(frame.stencil, 5 * disc.hit, "exact", mask=mask)
    assert ((frame.depth < 1) == shown)[mask].all()
    assert (frame.normal.any(-1) == shown)[mask].all()
    want = np.where(shown[..., None], (1, 0.2, 0.1, 1), (0.5, 0.5, 0.5, 1))
    assert_close(frame.color, want, "float32_maths", mask=mask)


@pytest.mark.parametrize("depth_format", [None, "depth_component24", "depth_component32f"])
def test_without_a_stencil_buffer_it_has_no_effect(renderer, depth_format):
    with_it, without = disc_and_plane("never"), disc_and_plane("always")
    without.scene.nodes[1].material.stencil = without.scene.nodes[0].material.stencil = None
    view = perspective((0.4, 0.3, 4), (0, 0, 0))
    frames = [
        renderer.render(world.scene, view.camera, view.size, depth_format=depth_format).color
        for world in (with_it, without)
    ]
    assert_identical(*frames)


@pytest.mark.parametrize("options", [{}, {"samples": 4}, {"format": None}, {"samples": 2}])
def test_translucent_things_are_counted(any_path, options):
    """Each surface adds one, however its colour is blended: the depth complexity of glass."""
    rng = np.random.default_rng(4)
    scene = cc.Scene(background=(0.5, 0.5, 0.5))
    want = np.zeros(SIZE[::-1], int)
    for index in range(9):
        x0, y0 = rng.integers(0, SIZE[0] - 3), rng.integers(0, SIZE[1] - 3)
        rect = (x0, y0, rng.integers(x0 + 3, SIZE[0] + 1), rng.integers(y0 + 3, SIZE[1] + 1))
        card(scene, rect, index / 10, (1, 0, 0), cc.Stencil(depth_pass="incr"), 0, opacity=0.25)
        want += covered(rect)
    frame = any_path.render(
        scene, screen(), SIZE, depth_format="depth24_stencil8", outputs=("stencil",), **options
    )
    assert want.max() > 3
    np.testing.assert_array_equal(frame.stencil, want)


@pytest.mark.slow
@depths
@pytest.mark.parametrize("samples", [1, 4])
def test_captures_are_the_same_on_both_paths(new_renderer, depth_format, samples):
    scene = masked_crowd(np.random.default_rng(22))
    names = ["stencil"] + (["depth", "id"] if DEPTHS[depth_format] else [])
    options = {"depth_format": depth_format, "outputs": names, "samples": samples, "size": 24}
    a, b = (new_renderer(layered=layered).capture(scene, **options) for layered in (True, False))
    assert a.stencil.dtype == np.uint8
    assert a.stencil.shape == (6, 24, 24)
    assert len(np.unique(a.stencil)) > 2
    for name in ("faces", *names):
        assert_identical(getattr(a, name), getattr(b, name), name, across="programs")
    assert a == b


@pytest.mark.slow
@depths
def test_multisampled_outputs_equal_those_of_one_sample(renderer, depth_format):
    scene = masked_crowd(np.random.default_rng(23))
    names = ["stencil"] + (["depth", "id", "normal"] if DEPTHS[depth_format] else [])
    camera = cc.PerspectiveCamera(fov=50, position=(2, 1.5, 5), target=(0, 0, 0))
    frames = [
        renderer.render(
            scene, camera, (64, 48), depth_format=depth_format, outputs=names, samples=samples
        )
        for samples in (1, 4)
    ]
    for name in names:
        assert_identical(getattr(frames[1], name), getattr(frames[0], name), name)
    assert (frames[0].color != frames[1].color).any()


def test_a_changed_stencil_is_drawn_and_an_equal_one_is_not(renderer, fresh_renderer):
    world, view = disc_and_plane("equal"), perspective((0.4, 0.3, 4), (0, 0, 0))
    wall = world.scene.nodes[1].material

    def draw(r):
        return r.render(world.scene, view.camera, view.size, depth_format="depth24_stencil8").color

    before = draw(renderer)
    wall.stencil = cc.Stencil(func="equal", reference=5)
    draw(renderer)
    assert renderer.stats.views_drawn == 0
    wall.stencil = cc.Stencil(func="notequal", reference=5)
    after = draw(renderer)
    assert renderer.stats.views_drawn == 1
    assert (before != after).any()
    assert_identical(after, draw(fresh_renderer))
    wall.stencil = None
    assert (draw(renderer) != after).any()


def test_a_probe_with_a_stencil(renderer):
    world = disc_and_plane("equal")
    ball = world.scene.add(cc.Mesh.sphere(0.1), cc.MirrorMaterial(), position=(0.3, 0.2, 4))
    probe = cc.Probe(
        position=(0.3, 0.2, 4), size=24, format="rgba32f", depth_format="depth24_stencil8"
    )
    ball.environment = probe
    renderer.update_probes(world.scene)
    options = {"position": (0.3, 0.2, 4), "size": 24, "exclude": [ball]}
    masked = renderer.capture(world.scene, depth_format="depth24_stencil8", **options).faces
    plain = renderer.capture(world.scene, **options).faces
    assert_identical(renderer.read_probe(probe).faces, masked)
    assert (masked != plain).any()
    probe.depth_format = "depth_component32f"
    renderer.update_probes(world.scene)
    assert_identical(renderer.read_probe(probe).faces, plain)


# The class Stencil, and the materials' property of that name.

SHADER = "vec3 shade(Surface surface) { return vec3(1.0); }"


def test_defaults_repr_and_equality():
    stencil = cc.Stencil()
    for field in dataclasses.fields(Stencil):
        assert getattr(stencil, field.name) == field.default
    assert repr(stencil) == "Stencil()"
    assert repr(cc.Stencil(func="equal", reference=3, write_mask=0)) == (
        "Stencil(func='equal', reference=3, write_mask=0)"
    )
    same = cc.Stencil(func="less", reference=7, depth_pass="incr")
    assert same == cc.Stencil(func="less", reference=7, depth_pass="incr")
    assert hash(same) == hash(cc.Stencil(func="less", reference=7, depth_pass="incr"))
    for field in dataclasses.fields(Stencil):
        other: Any = {"func": "equal"}.get(field.name, 9 if field.type is int else "zero")
        assert cc.Stencil(**{field.name: other}) != stencil, field.name
    assert stencil != "always"


def test_it_never_changes():
    for field in dataclasses.fields(Stencil):
        with pytest.raises(AttributeError):
            setattr(cc.Stencil(), field.name, getattr(Stencil(), field.name))


@copies
def test_copies(make_copy):
    stencil = cc.Stencil(
        func="gequal",
        reference=200,
        read_mask=15,
        write_mask=240,
        fail="zero",
        depth_fail="decr_wrap",
        depth_pass="invert",
    )
    assert make_copy(stencil) == stencil
    scene = cc.Scene()
    scene.add(cc.Mesh.box(), cc.GlassMaterial(stencil=stencil))
    assert make_copy(scene).nodes[0].material.stencil == stencil


@pytest.mark.parametrize(
    "kind",
    [
        cc.BasicMaterial,
        cc.PhongMaterial,
        cc.MirrorMaterial,
        cc.GlassMaterial,
        lambda **more: cc.ShaderMaterial(SHADER, **more),
    ],
)
def test_every_material_has_one(kind):
    assert kind().stencil is None
    material = kind(stencil=cc.Stencil(reference=1))
    assert material.stencil == cc.Stencil(reference=1)
    if not isinstance(material, cc.ShaderMaterial):  # its repr shows only source and inputs
        assert "stencil=Stencil(reference=1)" in repr(material)
    material.stencil = None
    assert "stencil" not in repr(material)
    assert material.stencil is None
    with pytest.raises(TypeError, match="stencil"):
        kind(stencil="always")
    with pytest.raises(TypeError, match="stencil"):
        material.stencil = {"func": "always"}


BAD = {
    "func": ({"func": "eq"}, ValueError, "func.*'notequal'.*'eq'"),
    "func None": ({"func": None}, TypeError, "func"),
    "fail": ({"fail": "increment"}, ValueError, "fail.*'incr_wrap'.*'increment'"),
    "depth_fail": ({"depth_fail": ""}, ValueError, "depth_fail"),
    "depth_pass": ({"depth_pass": "less"}, ValueError, "depth_pass"),
    "reference": ({"reference": 256}, ValueError, "reference.*0 to 255.*256"),
    "reference negative": ({"reference": -1}, ValueError, "reference.*-1"),
    "reference huge": ({"reference": 10**30}, ValueError, "reference"),
    "read_mask": ({"read_mask": 300}, ValueError, "read_mask"),
    "write_mask": ({"write_mask": -(2**70)}, ValueError, "write_mask"),
    "reference float": ({"reference": 1.0}, TypeError, "reference"),
    "reference bool": ({"reference": True}, TypeError, "reference"),
}


@pytest.mark.parametrize(("options", "error", "text"), BAD.values(), ids=BAD)
def test_bad_values(options, error, text):
    with pytest.raises(error, match=text):
        cc.Stencil(**options)


def test_numpy_integers_are_numbers():
    assert cc.Stencil(reference=np.uint8(3)).reference == 3
