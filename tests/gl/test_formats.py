"""Formats and dtypes, depth and stencil buffers by choice; tone curves and the sRGB curve against numpy."""

import pickle

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.crowd import COLORLESS, COMBINATIONS, crowd
from tests.gl.world import (
    OUTPUTS,
    capture_hits,
    inner,
    orthographic,
    perspective,
    room,
    smooth_environment,
)
from tests.reference import tone
from tests.reference import transforms as ref
from tests.reference.compositing import over
from tests.reference.raycast import interior

FORMATS = {"rgba8": np.uint8, "rgba16f": np.float16, "rgba32f": np.float32}
formats = pytest.mark.parametrize(("fmt", "dtype"), FORMATS.items(), ids=FORMATS)


@formats
def test_dtype_follows_the_format(renderer, fmt, dtype):
    scene = cc.Scene(background=(0.25, 0.5, 1, 1))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    frame = renderer.render(scene, camera, (4, 4), format=fmt).color
    cube = renderer.capture(scene, size=4, format=fmt)
    assert frame.dtype == cube.faces.dtype == cube.dtype == dtype
    want = [0.25, 0.5, 1, 1] if dtype != np.uint8 else [64, 128, 255, 255]
    np.testing.assert_array_equal(frame[0, 0], want)
    np.testing.assert_array_equal(cube.faces[3, 2, 1], want)


def test_defaults(renderer):
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    assert renderer.render(cc.Scene(), camera, (4, 4)).color.dtype == np.uint8
    assert renderer.capture(cc.Scene()).faces.shape == (6, 256, 256, 4)
    assert renderer.capture(cc.Scene()).dtype == np.float32


def test_formats_agree(renderer):
    scene = cc.Scene(background=cc.CubeMap(smooth_environment(16)))
    full = renderer.capture(scene, size=16).faces
    assert_close(
        renderer.capture(scene, size=16, format="rgba16f").faces.astype(float), full, "half"
    )
    assert_close(
        renderer.capture(scene, size=16, format="rgba8").faces / 255, np.clip(full, 0, 1), "unorm8"
    )


def test_huge_and_tiny_numbers_are_kept(renderer):
    scene = cc.Scene(background=(3e30, 60000, 1e-30, 1))
    np.testing.assert_array_equal(
        renderer.capture(scene, size=2).faces[0, 0, 0],
        np.array([3e30, 60000, 1e-30, 1], np.float32),
    )
    assert renderer.capture(scene, size=2, format="rgba16f").faces[0, 0, 0, 1] == 60000


@pytest.mark.parametrize("fmt", ["rgb8", "RGBA8", "float32", "", None, 8])
def test_unknown_formats_are_refused_naming_those_there_are(renderer, fmt):
    with pytest.raises((ValueError, TypeError)) as raised:
        renderer.capture(cc.Scene(), size=4, format=fmt)
    if isinstance(fmt, str):
        assert "rgba16f" in str(raised.value)


@pytest.mark.parametrize("outputs", [("depths",), ("colour",), "distance", (3,), ("id", "deep")])
def test_unknown_outputs_are_refused(renderer, outputs):
    if (
        outputs == "distance"
    ):  # a string is a sequence of letters; cubecam may also take it as one name
        return
    with pytest.raises((ValueError, TypeError), match=r"distance|outputs"):
        renderer.capture(cc.Scene(), size=4, outputs=outputs)


@pytest.fixture(scope="module")
def bright():
    """A scene whose background goes from black to 40, with saturated and grey colours."""
    faces = np.random.default_rng(2).random((6, 16, 16, 3)).astype(np.float32)
    faces *= np.float32(10.0) ** np.linspace(-3, 1.6, 16, dtype=np.float32)[:, None]
    faces[2] = faces[2, ..., :1]
    return cc.Scene(background=cc.CubeMap(faces))


@pytest.fixture
def raw(renderer, bright):
    view = perspective((0, 0, 0), (0.3, 0.2, -1), fov=110)
    return view, renderer.render(bright, view.camera, view.size, format="rgba32f").color


