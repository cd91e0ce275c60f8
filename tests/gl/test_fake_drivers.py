"""Drivers that this machine does not have, played by fake_egl.cpp: resets, GPUs that do not start, few units."""

import pytest

from tests.gl.fakes import build_fake, run_fake
from tests.helpers import run_python


@pytest.fixture(scope="module")
def fake(tmp_path_factory):
    return build_fake(tmp_path_factory.mktemp("fake"))


RESET = """
renderer = cc.Renderer(device="software")
draw = lambda: renderer.render(scene, camera, (32, 24), outputs=("id", "distance"))
first = draw()
same = lambda frame: np.array_equal(frame.color, first.color) and np.array_equal(frame.distance, first.distance)
"""


@pytest.mark.parametrize(
    "status", ["0x8253", "0x8254", "0x8255"], ids=["guilty", "innocent", "unknown"]
)
def test_a_reset_during_a_call_is_survived(fake, status):
    """The driver reports it at the end of the call; the old context is destroyed and the call is done again."""
    run_fake(
        fake,
        RESET
        + f"""
fake["reset_status"] = {status}
destroyed = fake["contexts_destroyed"]
fake["reset_answers"] = 3  # it lasts for a while
with warned(1, "the GPU was reset"):
    assert same(draw())
assert fake["reset_answers"] == 0
assert fake["contexts_destroyed"] == destroyed + 1
with warned(0):
    assert same(draw())
""",
    )


def test_a_second_reset_at_once_is_an_error_and_the_next_call_tries_again(fake):
    run_fake(
        fake,
        RESET
        + """
fake["reset_status"] = 0x8253
fake["resets"] = 2  # each context reports one reset
with warned(1, "the GPU was reset"):
    try:
        draw()
    except cc.ContextError as error:
        assert "lost at once" in str(error) and "because of what this renderer drew" in str(error), error
    else:
        raise AssertionError("expected a ContextError")
fake["resets"] = 0
with warned(1, "the GPU was reset"):
    assert same(draw())
renderer.close()
""",
    )


@pytest.mark.parametrize("error", ["0x300E", "0x3006", "0x3001", "0x3002"])
def test_a_context_that_cannot_be_made_current_is_replaced(fake, error):
    run_fake(
        fake,
        RESET
        + f"""
fake["current_error"], fake["current_fails"] = {error}, 1
with warned(1):
    assert same(draw())
fake["current_fails"] = 1
renderer.close()
fake["current_fails"] = 0
""",
    )


@pytest.mark.parametrize(
    ("error", "warnings"), [("0x3002", 0), ("0x300E", 1)], ids=["busy", "reset"]
)
def test_without_a_new_context_the_call_fails_and_a_later_one_works(fake, error, warnings):
    """A context that is only busy is used again; one that a reset has ended is not."""
    run_fake(
        fake,
        RESET
        + f"""
fake["no_contexts"], fake["current_error"] = 1, {error}
for _ in range(2):
    fake["current_fails"] = 1
    with warned(0):
        try:
            draw()
        except cc.ContextError as error:
            assert "was lost" in str(error) and "no new one can be made" in str(error), error
            assert "EGL_BAD_ALLOC" in str(error), error
        else:
            raise AssertionError("expected a ContextError")
fake["no_contexts"] = fake["current_fails"] = 0
with warned({warnings}):
    assert same(draw())
assert not renderer.closed
""",
    )


def test_a_handle_that_means_another_context_is_noticed(fake):
    """A lost renderer neither draws in the context that has its handle now nor destroys it."""
    run_fake(
        fake,
        """
draw = lambda renderer: renderer.render(scene, camera, (32, 24)).color
for close_first in (False, True):
    lost, heir = cc.Renderer(device="software"), cc.Renderer(device="software")
    first = draw(lost)
    assert np.array_equal(first, draw(heir))
    fake["one_handle"] = 1
    destroyed = fake["contexts_destroyed"]
    if not close_first:
        with warned(1, "now has the handle of ours"):
            assert np.array_equal(draw(lost), first)
        assert fake["contexts_destroyed"] == destroyed
    with warned(0):
        if close_first:
            lost.close()
            assert fake["contexts_destroyed"] == destroyed
        floor.position = (0, -1.1, 0)
        moved = draw(heir)
        if not close_first:
            assert np.array_equal(draw(lost), moved)
            lost.close()
            assert fake["contexts_destroyed"] == destroyed + 1
        floor.position = (0, -1, 0)
        assert np.array_equal(draw(heir), first) and not np.array_equal(first, moved)
        heir.close()
    fake["one_handle"] = 0
""",
    )


