"""P8: two eyes in one picture. Each is the frame of its own camera; their frusta against numpy."""

import numpy as np
import pytest

import cubecam as cc
from cubecam.truth.shading import normalised
from tests.compare import assert_close, assert_identical
from tests.gl.crowd import crowd
from tests.gl.world import OUTPUTS, everything, perspective, room
from tests.helpers import copies, need_equal_pixels
from tests.reference import transforms as ref
from tests.reference.raycast import interior

SIZE = (48, 36)
LENS = {"fov": 65, "position": (1.2, 0.9, -3.2), "target": (-0.2, -0.1, 0.5), "near": 0.3}
WHOLE = {"anaglyph": (1, 1), "side_by_side": (2, 1), "top_bottom": (1, 2)}
layouts = pytest.mark.parametrize("layout", WHOLE)
OPTIONS = {
    "plain": {},
    "float": {"format": "rgba32f"},
    "half": {"format": "rgba16f", "samples": 4},
    "565": {"format": "rgb565"},
    "samples": {"samples": 4},
    "graded": {"tonemap": "aces", "encode": "srgb", "samples": 4},
    "painter": {"depth_format": None},
    "sixteen bits": {"depth_format": "depth_component16"},
}
PAIRS = {
    "off axis": lambda camera: cc.StereoCamera.off_axis(camera, separation=0.3, convergence=4.0),
    "parallel": lambda camera: cc.StereoCamera.off_axis(camera, separation=0.3),
    "toe in": lambda camera: cc.StereoCamera.toe_in(camera, degrees=6),
    "of two kinds": lambda camera: cc.StereoCamera(
        camera, cc.OrthographicCamera(height=5, position=(3, 1, -2), target=(0, 0, 0))
    ),
    "the same twice": lambda camera: cc.StereoCamera(camera, camera),
}


def lens(**more):
    return cc.PerspectiveCamera(**{**LENS, **more})


def whole(layout, size=SIZE):
    return tuple(a * b for a, b in zip(size, WHOLE[layout], strict=True))


def split(array, layout):
    """Return the left and the right eye's part."""
    axis = {"side_by_side": 1, "top_bottom": 0}[layout]
    return np.split(array, 2, axis=axis)


@pytest.fixture(scope="module")
def scene():
    return everything()


@pytest.mark.slow
@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@pytest.mark.parametrize("make", PAIRS.values(), ids=PAIRS)
def test_an_anaglyph_is_both_eyes_own_frames(any_path, scene, make, options):
    """Red is the left eye's, green and blue are the right eye's, bit for bit; alpha is the greater one."""
    if options is OPTIONS["painter"]:
        need_equal_pixels()
    eyes = make(lens())
    got = any_path.render(scene, eyes, SIZE, **options).color
    left = any_path.render(scene, eyes.left, SIZE, **options).color
    right = any_path.render(scene, eyes.right, SIZE, **options).color
    assert (left != right).any() or eyes.left is eyes.right
    assert_identical(got[..., 0], left[..., 0])
    assert_identical(got[..., 1:3], right[..., 1:3])
    assert_identical(got[..., 3], np.maximum(left[..., 3], right[..., 3]))


@pytest.mark.parametrize("options", [{}, {"samples": 4}, {"format": None}])
@pytest.mark.parametrize("layout", ["side_by_side", "top_bottom"])
def test_halves_are_both_eyes_own_frames(any_path, scene, layout, options):
    """The other outputs are halves of the eyes' own frames as well."""
    eyes = cc.StereoCamera.off_axis(lens(), separation=0.3, convergence=4.0, layout=layout)
    options = {
        "outputs": (*OUTPUTS, "depth", "stencil"), "depth_format": "depth24_stencil8", **options
    }  # fmt: skip
    frame = any_path.render(scene, eyes, whole(layout), **options)
    assert frame.size == whole(layout)
    for index, camera in enumerate((eyes.left, eyes.right)):
        own = any_path.render(scene, camera, SIZE, **options)
        for name in ("color", *options["outputs"]):
            if getattr(own, name) is None:
                assert getattr(frame, name) is None
                continue
            part = split(getattr(frame, name), layout)[index]
            assert_identical(part, getattr(own, name), name)