@pytest.mark.parametrize("curve", ["reinhard", "aces", "neutral"])
@pytest.mark.parametrize("encode", [None, "srgb"])
def test_tone_curves(renderer, bright, raw, curve, encode):
    view, linear = raw
    want = tone.TONE_CURVES[curve](linear[..., :3].astype(float))
    if encode:
        want = tone.srgb_encode(want)
    got = renderer.render(
        bright, view.camera, view.size, format="rgba32f", tonemap=curve, encode=encode
    ).color
    assert_close(got[..., :3], want, "tone")
    assert_identical(got[..., 3], linear[..., 3])


def test_srgb_alone(renderer, bright, raw):
    """The sRGB standard ends at 1; it does not define the values of a float picture above 1."""
    view, linear = raw
    got = renderer.render(bright, view.camera, view.size, format="rgba32f", encode="srgb").color
    low = (linear[..., :3] <= 1).all(-1)
    assert_close(got[..., :3], tone.srgb_encode(linear[..., :3].astype(float)), "tone", mask=low)
    assert (got[~low][:, :3].max(-1) >= 1).all()


def test_eight_bits_of_the_curve(renderer, bright, raw):
    view, linear = raw
    got = renderer.render(bright, view.camera, view.size, tonemap="aces", encode="srgb").color
    want = tone.srgb_encode(tone.aces(linear[..., :3].astype(float))) * 255
    assert np.abs(got[..., :3] - want).max() < 0.51
    assert got.dtype == np.uint8


def test_alpha_is_not_curved(renderer):
    scene = cc.Scene(background=(0.5, 0.5, 0.5, 0.5))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    got = renderer.render(
        scene, camera, (2, 2), format="rgba32f", tonemap="reinhard", encode="srgb"
    ).color
    assert (got[..., 3] == 0.5).all()


@pytest.mark.parametrize("option", [{"tonemap": "filmic"}, {"encode": "rec709"}, {"tonemap": ""}])
def test_unknown_curves_are_refused(renderer, option):
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, 0))
    with pytest.raises(ValueError, match=r"reinhard|srgb"):
        renderer.render(cc.Scene(), camera, (2, 2), **option)


# The format rgb565 has five, six and five bits.


def as_565(color):
    """The bytes that are read back for a linear colour in rgb565."""
    bits = np.array([5, 6, 5])
    whole = np.round(np.clip(color, 0, 1)[..., :3] * (2**bits - 1))
    rgb = np.round(whole * 255 / (2**bits - 1))
    return np.concatenate([rgb, np.full_like(rgb[..., :1], 255)], axis=-1).astype(np.uint8)


def test_rgb565_values_are_the_quantised_ones(any_path):
    """The test uses every level of each channel, as the background and as a shaded colour."""
    for level in range(64):
        color = np.array([level // 2 / 31, level / 63, 1 - level // 2 / 31])
        off = color + 0.3 / 63 * (-1) ** level  # between two levels, rounded to this one
        scene = cc.Scene(background=np.clip(off, 0, 1))
        box = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=color), position=(0.2, 0.1, -2))
        cube = any_path.capture(scene, size=8, format="rgb565", outputs=("id",))
        want = np.where(cube.id[..., None] == box.id, as_565(color), as_565(off))
        assert cube.faces.dtype == np.uint8
        np.testing.assert_array_equal(cube.faces, want)


def test_rgb565_is_the_picture_in_fewer_levels(renderer):
    view, scene = perspective((0, 0, 0), (0.3, 0.2, -1)), cc.Scene()
    scene.background = cc.CubeMap(smooth_environment(16))
    full = renderer.render(scene, view.camera, view.size, format="rgba32f").color[..., :3]
    got = renderer.render(scene, view.camera, view.size, format="rgb565").color
    assert (got[..., 3] == 255).all()
    assert_close(got[..., 0] / 255, np.clip(full[..., 0], 0, 1), "unorm5")
    assert_close(got[..., 1] / 255, np.clip(full[..., 1], 0, 1), "unorm6")
    assert_close(got[..., 2] / 255, np.clip(full[..., 2], 0, 1), "unorm5")
    assert len(np.unique(got[..., 1])) > len(np.unique(got[..., 2])) > 10