def test_a_call_that_is_done_again_counts_once(fake):
    """Probes with every_n_frames keep their rhythm through a reset."""
    run_fake(
        fake,
        """
probe = cc.Probe(position=(0, 0, 0), size=8, update=3)
scene.nodes[0].environment = probe
def rhythm(reset_at):
    drawn = []
    with cc.Renderer(device="software") as renderer:
        for step in range(9):
            scene.background = (0.1 * step, 0, 0)
            scene.environment = cc.CubeMap(np.full((6, 2, 2, 3), step, np.float32))
            if step == reset_at:
                fake["reset_answers"] = 1
            renderer.render(scene, camera, (8, 8))
            drawn.append(renderer.stats.probes_updated)
    return drawn
want = rhythm(None)
assert want == [1, 0, 0] * 3, want
for step in (1, 2, 3, 4):
    with warned(1, "the GPU was reset"):
        got = rhythm(step)
    assert [g for i, g in enumerate(got) if i != step] == [w for i, w in enumerate(want) if i != step], (step, got)
""",
    )


def test_a_gpu_gets_a_robust_context_and_a_software_driver_a_plain_one(fake):
    count = 'cc.Renderer().close(); print(fake["robust_contexts"])'
    assert run_fake(fake, count).stdout == "0\n"
    on_gpu = run_fake(fake, count, FAKE_RENDERER="Fake GPU", FAKE_PLAIN_DEVICE=1)
    assert on_gpu.stdout == "1\n"


def test_zink_gets_a_flush_before_each_resolve(fake):
    """Zink (Mesa 26.2) resolves one layer of several samples in its render pass, and forgets the others."""
    count = """
renderer = cc.Renderer(device=os.environ.get("FAKE_RENDERER") and "gpu" or "software")
scene = cc.Scene(background=(1, 0, 0))
before = fake["flushes"]
renderer.capture(scene, size=8, samples=1)
one = fake["flushes"] - before
renderer.capture(scene, size=8, samples=4)
print(fake["flushes"] - before - 2 * one)
"""
    assert run_fake(fake, count, FAKE_RENDERER="Fake GPU", FAKE_PLAIN_DEVICE=1).stdout == "0\n"
    on_zink = run_fake(fake, count, FAKE_RENDERER="zink (Fake GPU)", FAKE_PLAIN_DEVICE=1)
    assert on_zink.stdout == "6\n"


def test_pictures_are_read_through_one_buffer_on_a_gpu(fake):
    """The bytes are those of a software driver, which copies each face and output by itself."""
    script = """
outputs = ("distance", "z", "normal", "position", "id", "label", "depth", "stencil")
device = os.environ.get("FAKE_RENDERER") and "gpu" or "software"
renderer = cc.Renderer(device=device)
found = []
for format in ("rgba8", "rgba16f", "rgba32f", "rgb565"):
    for depth_format in ("depth32f_stencil8", "depth24_stencil8"):
        options = {"format": format, "outputs": outputs, "depth_format": depth_format}
        for samples in (1, 4):
            frame = renderer.render(scene, camera, (37, 21), samples=samples, **options)
            found += [frame.color, *frame.outputs.values()]
        cube = renderer.capture(scene, size=17, **options)
        found += [cube.faces, *cube.outputs.values()]
stereo = cc.StereoCamera(camera, camera, layout="side_by_side")
found += [renderer.render(scene, stereo, (34, 20)).color, renderer.shadow_map(scene, scene.lights[0])]
found.append(renderer.render(scene, camera, (9, 9), format=None, outputs=("id",)).id)
before = fake["pack_buffers"]
big = renderer.render(scene, camera, (2500, 2000), format="rgba32f", outputs=("id", "position"))
found += [big.color, big.id, big.position]
if device == "gpu":
    assert fake["pack_buffers"] == before + 1 and fake["direct_reads"] == 0
    assert fake["buffered_reads"] > 100
else:
    assert fake["pack_buffers"] == fake["buffered_reads"] == 0
import hashlib
print(hashlib.sha256(b"".join(np.ascontiguousarray(x).tobytes() for x in found)).hexdigest(), len(found))
"""
    plain = run_fake(fake, script)
    through = run_fake(fake, script, FAKE_RENDERER="Fake GPU", FAKE_PLAIN_DEVICE=1)
    assert plain.stdout == through.stdout
    assert len(plain.stdout) > 64