EFFECT = """
uniform float strength = 0.5;
vec4 effect(vec2 uv) {
    ivec2 here = ivec2(gl_FragCoord.xy);
    return mix(frame_pixel(here), frame_pixel(here + ivec2(3, 1)), strength) + vec4(uv, 0.0, 0.0);
}
"""


@pytest.mark.parametrize("options", [{}, {"tonemap": "aces", "samples": 4}])
@pytest.mark.parametrize("count", [1, 3])
def test_effects_run_over_each_eye(any_path, scene, options, count):
    """An effect that reads neighbouring pixels must not see those of the other eye."""
    eyes = cc.StereoCamera.off_axis(lens(), separation=0.3, convergence=4.0)
    effects = [cc.ImageEffect(EFFECT) for _ in range(count)]
    left, right = (
        any_path.render(scene, camera, SIZE, effects=effects, **options).color
        for camera in (eyes.left, eyes.right)
    )
    got = any_path.render(scene, eyes, SIZE, effects=effects, **options).color
    assert_identical(got[..., 0], left[..., 0])
    assert_identical(got[..., 1:3], right[..., 1:3])
    eyes.layout = "side_by_side"
    pair = any_path.render(scene, eyes, whole("side_by_side"), effects=effects, **options).color
    for part, own in zip(split(pair, "side_by_side"), (left, right), strict=True):
        assert_identical(part, own)
    effects[0].uniforms["strength"] = 0.0
    changed = any_path.render(scene, eyes, whole("side_by_side"), effects=effects, **options).color
    assert (changed != pair).any()
    own = any_path.render(scene, eyes.right, SIZE, effects=effects, **options).color
    assert_identical(split(changed, "side_by_side")[1], own)


def test_alpha_is_the_greater(renderer):
    """Only the left eye looks at an opaque wall, and only the right eye at a pane."""
    scene = cc.Scene(background=(0, 0, 0, 0.25))
    scene.add(cc.Mesh.box((4, 4, 0.1)), cc.BasicMaterial(), position=(-2.5, 0, -3))
    scene.add(cc.Mesh.box((4, 4, 0.1)), cc.BasicMaterial(opacity=0.5), position=(2.5, 0, -3))
    at = {x: cc.PerspectiveCamera(fov=20, position=(x, 0, 0)) for x in (-2.5, 2.5, 30)}
    for fmt, scale in (("rgba8", 255), ("rgba16f", 1), ("rgba32f", 1)):
        for left, right, want in (
            (-2.5, 2.5, 1), (2.5, -2.5, 1), (2.5, 30, 0.625), (30, 2.5, 0.625), (30, 30, 0.25)
        ):  # fmt: skip
            eyes = cc.StereoCamera(at[left], at[right])
            alpha = renderer.render(scene, eyes, (4, 4), format=fmt).color[2, 2, 3]
            assert float(alpha) / scale == pytest.approx(want, abs=1.01 / 255)


def test_a_mono_frame_is_what_it_was(renderer, fresh_renderer, scene):
    before = fresh_renderer.render(scene, lens(), SIZE, outputs=OUTPUTS)
    renderer.render(scene, cc.StereoCamera.toe_in(lens()), SIZE)
    after = renderer.render(scene, lens(), SIZE, outputs=OUTPUTS)
    for name in ("color", *OUTPUTS):
        assert_identical(getattr(after, name), getattr(before, name), name)


# What is drawn again.


def counts(renderer):
    return renderer.stats.views_drawn, renderer.stats.views_skipped


def test_only_the_eye_that_changed_is_drawn(any_path):
    scene = room().scene
    eyes = cc.StereoCamera.off_axis(lens(), separation=0.3, convergence=4.0)
    any_path.render(scene, eyes, SIZE)
    assert counts(any_path) == (2, 0)
    any_path.render(scene, eyes, SIZE)
    assert counts(any_path) == (0, 2)
    assert any_path.stats.draw_calls == 0
    left, right = eyes.left, eyes.right
    assert isinstance(left, cc.PerspectiveCamera)
    assert isinstance(right, cc.PerspectiveCamera)
    left.fov = 64
    any_path.render(scene, eyes, SIZE)
    assert counts(any_path) == (1, 1)
    right.position = right.position + 0.01
    any_path.render(scene, eyes, SIZE)
    assert counts(any_path) == (1, 1)
    eyes.layout = "side_by_side"  # the same two pictures in other halves
    any_path.render(scene, eyes, whole("side_by_side"))
    assert counts(any_path) == (0, 2)
    scene.nodes[0].material.color = (1, 1, 1)
    any_path.render(scene, eyes, whole("side_by_side"))
    assert counts(any_path) == (2, 0)