def test_rgb565_has_no_alpha(renderer):
    scene = cc.Scene(background=(1, 0, 0, 0.25))
    assert renderer.capture(scene, size=2, format="rgb565").faces[0, 0, 0].tolist() == [
        255,
        0,
        0,
        255,
    ]
    pane = cc.BasicMaterial(color=(0, 0, 1), opacity=16 / 31, double_sided=True)
    scene.add(cc.Mesh.plane(9, 9), pane, position=(0, -1, 0))
    faces = renderer.capture(scene, size=2, format="rgb565").faces
    np.testing.assert_array_equal(faces[3, 0, 0], as_565(np.array([15, 0, 16]) / 31))


def test_rgb565_of_an_encoded_frame(renderer, bright, raw):
    view, linear = raw
    got = renderer.render(
        bright, view.camera, view.size, format="rgb565", tonemap="aces", encode="srgb"
    ).color
    want = tone.srgb_encode(tone.aces(linear[..., :3].astype(float)))
    assert_close(got[..., 1] / 255, want[..., 1], "unorm6")
    assert_close(got[..., 2] / 255, want[..., 2], "unorm5")
    assert (got[..., 3] == 255).all()


def test_rgb565_probe_is_looked_up(renderer):
    scene = cc.Scene(background=(0.4, 0.5, 0.6))
    ball = scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial(), position=(0, 0, -3))
    ball.environment = cc.Probe(position=(0, 0, -3), size=8, format="rgb565", mipmaps=True)
    camera = cc.PerspectiveCamera(fov=50, position=(0, 0, 1), target=(0, 0, -3))
    frame = renderer.render(scene, camera, (8, 8), format="rgba32f", outputs=("id",))
    levels = np.round(np.array([0.4, 0.5, 0.6]) * [31, 63, 31]) / [31, 63, 31]
    np.testing.assert_allclose(frame.color[4, 4, :3], levels, atol=1e-2)
    assert (renderer.read_probe(ball.environment).faces == as_565(np.array([0.4, 0.5, 0.6]))).all()


# The next tests are about depth formats.

DEPTHS = (
    "depth_component32f",
    "depth_component24",
    "depth_component16",
    "depth24_stencil8",
    "depth32f_stencil8",
)
STENCILS = ("depth24_stencil8", "depth32f_stencil8", "stencil_index8")
PAINTERS = (None, "stencil_index8")
depth_formats = pytest.mark.parametrize("depth_format", DEPTHS)
PLACE = ((1.2, 0.9, -0.2), (-0.6, -0.1, 1.5))
VIEWS = {
    "perspective": lambda: perspective(*PLACE, near=0.2, far=20),
    "orthographic": lambda: orthographic(*PLACE, near=0.2, far=20),
}


@depth_formats
@pytest.mark.parametrize("make", VIEWS.values(), ids=VIEWS)
def test_depth_is_the_window_space_value(any_path, depth_format, make):
    world, view = room(), make()
    frame = any_path.render(
        world.scene, view.camera, view.size, depth_format=depth_format, outputs=("depth",)
    )
    hits = view.hits(world.shapes)
    parallel = isinstance(view.camera, cc.OrthographicCamera)
    want = ref.window_depth(hits.t, view.near, view.far, parallel)
    assert (~hits.hit).any()
    assert frame.depth.dtype == np.float32
    tolerance = "depth16" if depth_format == "depth_component16" else "window_depth"
    assert_close(frame.depth, want, tolerance, mask=inner(hits))
    assert (frame.depth[~hits.hit & inner(hits)] == 1).all()


@depth_formats
def test_depth_of_a_capture(any_path, depth_format):
    world = room()
    cube = any_path.capture(
        world.scene, size=24, near=0.1, far=30, depth_format=depth_format, outputs=("depth", "z")
    )
    hits = capture_hits(world, size=24, near=0.1, far=30)
    tolerance = "depth16" if depth_format == "depth_component16" else "window_depth"
    want = ref.window_depth(hits.t, 0.1, 30)
    assert cube.depth.dtype == np.float32
    assert not cube.depth.flags.writeable
    assert_close(cube.depth, want, tolerance, mask=inner(hits))