def test_a_fall_to_software_is_said_unless_software_is_wanted(fake):
    """EGL lists a GPU whose driver does not start."""
    run_fake(
        fake,
        """
with warned(1, "draws in software") as caught:
    renderer = cc.Renderer()
text = str(caught[0].message)
for word in ("llvmpipe", "device 0 (GPU)", "EGL_BAD_ALLOC", 'device="software"'):
    assert word in text, text
assert caught[0].filename == "<string>"
with warned(0):
    renderer.capture(scene, size=4)
    cc.Renderer(device="software").close()
    cc.Renderer(device=1).close()
    os.environ["CUBECAM_DEVICE"] = "software"
    cc.Renderer().close()
""",
        FAKE_GPU=1,
    )


def test_without_a_gpu_software_is_no_surprise(fake):
    run_fake(fake, "with warned(0): cc.Renderer().close()")


@pytest.mark.parametrize(
    ("name", "software"),
    [
        ("llvmpipe (LLVM 15.0.6, 256 bits)", True),
        ("Google SwiftShader", True),
        ("ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)))", True),
        ("virgl", True),
        ("virgl (LLVMPIPE (LLVM 17.0.6, 256 bits))", True),
        ("virgl (AMD Radeon RX 6800)", False),
        ("zink Vulkan 1.3(lavapipe)", True),
        ("D3D12 (Microsoft Basic Render Driver)", True),
        ("NVIDIA GeForce RTX 4090/PCIe/SSE2", False),
        ("Mesa Intel(R) UHD Graphics 620", False),
    ],
)
def test_software_is_known_by_its_name(fake, name, software):
    run_fake(
        fake,
        f"""
with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    with cc.Renderer() as renderer:
        assert renderer.info.software is {software}
assert cc.devices()[0].software is {software}
""",
        FAKE_RENDERER=name,
        FAKE_PLAIN_DEVICE=1,
    )


UNITS = """
import numpy as np
image = cc.Image(np.full((2, 2, 3), 128, np.uint8))
names = ("map", "metallic_roughness_map", "normal_map", "occlusion_map", "emissive_map", "clearcoat_map",
         "clearcoat_roughness_map", "clearcoat_normal_map", "sheen_color_map", "sheen_roughness_map", "anisotropy_map")
floor.material = cc.StandardMaterial(clearcoat=1, sheen_color=(1, 1, 1), anisotropy=0.5)
renderer = cc.Renderer(device="software")
renderer.render(scene, camera, (8, 8))
"""


def test_few_texture_units_are_refused_by_name(fake):
    """OpenGL guarantees 16 in one stage: with as many maps, none is left for shadows."""
    run_fake(
        fake,
        UNITS
        + """
for name in names:
    setattr(floor.material, name, image)
renderer.render(scene, camera, (8, 8))  # 11 of the material, 3 of the environment, 1 of shadows
scene.add(cc.PointLight((1, 3, 1), shadow=cc.Shadow(size=32)))
renderer.render(scene, camera, (8, 8))
scene.add(cc.PointLight((2, 3, 1), shadow=cc.Shadow(size=32)))
try:
    renderer.render(scene, camera, (8, 8))
except ValueError as error:
    assert "at most 16 textures" in str(error) and "3 of shadows" in str(error), error
else:
    raise AssertionError("expected a ValueError")
""",
        FAKE_UNITS=16,
    )


