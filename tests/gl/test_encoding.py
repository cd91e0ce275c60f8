"""What the numbers of frames and captures are, and what is saved of them."""

import copy
import io
import pickle
from typing import Any

import numpy as np
import pytest

import cubecam as cc
from tests.compare import assert_close, assert_identical
from tests.gl.flat import flat_camera, quad
from tests.reference.tone import TONE_CURVES, srgb_decode, srgb_encode

LOOK: dict[str, Any] = {"tonemap": "neutral", "encode": "srgb"}
PHOTO = np.random.default_rng(1).integers(1, 255, (4, 6, 3)).astype(np.uint8)
SKY = np.random.default_rng(2).integers(1, 255, (6, 4, 4, 3)).astype(np.uint8)
GLSL = "uniform sampler2D photo; vec3 shade(Surface surface) { return texture(photo, surface.uv).rgb; }"
LIT = "vec3 shade(Surface surface) { return phong(surface, vec3(1), 0.1, 0.5, 0.2, 8.0); }"


def panel(material, **options):
    scene = cc.Scene(**options)
    scene.add(quad(6, 4), material)
    return scene


def drawn(renderer, scene, **options):
    return renderer.render(scene, flat_camera(6, 4), (6, 4), **options)


def scene_of(scene):
    """A material that shows another scene."""
    return cc.BasicMaterial(map=cc.RenderTexture(scene, flat_camera(6, 4), size=(6, 4)))


SRGB = {
    "a photograph": lambda: panel(cc.BasicMaterial(map=PHOTO)),
    "tinted": lambda: panel(cc.BasicMaterial(map=PHOTO, color=(0.5, 0.7, 1))),
    "pure colours beside it": lambda: two(
        cc.BasicMaterial(map=PHOTO), cc.BasicMaterial(color="red")
    ),
    "floats that say so": lambda: panel(
        cc.BasicMaterial(map=cc.Image(PHOTO / np.float32(255), encoding="srgb"))
    ),
    "a cube on a cube": lambda: panel(cc.BasicMaterial(cubemap=cc.CubeMap(SKY))),
    "a sky": lambda: cc.Scene(environment=cc.CubeMap(SKY)),
    "a mirror": lambda: panel(cc.MirrorMaterial(), environment=cc.CubeMap(SKY)),
    "glass": lambda: panel(cc.GlassMaterial(), environment=cc.CubeMap(SKY)),
    "a probe": lambda: probed(cc.CubeMap(SKY)),
    "GLSL of a user": lambda: panel(cc.ShaderMaterial(GLSL, textures={"photo": cc.Image(PHOTO)})),
    "a scene in a scene": lambda: panel(scene_of(panel(cc.BasicMaterial(map=PHOTO)))),
    "lights that nothing uses": lambda: with_light(panel(cc.BasicMaterial(map=PHOTO))),
    "a hidden lit node": lambda: hidden(cc.PhongMaterial()),
}
LINEAR = {
    "nothing": lambda: cc.Scene(),
    "a lit photograph": lambda: with_light(panel(cc.PhongMaterial(map=PHOTO))),
    "lit GLSL": lambda: panel(cc.ShaderMaterial(LIT)),
    "floats": lambda: panel(cc.BasicMaterial(map=PHOTO / np.float32(255))),
    "bytes that say so": lambda: panel(cc.BasicMaterial(map=cc.Image(PHOTO, encoding="linear"))),
    "a colour": lambda: panel(cc.BasicMaterial(color=(0.5, 0.5, 0.5))),
    "a colour beside a photograph": lambda: two(
        cc.BasicMaterial(map=PHOTO), cc.BasicMaterial(color="gray")
    ),
    "a background": lambda: panel(cc.BasicMaterial(map=PHOTO), background=(0.2, 0.3, 0.4)),
    "a linear sky": lambda: panel(
        cc.BasicMaterial(map=PHOTO), background=cc.CubeMap(SKY, encoding="linear")
    ),
    "a lit scene in a scene": lambda: panel(scene_of(panel(cc.PhongMaterial()))),
    "vertex colours": lambda: coloured(),
}


def two(first, second):
    scene = panel(first)
    scene.add(quad(6, 4), second, position=(0, 0, -1))
    return scene


def with_light(scene):
    scene.add(cc.PointLight(position=(0, 0, 5)))
    return scene