@pytest.mark.parametrize(
    ("depth_format", "bits"),
    [("depth_component16", 16), ("depth_component24", 24), ("depth24_stencil8", 24)],
)
def test_fixed_point_depth_is_what_the_buffer_holds(renderer, depth_format, bits):
    """Depth is in whole steps: the step nearest to the float depth, or its neighbour at a rounding boundary."""
    world, view = room(), perspective(*PLACE, near=0.2, far=20)
    fixed, full = (
        renderer.render(
            world.scene, view.camera, view.size, depth_format=name, outputs=("depth",)
        ).depth.astype(float)
        for name in (depth_format, "depth_component32f")
    )
    most = 2**bits - 1
    steps = np.round(fixed * most)
    # float32 has 24 bits: near 1 a step of 2^-24 is rounded to the nearest float.
    np.testing.assert_array_equal((steps / most).astype(np.float32), fixed.astype(np.float32))
    assert np.abs(steps - ref.quantised(full, bits)).max() <= 1
    assert len(np.unique(steps)) > 100


def test_a_stencil_beside_it_does_not_change_depth(renderer):
    world, view = room(), perspective(*PLACE)
    depth = {
        name: renderer.render(
            world.scene, view.camera, view.size, depth_format=name, outputs=("depth",)
        ).depth
        for name in DEPTHS
    }
    assert_identical(depth["depth24_stencil8"], depth["depth_component24"])
    assert_identical(depth["depth32f_stencil8"], depth["depth_component32f"])


@depth_formats
def test_other_outputs_do_not_hang_on_the_depth_format(renderer, depth_format):
    """The outputs are compared only away from the lines where two surfaces meet."""
    world, view = room(), perspective(*PLACE, near=0.2, far=20)
    a, b = (
        renderer.render(world.scene, view.camera, view.size, depth_format=name, outputs=OUTPUTS)
        for name in (depth_format, "depth_component32f")
    )
    mask = inner(view.hits(world.shapes))
    for name in ("color", *OUTPUTS):
        assert_identical(getattr(a, name)[mask], getattr(b, name)[mask], name)


def test_sixteen_bits_cannot_tell_far_things_apart(renderer):
    """Two walls 50 units away are 0.01 units apart: a step of 16-bit depth is much larger there."""
    scene = cc.Scene()
    far = scene.add(
        cc.Mesh.box((99, 99, 1)), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -51)
    )
    scene.add(cc.Mesh.box((99, 99, 1)), cc.BasicMaterial(color=(0, 1, 0)), position=(0, 0, -50.99))
    far.render_order = -1
    camera = cc.PerspectiveCamera(fov=60, near=0.1, far=1000)
    seen = {
        name: renderer.render(scene, camera, (4, 4), depth_format=name).color[0, 0, :2].tolist()
        for name in ("depth_component16", "depth_component32f")
    }
    assert seen == {"depth_component16": [255, 0], "depth_component32f": [0, 255]}


def test_depth_of_an_empty_picture(renderer):
    camera = cc.PerspectiveCamera()
    for name in DEPTHS:
        outputs = ("depth", "stencil") if name in STENCILS else "depth"
        frame = renderer.render(cc.Scene(), camera, (3, 2), depth_format=name, outputs=outputs)
        assert (frame.depth == 1).all()
        assert frame.stencil is None or not frame.stencil.any()


# The next tests draw pictures without a colour buffer.


@depth_formats
@pytest.mark.parametrize("samples", [1, 4])
def test_without_a_color_only_outputs_come_back(any_path, depth_format, samples):
    world, view = room(), perspective(*PLACE)
    names = ("depth", *OUTPUTS)
    options = {"depth_format": depth_format, "outputs": names, "samples": samples}
    bare = any_path.render(world.scene, view.camera, view.size, format=None, **options)
    full = any_path.render(world.scene, view.camera, view.size, **options)
    assert bare.color is None
    assert bare.size == view.size
    for name in names:
        assert_identical(getattr(bare, name), getattr(full, name), name)


def test_a_frame_without_a_color_is_a_frame(renderer):
    camera = cc.PerspectiveCamera()
    frame = renderer.render(cc.Scene(), camera, (3, 2), format=None, outputs="depth")
    assert repr(frame) == ("Frame(size=(3, 2), format=None, outputs=('depth',), encoding='linear')")
    assert frame._repr_png_() is None
    copied = pickle.loads(pickle.dumps(frame))
    assert copied.color is None
    assert_identical(copied.depth, frame.depth)
    assert renderer.render(cc.Scene(), camera, (3, 2), format=None).color is None