def test_few_texture_units_are_refused_for_users_shaders(fake):
    run_fake(
        fake,
        """
images = {f"t{i}": cc.Image(np.full((2, 2, 3), 100, np.uint8)) for i in range(16)}
source = "".join(f"uniform sampler2D t{i};" for i in range(16)) + (
    "vec3 shade(Surface s) { vec3 sum = lambert(s, vec3(1.0));"
    + "".join(f"sum += texture(t{i}, s.uv).rgb;" for i in range(16)) + "return sum; }")
source = source.replace("lambert(s, vec3(1.0))", "phong(s, vec3(1.0), 0.1, 0.7, 0.4, 9.0)")
floor.material = cc.ShaderMaterial(source, textures=images)
renderer = cc.Renderer(device="software")
try:
    renderer.render(scene, camera, (8, 8))
except ValueError as error:
    assert "at most 16 textures" in str(error), error
    assert "16 of the material" in str(error) and "1 of shadows" in str(error), error
else:
    raise AssertionError("expected a ValueError")
""",
        FAKE_UNITS=16,
    )


@pytest.mark.parametrize(
    ("variable", "limit"),
    [
        ("FAKE_LARGEST_DRAWN", "GL_MAX_FRAMEBUFFER_WIDTH"),
        ("FAKE_LARGEST_VIEWPORT", "GL_MAX_VIEWPORT_DIMS"),
    ],
)
def test_the_largest_face_is_what_can_be_drawn(fake, variable, limit):
    """A driver that looks up larger textures than it draws into: `info` tells the size that a capture accepts."""
    run_fake(
        fake,
        f"""
renderer = cc.Renderer(device="software")
limits = renderer.info.limits
assert limits.max_face_size == limits.max_frame_size == 40, (limits.max_face_size, limits.max_frame_size)
assert limits.max_cube_map_texture_size > 40 < limits.max_texture_size
assert renderer.capture(cc.Scene(), size=40).size == 40
assert renderer.render(cc.Scene(), camera, (40, 40)).size == (40, 40)
draws = (lambda: renderer.capture(cc.Scene(), size=41), lambda: renderer.render(cc.Scene(), camera, (41, 8)),
         lambda: renderer.render(cc.Scene(), camera, (8, 41)))
for draw in draws:
    try:
        draw()
    except ValueError as error:
        assert "expected 1 to 40 pixels ({limit} of " in str(error), error
    else:
        raise AssertionError("expected a ValueError")
from click.testing import CliRunner
from cubecam.cli import app
text = CliRunner().invoke(app, ["info", "--device", "software"]).output
assert "largest frame: 40, largest face: 40" in text, text
""",
        **{variable: 40},
    )


TOO_OLD = """
import cubecam as cc
try:
    cc.Renderer()
except cc.ContextError as error:
    print(error)
"""


def test_a_driver_that_is_too_old_is_not_called_missing():
    """As softpipe, which offers OpenGL 3.3: the hint names what chose it, and not a package that is there."""
    text = run_python(TOO_OLD, MESA_GL_VERSION_OVERRIDE="3.3").stdout
    assert "offers OpenGL 3.3" in text
    assert "MESA_GL_VERSION_OVERRIDE=3.3 is set" in text
    for wrong in ("apt install", "missing", "NVIDIA"):
        assert wrong not in text


@pytest.mark.llvmpipe("the variables of another driver are in the way")
def test_a_chosen_driver_that_does_not_start_is_named(fake):
    """As zink without a driver of Vulkan."""
    text = run_fake(
        fake, 'fake["no_contexts"] = 1\n' + TOO_OLD, MESA_LOADER_DRIVER_OVERRIDE="swrast"
    ).stdout
    assert "MESA_LOADER_DRIVER_OVERRIDE=swrast is set" in text
    for wrong in ("apt install", "is missing"):
        assert wrong not in text


@pytest.mark.parametrize("refused", [False, True], ids=["known", "refused"])
def test_the_display_counts_its_users_where_the_driver_has_such_displays(fake, refused):
    """EGL_KHR_display_reference; the list of extensions may be another driver's, which then refuses the attribute."""
    run_fake(
        fake,
        f"""
fake["refuses_counting"] = {int(refused)}
with warned(0):
    cc.Renderer(device="software").render(scene, camera, (32, 24))
counted, plain = fake["counted_displays"], fake["plain_displays"]
assert (counted, plain) == ((0, 1) if {refused} else (1, 0)), (counted, plain)
""",
        FAKE_COUNTED=1,
    )


def test_the_display_is_a_plain_one_where_no_driver_counts(fake):
    run_fake(
        fake,
        """
cc.Renderer(device="software").render(scene, camera, (32, 24))
assert (fake["counted_displays"], fake["plain_displays"]) == (0, 1)
""",
    )