def test_a_thing_that_one_eye_sees(renderer):
    """Eyes that look away from each other: each has its own nodes in its key."""
    scene = cc.Scene()
    nodes = [
        scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0, 0)), position=(x, 0, 0))
        for x in (-9, 9)
    ]
    eyes = cc.StereoCamera(
        *[cc.PerspectiveCamera(fov=40, position=(0, 0, 0.1), target=(x, 0, 0)) for x in (-9, 9)]
    )
    renderer.render(scene, eyes, SIZE)
    for node in nodes:
        node.scale = 1.5
        renderer.render(scene, eyes, SIZE)
        assert counts(renderer) == (1, 1)


@pytest.mark.slow
@layouts
def test_layered_equals_one_pass(new_renderer, layout):
    scene = everything()
    eyes = cc.StereoCamera.off_axis(lens(), separation=0.3, convergence=4.0, layout=layout)
    a, b = (
        new_renderer(layered=layered).render(scene, eyes, whole(layout)).color
        for layered in (True, False)
    )
    assert_identical(a, b, across="programs")


def test_one_picture_is_in_it_once(fresh_renderer, scene):
    """Two cameras in one place are one group of views: the layered path draws a mesh once for both."""
    turned = lens(target=(-0.4, -0.1, 0.5))
    for eyes in (cc.StereoCamera(lens(), turned), cc.StereoCamera(lens(), lens(fov=30))):
        got = fresh_renderer.render(scene, eyes, SIZE).color
        for camera, channels in ((eyes.left, [0]), (eyes.right, [1, 2])):
            own = fresh_renderer.render(scene, camera, SIZE).color
            assert_identical(got[..., channels], own[..., channels])


def test_far_from_the_origin_each_eye_counts_from_itself(fresh_renderer, renderer):
    """The right eye's picture does not depend on the place of the left eye."""
    offset = np.array([3e6, -1e6, 2e6])
    scene = crowd(np.random.default_rng(42), offset)
    near = cc.PerspectiveCamera(fov=50, position=np.add(offset, (2, 1.5, 5)), target=offset)
    far = cc.PerspectiveCamera(fov=50, position=(0, 0, 0), target=offset, far=1e8)
    got = fresh_renderer.render(scene, cc.StereoCamera(far, near), SIZE).color
    own = renderer.render(scene, near, SIZE).color
    assert len(np.unique(own[..., 1])) > 20
    assert_identical(got[..., 1:3], own[..., 1:3])


# The geometry is compared with numpy.


def ndc(camera, points, aspect):
    return ref.apply(np.asarray(camera.projection(aspect)) @ np.asarray(camera.view), points)


def points_before(camera, distances, rng, count=20):
    """World points at distances along the camera's axis, anywhere in its picture."""
    z = np.repeat(distances, count)
    x, y = rng.uniform(-0.4, 0.4, (2, len(z))) * z
    eye_space = np.stack([x, y, -z], axis=-1)
    return ref.apply(np.linalg.inv(np.asarray(camera.view)), eye_space), z


CAMERAS = {
    "perspective": lambda: lens(up=(0.2, 1, 0.1)),
    "ahead": lambda: cc.PerspectiveCamera(fov=90, position=(1, 2, 3)),
    "shifted": lambda: lens(shift=(0.25, -0.5)),
    "matrices": lambda: cc.Camera(
        view=ref.look_at((1, 2, 3), (0, 0, 0)), projection=ref.perspective(50, 1.5, 0.1, 50)
    ),
    "matrices with a scale": lambda: cc.Camera(
        view=np.diag([2, 2, 2, 1]) @ ref.look_at((1, 2, 3), (0, 0, 0)),
        projection=ref.perspective(50, 1.5, 0.1, 50),
    ),
}


@pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
@pytest.mark.parametrize("aspect", [1.5, 0.7])
def test_parallax_is_that_of_sheared_frusta(make, aspect, rng):
    """Parallax is 0 at the convergence distance, else separation * (1 / c - 1 / z) * f, and 0 upwards."""
    camera, separation, convergence = make(), 0.25, 3.0
    view = np.asarray(camera.view)
    scale = np.linalg.norm(view[0, :3])  # units of the camera's space for one world unit
    points, z = points_before(camera, scale * np.array([0.8, 2, 3, 5, 40]), rng)
    z = z / scale
    f = np.asarray(camera.projection(aspect))[0, 0]
    for where in (convergence, None):
        eyes = cc.StereoCamera.off_axis(camera, separation=separation, convergence=where)
        left, right = (ndc(eye, points, aspect) for eye in (eyes.left, eyes.right))
        want = separation * ((0 if where is None else 1 / where) - 1 / z) * f
        np.testing.assert_allclose(right[:, 0] - left[:, 0], want, atol=1e-9)
        np.testing.assert_allclose(right[:, 1:], left[:, 1:], atol=1e-9)
        if where is not None:
            middle = ndc(camera, points, aspect)
            at = z == convergence
            assert at.any()
            np.testing.assert_allclose(left[at], middle[at], atol=1e-9)
            assert (want[z > convergence] > 0).all()


@pytest.mark.parametrize("make", CAMERAS.values(), ids=CAMERAS)
def test_eyes_stand_beside_the_camera(make):
    camera = make()
    world = np.linalg.inv(np.asarray(camera.view))
    right = normalised(world[:3, 0])
    for convergence in (None, 2.0):
        eyes = cc.StereoCamera.off_axis(camera, separation=0.5, convergence=convergence)
        for eye, side in ((eyes.left, -0.25), (eyes.right, 0.25)):
            place = np.linalg.inv(np.asarray(eye.view))
            np.testing.assert_allclose(place[:3, 3], world[:3, 3] + side * right, atol=1e-12)
            np.testing.assert_allclose(place[:3, :3], world[:3, :3], atol=1e-12)


def test_the_camera_given_is_left_alone():
    camera = lens()
    cc.StereoCamera.off_axis(camera, separation=0.3, convergence=4.0)
    cc.StereoCamera.toe_in(camera, degrees=30)
    np.testing.assert_array_equal(camera.position, LENS["position"])
    np.testing.assert_array_equal(camera.shift, 0)


def test_orthographic_eyes():
    """The rays are parallel: the eyes' pictures differ by one shift, the same at every distance."""
    camera = cc.OrthographicCamera(height=4, position=(0, 0, 5), target=(0, 0, 0))
    eyes = cc.StereoCamera.off_axis(camera, separation=0.5)
    left, right = eyes.left, eyes.right
    assert isinstance(left, cc.OrthographicCamera)
    assert isinstance(right, cc.OrthographicCamera)
    np.testing.assert_allclose(left.position, [-0.25, 0, 5], atol=1e-12)
    np.testing.assert_allclose(np.asarray(right.target), [0.25, 0, 0], atol=1e-12)
    parallel = cc.Camera(view=np.eye(4), projection=camera.projection())
    for kind in (camera, parallel):
        with pytest.raises(ValueError, match="convergence"):
            cc.StereoCamera.off_axis(kind, separation=0.5, convergence=3.0)


@pytest.mark.parametrize(
    "make",
    [lambda: lens(up=(0.2, 1, 0.1)), lambda: cc.OrthographicCamera(position=(1, 2, 3), target=(0, 1, 0))],
    ids=["perspective", "orthographic"],
)  # fmt: skip
@pytest.mark.parametrize("degrees", [0.0, 4.0, 75.0])
def test_toe_in_turns_the_view_about_the_target(make, degrees):
    """Each eye is turned by +-degrees / 2 about the camera's up axis; the left eye stands to the left."""
    camera = make()
    view, target = np.asarray(camera.view), np.asarray(camera.target)
    up = view[1, :3]
    eyes = cc.StereoCamera.toe_in(camera, degrees=degrees)
    for eye, sign in ((eyes.left, -1), (eyes.right, 1)):
        turn = ref.rotation(ref.axis_angle(up, sign * degrees / 2))
        about = ref.translation(target) @ turn @ ref.translation(-target)
        np.testing.assert_allclose(eye.view, view @ np.linalg.inv(about), atol=1e-12)
        np.testing.assert_allclose(eye.projection(1.3), camera.projection(1.3), atol=0)
        assert isinstance(eye, cc.PerspectiveCamera | cc.OrthographicCamera)
        offset = (view @ [*eye.position, 1])[0]
        assert offset * sign >= 0
        assert ndc(eye, target, 1.3)[0] == pytest.approx(0, abs=1e-12)