def test_the_background_needs_no_color(renderer):
    """A skybox is not drawn, and a second call draws no picture."""
    scene = cc.Scene(background=cc.CubeMap(smooth_environment(4)))
    camera = cc.PerspectiveCamera()
    renderer.render(scene, camera, (5, 4), format=None, outputs="depth")
    assert (renderer.stats.views_drawn, renderer.stats.draw_calls) == (1, 0)
    renderer.render(scene, camera, (5, 4), format=None, outputs="depth")
    assert renderer.stats.views_drawn == 0


REFUSED = {
    "stencil without one": ({"outputs": "stencil"}, "outputs.*depth24_stencil8.*component32f"),
    "stencil of nothing": ({"outputs": "stencil", "depth_format": None}, "outputs.*none"),
    "depth without one": ({"outputs": "depth", "depth_format": None}, "outputs.*none"),
    "depth of a stencil": ({"outputs": "depth", "depth_format": "stencil_index8"}, "outputs.*at most"),
    "id without depth": ({"outputs": ("id",), "depth_format": None}, "outputs.*depth"),
    "distance of a stencil": (
        {"outputs": ("stencil", "distance"), "depth_format": "stencil_index8"},
        "outputs.*depth",
    ),
    "unknown": ({"depth_format": "depth16"}, "depth_format.*depth_component16.*'depth16'"),
    "empty": ({"depth_format": ""}, "depth_format.*stencil_index8"),
}  # fmt: skip
REFUSED_FRAMES = {
    "tone mapping of nothing": ({"format": None, "tonemap": "aces"}, "tonemap.*format"),
    "encoding of nothing": ({"format": None, "encode": "srgb"}, "encode.*format"),
    "nothing at all": ({"format": None, "depth_format": None}, "format, depth_format"),
}


@pytest.mark.parametrize(("options", "text"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_together_is_refused(renderer, options, text):
    with pytest.raises(ValueError, match=text):
        renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), **options)
    with pytest.raises(ValueError, match=text):
        renderer.capture(cc.Scene(), size=4, **options)


@pytest.mark.parametrize(("options", "text"), REFUSED_FRAMES.values(), ids=REFUSED_FRAMES)
def test_frames_of_nothing_are_refused(renderer, options, text):
    with pytest.raises(ValueError, match=text):
        renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), **options)


@pytest.mark.parametrize("bad", [16, ("depth_component16",), b"x"])
def test_depth_formats_are_names(renderer, bad):
    with pytest.raises((TypeError, ValueError)):
        renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), depth_format=bad)


def test_faces_need_a_format(renderer):
    with pytest.raises(ValueError, match=r"format.*faces.*None"):
        renderer.capture(cc.Scene(), size=4, format=None)
    with pytest.raises(TypeError):
        cc.Probe(format=None)  # type: ignore[arg-type]


# The next tests draw without a depth buffer, as a painter paints: later nodes cover earlier ones.


def overlapping():
    """A world of overlapping nodes, some of them translucent, and the order in which they are painted."""
    world = room()
    for index in range(0, len(world.shapes), 3):
        world.scene.nodes[index].material.opacity = 0.5
    for node, order in zip(
        world.scene.nodes, (0, 3, -1, 3, 0, -(2**31), 2**31 - 1, 0), strict=True
    ):
        node.render_order = order
    world.scene.background = (0.1, 0.2, 0.3, 1)
    return world, sorted(world.scene.nodes, key=lambda node: (node.render_order, node.id))


@pytest.mark.parametrize("depth_format", PAINTERS)
def test_without_depth_nodes_are_painted_in_order(any_path, depth_format):
    world, order = overlapping()
    view = perspective((1.2, 0.9, -3.5), (0, 0, 0.5))
    got = any_path.render(
        world.scene, view.camera, view.size, format="rgba32f", depth_format=depth_format
    ).color
    want = np.broadcast_to(np.array([0.1, 0.2, 0.3, 1], np.float64), got.shape)
    mask = np.ones(got.shape[:2], bool)
    shapes = {shape.id: shape for shape in world.shapes}
    for node in order:
        hits = view.hits([shapes[node.id]])
        color = (*world.colors[node.id][:3], node.material.opacity)
        want = np.where(hits.hit[..., None], over(color, want), want)
        mask &= inner(hits) | (node.id == 6)
    mask &= interior(view.hits([shapes[6]]).id)  # the edges of the sphere's facets are not masked
    assert_close(got, want, "float32_maths", mask=mask)