def hidden(material):
    scene = panel(cc.BasicMaterial(map=PHOTO))
    scene.add(quad(6, 4), material).visible = False
    return scene


def probed(sky):
    scene = panel(cc.MirrorMaterial(), environment=sky)
    next(iter(scene.nodes)).environment = cc.Probe(size=4)
    return scene


def coloured():
    mesh = quad(6, 4)
    colors = np.full((len(mesh.positions), 4), 0.5, np.float32)
    mesh = cc.Mesh(mesh.positions, mesh.indices, normals=mesh.normals, uvs=mesh.uvs, colors=colors)
    scene = cc.Scene()
    scene.add(mesh, cc.BasicMaterial(map=PHOTO, vertex_colors=True))
    return scene


@pytest.mark.parametrize("name", SRGB)
def test_unlit_pictures_of_srgb_sources_are_srgb(renderer, name):
    scene = SRGB[name]()
    assert drawn(renderer, scene).encoding == "srgb"
    assert drawn(renderer, scene, format="rgba32f", outputs=["id"]).encoding == "srgb"
    assert renderer.capture(scene, size=4).encoding == "srgb"


@pytest.mark.parametrize("name", LINEAR)
def test_all_others_are_linear(renderer, name):
    scene = LINEAR[name]()
    assert drawn(renderer, scene).encoding == "linear"
    assert drawn(renderer, scene, encode="srgb").encoding == "srgb"
    assert drawn(renderer, scene, tonemap="neutral").encoding == "linear"
    assert renderer.capture(scene, size=4).encoding == "linear"


def test_a_capture_counts_what_it_shows(renderer):
    scene = panel(cc.BasicMaterial(map=PHOTO))
    lamp = scene.add(quad(6, 4), cc.PhongMaterial(), in_captures=False)
    assert renderer.capture(scene, size=4).encoding == "srgb"
    lamp.in_captures = True
    assert renderer.capture(scene, size=4).encoding == "linear"
    assert renderer.capture(scene, size=4, exclude=[lamp]).encoding == "srgb"


def test_a_probe_knows_what_it_holds(renderer):
    for sky, want in ((cc.CubeMap(SKY), "srgb"), (cc.CubeMap(SKY, encoding="linear"), "linear")):
        scene = probed(sky)
        drawn(renderer, scene)
        probe = next(iter(scene.nodes)).environment
        assert renderer.read_probe(probe).encoding == want


@pytest.mark.parametrize("lit_first", [True, False])
def test_two_views_of_one_scene_both_count(renderer, lit_first):
    """One render texture excludes the lit node, and the other shows it."""
    inner = panel(cc.BasicMaterial(map=PHOTO))
    lit = inner.add(quad(6, 4), cc.PhongMaterial(), position=(0, 0, -1))
    views = [
        cc.RenderTexture(inner, flat_camera(6, 4), size=(6, 4), exclude=nodes)
        for nodes in ([], [lit])
    ]
    scene = cc.Scene()
    for view in views if lit_first else views[::-1]:
        scene.add(quad(6, 4), cc.BasicMaterial(map=view))
    assert drawn(renderer, scene).encoding == "linear"
    only = panel(cc.BasicMaterial(map=views[1]))
    assert drawn(renderer, only).encoding == "srgb"


def test_a_probe_counts_what_the_capture_excludes(renderer):
    scene = probed(cc.CubeMap(SKY))
    lit = scene.add(quad(6, 4), cc.PhongMaterial(), position=(0, 0, 3))
    assert renderer.capture(scene, size=4, exclude=[lit]).encoding == "linear"
    next(iter(scene.nodes)).environment = cc.Probe(size=4, exclude=[lit])
    assert renderer.capture(scene, size=4, exclude=[lit]).encoding == "srgb"


def test_a_change_of_sources_changes_the_encoding(renderer):
    material = cc.BasicMaterial(map=PHOTO)
    scene = panel(material)
    assert drawn(renderer, scene).encoding == "srgb"
    material.map = cc.Image(PHOTO, encoding="linear")
    assert drawn(renderer, scene).encoding == "linear"