def test_parallax_in_pixels(renderer):
    """A thin bar stands at each distance; its columns in both eyes' pictures are compared."""
    camera = cc.PerspectiveCamera(fov=60)
    for z in (2.0, 4.0, 8.0):
        scene = cc.Scene()
        scene.add(cc.Mesh.box((0.05 * z, 9, 0.001)), cc.BasicMaterial(), position=(0, 0, -z))
        eyes = cc.StereoCamera.off_axis(
            camera, separation=0.4, convergence=4.0, layout="side_by_side"
        )
        color = renderer.render(scene, eyes, (400, 100)).color[50, :, 0]
        left, right = (np.flatnonzero(part).mean() for part in np.split(color, 2))
        f = 1 / np.tan(np.radians(30)) / 2  # the aspect is 2
        assert right - left == pytest.approx(0.4 * (1 / 4 - 1 / z) * f / 2 * 200, abs=1)
        assert np.sign(round(right - left)) == np.sign(z - 4)


def test_a_shifted_lens_sees_another_part_of_the_same_picture(renderer):
    """The lens is shifted by half a picture up and a quarter to the right, in whole pixels."""
    world, view = room(), perspective((1.2, 0.9, -3.2), (-0.2, -0.1, 0.5), size=(48, 48))
    big = perspective((1.2, 0.9, -3.2), (-0.2, -0.1, 0.5), size=(96, 96))
    big.camera.fov = np.degrees(2 * np.arctan(2 * np.tan(np.radians(30))))
    view.camera.shift = (-0.25, 0.5)
    part = renderer.render(world.scene, view.camera, (48, 48), outputs=("id", "z"))
    full = renderer.render(world.scene, big.camera, (96, 96), outputs=("id", "z"))
    window = np.s_[0:48, 12:60]  # the middle is (24, 24); up by 24, left by 12
    assert (part.id == full.id[window]).mean() > 0.98
    mask = interior(part.id) & interior(full.id[window])
    assert_close(part.z, full.z[window], "distance", mask=mask & (part.id != 6))
    assert len(np.unique(part.id)) > 3


# Properties, errors, pickles.


def test_properties():
    a, b = lens(), lens(fov=20)
    eyes = cc.StereoCamera(a, b)
    assert (eyes.left, eyes.right, eyes.layout) == (a, b, "anaglyph")
    eyes.left, eyes.right, eyes.layout = b, a, "top_bottom"
    assert (eyes.left, eyes.right, eyes.layout) == (b, a, "top_bottom")
    assert "top_bottom" in repr(eyes)
    assert "fov=20" in repr(eyes)
    with pytest.raises(ValueError, match=r"anaglyph.*side_by_side.*top_bottom.*cross"):
        eyes.layout = "cross"  # type: ignore[assignment]
    with pytest.raises(TypeError, match="left"):
        eyes.left = None  # type: ignore[assignment]
    with pytest.raises(TypeError, match=r"right.*Camera"):
        eyes.right = eyes  # type: ignore[assignment]
    assert (eyes.left, eyes.right, eyes.layout) == (b, a, "top_bottom")


@copies
def test_copies(make_copy):
    eyes = cc.StereoCamera.off_axis(lens(), separation=0.3, convergence=4.0, layout="side_by_side")
    other = make_copy(eyes)
    assert other.layout == "side_by_side"
    for name in ("left", "right"):
        ours, theirs = getattr(eyes, name), getattr(other, name)
        assert type(theirs) is cc.PerspectiveCamera
        np.testing.assert_array_equal(theirs.view, ours.view)
        np.testing.assert_array_equal(theirs.projection(1.3), ours.projection(1.3))
        np.testing.assert_array_equal(theirs.shift, ours.shift)
    camera = lens()
    shared = make_copy(cc.StereoCamera(camera, camera))
    assert shared.left is shared.right