@pytest.mark.parametrize("depth_format", PAINTERS)
def test_the_painter_in_captures_and_probes(new_renderer, depth_format):
    world, _ = overlapping()
    layered, one_pass = new_renderer(layered=True), new_renderer(layered=False)
    cubes = [
        r.capture(world.scene, size=24, depth_format=depth_format) for r in (layered, one_pass)
    ]
    assert_identical(cubes[0].faces, cubes[1].faces, across="programs")
    with_depth = layered.capture(world.scene, size=24).faces
    assert (cubes[0].faces != with_depth).any()
    ball = world.scene.add(cc.Mesh.sphere(0.1), cc.MirrorMaterial())
    ball.environment = cc.Probe(size=24, format="rgba32f", depth_format=depth_format)
    layered.update_probes(world.scene)
    assert_identical(layered.read_probe(ball.environment).faces, cubes[0].faces)


def test_the_sky_is_behind_the_painter(renderer):
    scene = cc.Scene(background=cc.CubeMap(smooth_environment(8)))
    scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(0, 0, -3))
    camera = cc.PerspectiveCamera(fov=50)
    a, b = (
        renderer.render(scene, camera, (32, 24), depth_format=name).color
        for name in (None, "depth_component32f")
    )
    assert_identical(a, b)


# The next tests check what all combinations of formats must fulfil.


@pytest.mark.parametrize("options", COMBINATIONS.values(), ids=COMBINATIONS)
def test_layered_equals_one_pass(new_renderer, options):
    scene = crowd(np.random.default_rng(32))
    a, b = (
        new_renderer(layered=layered).capture(scene, size=24, **options)
        for layered in (True, False)
    )
    for name in ("faces", *options.get("outputs", ())):
        assert_identical(getattr(a, name), getattr(b, name), name, across="programs")
    assert a == b
    copied = pickle.loads(pickle.dumps(a))
    assert copied == a
    for name in options.get("outputs", ()):
        assert_identical(getattr(copied, name), getattr(a, name), name)


def test_each_choice_keeps_its_own_picture(fresh_renderer):
    scene, camera = crowd(np.random.default_rng(33)), cc.PerspectiveCamera(position=(0, 0, 5))

    def draw_all():
        for options in (COMBINATIONS | COLORLESS).values():
            yield fresh_renderer.render(scene, camera, (40, 30), **options)

    first = list(draw_all())
    for frame, again in zip(first, draw_all(), strict=True):
        assert fresh_renderer.stats.views_drawn == 0
        for name in ("color", "depth", "stencil"):
            a, b = getattr(frame, name), getattr(again, name)
            assert (a is None) == (b is None)
            if a is not None:
                assert_identical(a, b)


@pytest.mark.parametrize("depth_format", [*DEPTHS, *PAINTERS])
@pytest.mark.parametrize("fmt", ["rgba8", "rgb565", "rgba32f"])
def test_samples_average_edges_with_each(any_path, depth_format, fmt):
    scene = cc.Scene()
    scene.add(cc.Mesh.box((4, 4, 0.1)), cc.BasicMaterial(), position=(-2, 0.2, -2),
              rotation=cc.axis_angle((0, 0, 1), 10))  # fmt: skip
    camera = cc.PerspectiveCamera(fov=90)
    options = {"format": fmt, "depth_format": depth_format}
    one = any_path.render(scene, camera, (32, 32), **options).color[..., 0] * 1.0
    four = any_path.render(scene, camera, (32, 32), samples=4, **options).color[..., 0] * 1.0
    assert set(np.unique(one)) == {0, one.max()}
    assert len(np.unique(four)) == 5
    assert four.mean() == pytest.approx(one.mean(), rel=0.03)


@pytest.mark.parametrize("depth_format", DEPTHS)
def test_depth_of_samples_is_that_of_one(any_path, depth_format):
    world, view = room(), perspective(*PLACE)
    a, b = (
        any_path.render(world.scene, view.camera, view.size, depth_format=depth_format,
                        outputs=("depth", "id"), samples=samples)
        for samples in (1, 4)
    )  # fmt: skip
    assert_identical(a.depth, b.depth)
    assert_identical(a.id, b.id)