@pytest.mark.parametrize("kind", ["rgba8", "rgba16f", "rgba32f"])
def test_an_unlit_photograph_is_saved_as_it_is(renderer, tmp_path, kind):
    frame = drawn(renderer, panel(cc.BasicMaterial(map=PHOTO)), format=kind)
    frame.save(tmp_path / "a.png")
    assert_identical(cc.load_image(tmp_path / "a.png")[..., :3], PHOTO)


def lamp(rgb):
    return panel(cc.BasicMaterial(color=rgb))


@pytest.mark.parametrize("tonemap", ["neutral", "reinhard", "aces"])
@pytest.mark.parametrize("exposure", [0, 1.5, -4])
def test_the_gpu_and_to_screen_agree(renderer, tonemap, exposure):
    """One picture graded on the GPU and one graded by to_screen differ by a rounding at most."""
    scene = panel(cc.BasicMaterial(map=(PHOTO / np.float32(30)) ** 2))
    gpu = drawn(renderer, scene, exposure=exposure, tonemap=tonemap, encode="srgb").color
    cpu = cc.to_screen(drawn(renderer, scene, format="rgba32f"), exposure=exposure, tonemap=tonemap)
    assert np.abs(gpu.astype(int) - cpu).max() <= 1


@pytest.mark.parametrize("samples", [1, 4])
def test_exposure_multiplies_light_before_the_curve(renderer, samples):
    scene = lamp((0.3, 0.2, 0.1))
    got = drawn(renderer, scene, format="rgba32f", exposure=2, samples=samples).color[0, 0]
    assert_close(got, [1.2, 0.8, 0.4, 1], "float32_maths")
    got = drawn(renderer, scene, format="rgba32f", exposure=2, tonemap="aces", samples=samples)
    want = TONE_CURVES["aces"](np.array([1.2, 0.8, 0.4]))
    assert_close(got.color[0, 0, :3], want, "tone")


def test_a_new_exposure_draws_anew(fresh_renderer):
    scene = lamp((0.3, 0.2, 0.1))
    for exposure, views in ((0, 1), (1, 1), (1, 0), (0, 1)):
        got = drawn(fresh_renderer, scene, format="rgba32f", exposure=exposure, tonemap="reinhard")
        assert fresh_renderer.stats.views_drawn == views
        light = np.array([0.3, 0.2, 0.1]) * 2.0**exposure
        assert_close(got.color[0, 0, :3], light / (1 + light), "tone")


@pytest.mark.parametrize("exposure", [np.nan, np.inf, 65, -64.5])
def test_bad_exposures(renderer, exposure):
    with pytest.raises(ValueError, match="exposure: expected -64 to 64 stops, got"):
        drawn(renderer, lamp((1, 1, 1)), exposure=exposure)


def test_an_exposure_of_nothing(renderer):
    with pytest.raises(ValueError, match=r"exposure.*format"):
        drawn(renderer, lamp((1, 1, 1)), exposure=1, format=None, outputs=["id"])


def test_a_frame_is_saved_as_a_screen_shows_it(renderer, tmp_path):
    frame = drawn(renderer, lamp((5.0, 0.5, 0.1)), format="rgba16f")
    frame.save(tmp_path / "a.png", exposure=-1, tonemap="aces")
    got = cc.load_image(tmp_path / "a.png")
    assert_identical(got, cc.to_screen(frame, exposure=-1, tonemap="aces"))
    want = srgb_encode(TONE_CURVES["aces"](frame.color[..., :3].astype(float) / 2)) * 255
    assert np.abs(got[..., :3] - want).max() <= 0.51
    for path in ("b.png", "c.png"):
        if path == "b.png":
            frame.save(tmp_path / path)
        else:
            cc.save_image(tmp_path / path, frame)
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "c.png").read_bytes()
    assert (tmp_path / "b.png").read_bytes() == frame._repr_png_()


@pytest.mark.parametrize("kind", ["rgba8", "rgba16f", "rgba32f"])
def test_a_tone_curve_is_applied_once(renderer, tmp_path, kind):
    scene = lamp((5.0, 0.5, 0.1))
    frame = drawn(renderer, scene, format=kind, tonemap="aces")
    light = TONE_CURVES["aces"](np.array([5.0, 0.5, 0.1]))
    for again in (frame, pickle.loads(pickle.dumps(frame)), copy.deepcopy(frame)):
        again.save(tmp_path / "a.png")
        got = cc.load_image(tmp_path / "a.png")
        assert np.abs(got[..., :3] - srgb_encode(light) * 255).max() <= 1.5
        assert_identical(got, cc.to_screen(again))
    with pytest.raises(ValueError, match="tonemap: expected"):
        frame.save(tmp_path / "a.png", tonemap="filmic")
    cc.save_animation(tmp_path / "b.png", [frame])
    assert_identical(cc.load_image(tmp_path / "b.png")[..., :3], got[..., :3])