BAD = {
    "separation": (
        lambda: cc.StereoCamera.off_axis(lens(), separation=-0.1),
        ValueError,
        "separation.*-0.1",
    ),
    "separation nan": (
        lambda: cc.StereoCamera.off_axis(lens(), separation=np.nan),
        ValueError,
        "separation",
    ),
    "convergence 0": (
        lambda: cc.StereoCamera.off_axis(lens(), separation=1, convergence=0),
        ValueError,
        "convergence",
    ),
    "convergence inf": (
        lambda: cc.StereoCamera.off_axis(lens(), separation=1, convergence=np.inf),
        ValueError,
        "convergence",
    ),
    "degrees": (lambda: cc.StereoCamera.toe_in(lens(), degrees=180), ValueError, "degrees.*180"),
    "degrees negative": (lambda: cc.StereoCamera.toe_in(lens(), degrees=-1), ValueError, "degrees"),
    "no target": (
        lambda: cc.StereoCamera.toe_in(cc.PerspectiveCamera()),
        ValueError,
        "target.*none",
    ),
    "matrices": (
        lambda: cc.StereoCamera.toe_in(
            cc.Camera(view=np.eye(4), projection=np.diag([1, 1, -1, 1]))
        ),
        ValueError,
        "target.*matrices",
    ),
    "layout": (
        lambda: cc.StereoCamera(lens(), lens(), layout="red"),  # type: ignore[arg-type]
        ValueError,
        "layout.*anaglyph.*'red'",
    ),
    "layout of toe_in": (
        lambda: cc.StereoCamera.toe_in(lens(), layout=""),  # type: ignore[arg-type]
        ValueError,
        "layout",
    ),
    "no camera": (lambda: cc.StereoCamera(lens(), None), TypeError, "right.*Camera.*None"),  # type: ignore[arg-type]
    "a stereo camera": (
        lambda: cc.StereoCamera.off_axis(cc.StereoCamera(lens(), lens())),  # type: ignore[arg-type]
        TypeError,
        "camera.*Camera.*StereoCamera",
    ),
    "shift": (lambda: lens(shift=(1, 2, 3)), ValueError, "shift"),
    "shift nan": (lambda: lens(shift=(1, np.nan)), ValueError, "shift"),
}


@pytest.mark.parametrize(("make", "error", "text"), BAD.values(), ids=BAD)
def test_bad_values(make, error, text):
    with pytest.raises(error, match=text):
        make()


BAD_CALLS = {
    "odd width": ("side_by_side", (5, 4), {}, "size.*even width.*side_by_side.*5"),
    "odd height": ("top_bottom", (4, 7), {}, "size.*even height.*top_bottom.*7"),
    "no size": ("side_by_side", (0, 4), {}, "size"),
    "negative": ("top_bottom", (4, -2), {}, "size"),
    "outputs": ("anaglyph", (4, 4), {"outputs": "id"}, "outputs.*anaglyph"),
    "depth": ("anaglyph", (4, 4), {"outputs": ("depth",)}, "outputs.*anaglyph"),
    "no colour": ("anaglyph", (4, 4), {"format": None}, "format.*anaglyph.*None"),
    "samples": ("anaglyph", (4, 4), {"samples": 10**6}, "samples"),
}


@pytest.mark.parametrize(("layout", "size", "options", "text"), BAD_CALLS.values(), ids=BAD_CALLS)
def test_bad_calls(renderer, layout, size, options, text):
    eyes = cc.StereoCamera.off_axis(lens(), layout=layout)
    with pytest.raises(ValueError, match=text):
        renderer.render(cc.Scene(), eyes, size, **options)


def test_each_half_may_be_as_large_as_a_frame(renderer):
    limit = renderer.info.limits.max_texture_size
    eyes = cc.StereoCamera.off_axis(lens(), layout="side_by_side")
    with pytest.raises(ValueError, match=str(limit)):
        renderer.render(cc.Scene(), eyes, (2 * limit + 2, 1))
    assert renderer.render(cc.Scene(), eyes, (2 * limit, 1)).color.shape == (1, 2 * limit, 4)


def test_captures_take_no_stereo(renderer):
    with pytest.raises(TypeError, match="camera"):
        renderer.render(cc.Scene(), "camera", (4, 4))


def test_probes_serve_both_eyes(fresh_renderer):
    """A mirror's probe is drawn once for both eyes."""
    scene = room().scene
    ball = scene.add(cc.Mesh.sphere(0.4), cc.MirrorMaterial(), position=(0, 0.2, 0))
    ball.environment = cc.Probe(position=(0, 0.2, 0), size=8)
    fresh_renderer.render(scene, cc.StereoCamera.off_axis(lens(), separation=0.3), SIZE)
    assert fresh_renderer.stats.probes_updated == 1
    assert fresh_renderer.stats.views_drawn == 8