@pytest.mark.parametrize("options", [{"depth_format": None}, {"format": "rgb565"}])
def test_limits_hold_with_each(renderer, options):
    limits = renderer.info.limits
    camera = cc.PerspectiveCamera()
    with pytest.raises(ValueError, match=str(limits.max_texture_size)):
        renderer.render(cc.Scene(), camera, (limits.max_texture_size + 1, 1), **options)
    with pytest.raises(ValueError, match=str(limits.max_samples)):
        renderer.render(cc.Scene(), camera, (4, 4), samples=limits.max_samples + 1, **options)
    with pytest.raises(ValueError, match=str(limits.max_samples)):
        renderer.render(cc.Scene(), camera, (4, 4), samples=limits.max_samples + 1, format=None)


def test_what_writes_depth_late_is_in_depth(any_path):
    """A pane that blends and writes depth is in `depth`, also with samples and without a colour buffer."""
    scene = cc.Scene()
    scene.add(cc.Mesh.box((9, 9, 1)), cc.BasicMaterial(), position=(0, 0, -6.5))
    for z, write in ((-2, False), (-3, True)):
        pane = cc.BasicMaterial(opacity=0.5, depth_write=write)
        scene.add(cc.Mesh.box((9, 9, 0.002)), pane, position=(0, 0, z))
    camera = cc.PerspectiveCamera(fov=30, near=1, far=20)
    want = ref.window_depth(3 - 0.001, 1, 20)
    for options in ({}, {"samples": 4}, {"format": None}, {"format": "rgb565"}):
        frame = any_path.render(scene, camera, (6, 4), outputs=("depth", "z", "id"), **options)
        np.testing.assert_allclose(frame.depth, want, atol=1e-6)
        np.testing.assert_allclose(frame.z, 6, atol=1e-5)  # only opaque nodes write these
        assert (frame.id == 1).all()


def test_effects_need_a_color(renderer):
    effect = cc.ImageEffect("vec4 effect(vec2 uv) { return frame(uv); }")
    with pytest.raises(ValueError, match=r"effects.*format None"):
        renderer.render(cc.Scene(), cc.PerspectiveCamera(), (4, 4), format=None, effects=[effect])


@pytest.mark.parametrize("options", COMBINATIONS.values(), ids=COMBINATIONS)
def test_render_textures_have_them_too(renderer, options):
    """A render texture equals a frame with the same options."""
    options = {name: value for name, value in options.items() if name != "outputs"}
    scene = crowd(np.random.default_rng(34))
    for index, node in enumerate(scene.nodes):
        node.render_order = index % 3
    inner_camera = cc.PerspectiveCamera(fov=50, position=(2, 1.5, 5), target=(0, 0, 0))
    texture = cc.RenderTexture(scene, inner_camera, size=(40, 30), **options)
    outer = cc.Scene()
    outer.add(cc.Mesh.plane(2, 2), cc.BasicMaterial(map=texture), position=(0, -1, 0))
    camera = cc.PerspectiveCamera(fov=50, position=(0, 3, 0), target=(0, -1, 0), up=(0, 0, -1))
    renderer.render(outer, camera, (20, 20))
    held = renderer.read_texture(texture)
    want = renderer.render(scene, inner_camera, (40, 30), **options).color
    assert_identical(getattr(held, "color", held), want)
    copied = pickle.loads(pickle.dumps(texture))
    assert (copied.depth_format, copied.format) == (texture.depth_format, texture.format)


def test_probes_keep_their_depth_format(renderer):
    probe = cc.Probe(depth_format="depth_component16", format="rgb565")
    assert (probe.depth_format, probe.format) == ("depth_component16", "rgb565")
    assert pickle.loads(pickle.dumps(probe)).depth_format == "depth_component16"
    probe.depth_format = None
    assert pickle.loads(pickle.dumps(probe)).depth_format is None
    with pytest.raises(ValueError, match="depth_format"):
        probe.depth_format = "z16"  # type: ignore[assignment]
    with pytest.raises(ValueError, match="depth_format"):
        cc.Probe(depth_format="DEPTH_COMPONENT16")  # type: ignore[arg-type]
    assert cc.Probe().depth_format == "depth_component32f"