@pytest.mark.parametrize("name", ["a.png", "a.jpg", "a.bmp", "{face}.bmp"])
@pytest.mark.parametrize("layout", [None, "column", "equirect"])
def test_a_capture_with_nan_has_a_picture(renderer, tmp_path, name, layout):
    """NaN is black, as in frames, whether the file holds alpha or not."""
    if "{face}" in name:
        layout = None
    bad = "vec3 shade(Surface surface) { return vec3(uintBitsToFloat(0x7fc00000u), 0.5, 1.0); }"
    scene = cc.Scene(background=(1, 1, 1))
    scene.add(quad(60, 40), cc.ShaderMaterial(bad), position=(0, 0, -3))
    cube = renderer.capture(scene, size=4, format="rgba32f")
    assert np.isnan(cube.faces).any()
    cube.save(tmp_path / name, layout=layout)
    if layout == "equirect":
        got, want = cc.load_image(tmp_path / name), cc.to_screen(cube.to_equirect())
    else:
        got, want = cc.load_cubemap(tmp_path / name, layout=layout).faces, cc.to_screen(cube)
    if name.endswith(".jpg"):
        assert abs(got[..., :3].mean() - want[..., :3].mean()) < 2
    else:
        assert_identical(got[..., :3], want[..., :3])


def test_a_frame_of_bytes_is_encoded_without_a_curve(renderer, tmp_path):
    frame = drawn(renderer, lamp((0.9, 0.5, 0.1)))
    frame.save(tmp_path / "a.png")
    want = srgb_encode(frame.color[..., :3] / 255) * 255
    assert np.abs(cc.load_image(tmp_path / "a.png")[..., :3] - want).max() <= 0.51


def test_exr_holds_light(renderer, tmp_path):
    frame = drawn(renderer, lamp((5.0, 0.5, 0.1)), format="rgba32f")
    frame.save(tmp_path / "a.exr")
    assert_identical(cc.load_image(tmp_path / "a.exr"), frame.color)
    encoded = drawn(renderer, lamp((0.5, 0.25, 0.1)), format="rgba32f", encode="srgb")
    encoded.save(tmp_path / "b.exr")
    got = cc.load_image(tmp_path / "b.exr")[0, 0]
    np.testing.assert_allclose(got, [0.5, 0.25, 0.1, 1], atol=1e-5)


def test_jpeg_holds_an_opaque_frame(renderer, tmp_path):
    frame = drawn(renderer, lamp((0.5, 0.5, 0.1)))
    frame.save(tmp_path / "a.jpg")
    assert cc.load_image(tmp_path / "a.jpg").shape == (4, 6, 3)


def test_a_frame_without_colour_has_no_picture(renderer, tmp_path):
    frame = drawn(renderer, lamp((1, 1, 1)), format=None, outputs=["id"])
    for call in (
        lambda: frame.save(tmp_path / "a.png"),
        lambda: cc.to_screen(frame),
        lambda: np.asarray(frame),
    ):
        with pytest.raises(ValueError, match="expected a frame with a colour"):
            call()
    assert frame._repr_png_() is None
    assert not (tmp_path / "a.png").exists()


def test_frames_are_arrays(renderer):
    frame = drawn(renderer, lamp((0.5, 0.25, 1)), format="rgba32f")
    assert np.shares_memory(np.asarray(frame), frame.color)
    assert frame.color.flags.writeable
    shared = np.from_dlpack(frame)
    frame.color[0, 0, 0] = 9
    assert shared[0, 0, 0] == 9
    # Older versions of numpy read DLPack before version 1, which cannot say that an array may be written.
    assert shared.flags.writeable == (np.lib.NumpyVersion(np.__version__) >= "2.1.0")


def test_dlpack_copies_if_the_reader_wants_a_copy(renderer):
    class Older:
        """Gives the numbers as a producer of DLPack before version 1."""

        def __init__(self, capsule):
            self.capsule = capsule

        def __dlpack__(self, **_):
            return self.capsule

        def __dlpack_device__(self):
            return 1, 0

    frame = drawn(renderer, lamp((0.5, 0.25, 1)), format="rgba32f")
    assert np.shares_memory(np.from_dlpack(Older(frame.__dlpack__())), frame.color)
    copied = np.from_dlpack(Older(frame.__dlpack__(copy=True)))
    assert_identical(copied, frame.color)
    assert not np.shares_memory(copied, frame.color)
    for version in (None, (1, 0)):
        with pytest.raises(BufferError, match="dl_device: expected main memory"):
            frame.__dlpack__(dl_device=(2, 0), max_version=version)


def test_matplotlib_shows_frames(renderer):
    import matplotlib as mpl

    mpl.use("agg")
    import matplotlib.pyplot as plt

    frame = drawn(renderer, lamp((0.5, 0.25, 1)))
    figure, axes = plt.subplots()
    try:
        shown = axes.imshow(frame)
        assert_identical(np.asarray(shown.get_array()), frame.color)
        figure.savefig(io.BytesIO())
    finally:
        plt.close(figure)


def test_frames_keep_format_and_encoding(renderer):
    for kind in ("rgba8", "rgba16f", "rgb565"):
        frame = drawn(renderer, lamp((0.5, 0.25, 1)), format=kind, encode="srgb", outputs=["id"])
        for again in (pickle.loads(pickle.dumps(frame)), copy.deepcopy(frame)):
            assert (again.format, again.encoding) == (kind, "srgb")
        assert repr(frame) == (
            f"Frame(size=(6, 4), format='{kind}', outputs=('id',), encoding='srgb')"
        )


def test_stereo_pictures_have_an_encoding(renderer):
    camera = cc.StereoCamera.off_axis(cc.PerspectiveCamera(), layout="side_by_side")
    scene = cc.Scene(environment=cc.CubeMap(SKY))
    assert renderer.render(scene, camera, (8, 4)).encoding == "srgb"


@pytest.mark.parametrize("options", [{"encode": "srgb"}, {"tonemap": "aces"}, LOOK])
@pytest.mark.parametrize("kind", ["rgba8", "rgba16f", "rgba32f"])
def test_what_is_encoded_is_not_encoded_again(renderer, tmp_path, options, kind):
    frame = drawn(renderer, panel(cc.BasicMaterial(map=PHOTO)), format=kind, **options)
    assert frame.encoding == "srgb"
    assert_identical(cc.to_screen(frame)[..., :3], PHOTO)
    frame.save(tmp_path / "a.png")
    assert_identical(cc.load_image(tmp_path / "a.png")[..., :3], PHOTO)


@pytest.mark.parametrize("exposure", [-1.5, 1])
@pytest.mark.parametrize("options", [{}, {"encode": "srgb"}, {"tonemap": "aces", "encode": "srgb"}])
def test_exposure_of_what_is_encoded_works_in_linear_light(renderer, exposure, options):
    scene = panel(cc.BasicMaterial(map=PHOTO))
    gpu = drawn(renderer, scene, exposure=exposure, **options)
    light = srgb_decode(PHOTO / 255) * 2.0**exposure
    want = np.floor(srgb_encode(np.clip(light, 0, 1)) * 255 + 0.5)
    assert gpu.encoding == "srgb"
    assert np.abs(gpu.color[..., :3].astype(int) - want).max() <= 1
    if exposure < 0:  # without anything to clip
        cpu = cc.to_screen(drawn(renderer, scene), exposure=exposure)
        assert np.abs(gpu.color.astype(int) - cpu).max() <= 1


def test_a_light_makes_the_same_call_encode(fresh_renderer):
    """The kept picture of an encoded scene is not taken for that of a lit one, nor the other way round."""
    material = cc.BasicMaterial(map=PHOTO)
    scene = panel(material)
    for image in (PHOTO, cc.Image(PHOTO, encoding="linear"), PHOTO):
        material.map = image
        got = drawn(fresh_renderer, scene, **LOOK).color[..., :3]
        if isinstance(image, np.ndarray):
            assert_identical(got, PHOTO)
        else:
            want = srgb_encode(TONE_CURVES["neutral"](PHOTO / 255)) * 255
            assert np.abs(got - want).max() <= 0.6
