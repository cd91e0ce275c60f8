"""Another library ends the display, or the GPU is reset: one warning, and the call gives the same bytes."""

import pytest

from tests.helpers import run_python

WORLD = """
import gc, threading, warnings
import numpy as np
import cubecam as cc
from tests.gl.full_world import full_world, pictures
from tests.gl.lost import EGL, EndsBeforeEachCall, end_displays, displays, warned

def same(got, want):
    assert got.keys() == want.keys()
    for name in want:
        nan = got[name].dtype.kind == "f"
        assert np.array_equal(got[name], want[name], equal_nan=nan), name
"""

ROOM = (
    WORLD
    + """
scene = cc.Scene(environment=cc.CubeMap(np.random.default_rng(1).random((6, 8, 8, 3), dtype=np.float32)))
probe = cc.Probe(position=(0, 0, 0), size=16, format="rgba32f", update="manual")
scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), environment=probe)
box = scene.add(cc.Mesh.box(1), cc.BasicMaterial(color=(1, 0.5, 0.2)), position=(0, 2, 0))
camera = cc.PerspectiveCamera(fov=60, position=(3, 2, 3), target=(0, 0, 0))
renderer = cc.Renderer(device="software")
renderer.update_probes(scene)
draw = lambda made=renderer: made.render(scene, camera, (32, 24)).color
want = draw()
"""
)


@pytest.mark.slow
def test_every_call_gives_the_same_bytes_after_the_display_was_ended():
    """Frames of all kinds, captures, shadow maps, reads of probes and of render textures."""
    run_python(
        WORLD
        + """
world = full_world(np.random.default_rng(3))
renderer = cc.Renderer(device="software")
want = pictures(renderer, world)
assert {"frame color", "capture", "shadow of light 0", "probe 0", "texture 1"} <= set(want)
ended = EndsBeforeEachCall(renderer)
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    got = pictures(ended, world)
assert [item.category for item in caught] == [cc.RendererWarning] * ended.calls
assert ended.calls > 12
same(got, want)
with warned(0):
    same(pictures(renderer, world), want)
""",
        timeout=300,
    )


def test_one_warning_at_the_users_line_and_the_next_call_gives_none():
    run_python(
        ROOM
        + """
for _ in range(3):
    end_displays()
    with warned(1) as caught:
        assert np.array_equal(draw(), want)
    assert caught[0].filename == "<string>", caught[0].filename
    assert "terminated the EGL display" in str(caught[0].message)
    with warned(0):
        assert np.array_equal(draw(), want)
        assert renderer.stats.views_drawn == 0
assert not EGL.eglGetCurrentContext()
assert not renderer.closed and renderer.info.renderer in repr(renderer)
"""
    )


def test_a_warning_that_is_an_error_leaves_the_renderer_usable():
    run_python(
        ROOM
        + """
end_displays()
try:
    draw()
except cc.RendererWarning as error:
    assert "was lost" in str(error)
else:
    raise AssertionError("expected the warning as an error")
assert np.array_equal(draw(), want)
"""
    )


def test_a_manual_probe_shows_its_scene_again():
    """It is drawn again from the scene as it is now, also if a call only reads it; its scene must still show it."""
    run_python(
        ROOM
        + """
cube = renderer.read_probe(probe).faces
end_displays()
with warned(1):
    assert np.array_equal(renderer.read_probe(probe).faces, cube)
end_displays()
with warned(1):
    assert np.array_equal(draw(), want)  # the mirror shows the probe
box.material = cc.BasicMaterial(color=(0, 0, 1))
assert np.array_equal(renderer.read_probe(probe).faces, cube)  # manual: still the old one
end_displays()
with warned(1):
    now = renderer.read_probe(probe).faces
assert not np.array_equal(now, cube)
with cc.Renderer(device="software") as fresh:
    fresh.update_probes(scene)
    assert np.array_equal(now, fresh.read_probe(probe).faces)
for node in list(scene.nodes):
    scene.remove(node)
end_displays()
with warned(1):
    try:
        renderer.read_probe(probe)
    except cc.ContextError as error:
        assert "probe" in str(error) and "lost" in str(error), error
    else:
        raise AssertionError("expected a ContextError")
"""
    )


def test_all_bounces_of_a_manual_probe_are_drawn_again():
    """Also the level of a mirror that no frame since has shown."""
    run_python(
        ROOM
        + """
other = cc.Probe(position=(1.5, 0, 0), size=16, format="rgba32f", update="manual", bounces=3)
scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial(), position=(1.5, 0, 0), environment=other)
renderer.update_probes(scene)
cubes = [renderer.read_probe(p).faces for p in (probe, other)]
want = draw()
end_displays()
with warned(1):
    for p, cube in zip((probe, other), cubes):
        assert np.array_equal(renderer.read_probe(p).faces, cube)
end_displays()
with warned(1):
    assert np.array_equal(draw(), want)
"""
    )


def test_an_undrawn_probe_stays_undrawn():
    run_python(
        ROOM
        + """
other = cc.Probe(position=(1, 0, 0))
end_displays()
with warned(1):
    try:
        renderer.read_probe(other)
    except ValueError as error:
        assert "has drawn" in str(error)
    else:
        raise AssertionError("expected a ValueError")
"""
    )


def test_closing_after_the_end_of_the_display_is_quiet():
    done = run_python(
        ROOM
        + """
others = [cc.Renderer(device="software") for _ in range(3)]
for other in others:
    other.capture(scene, size=4)
end_displays()
with warned(0):
    others.pop().close()
    others[0].close(); others[0].close()
    del others, other
    gc.collect()
with warned(1):
    assert np.array_equal(draw(), want)
end_displays()
"""
    )
    assert done.stderr == ""


def test_a_lost_renderer_never_touches_the_context_that_has_its_handle_now():
    """Mesa gives the memory of an ended context to the next one: its handle then means another renderer's context."""
    run_python(
        ROOM
        + """
for step in range(12):
    lost = cc.Renderer(device="software")
    lost.capture(scene, size=4)
    end_displays()
    new = cc.Renderer(device="software")
    first = draw(new)
    assert np.array_equal(first, cc.Renderer(device="software").render(scene, camera, (32, 24)).color)
    if step % 3 == 0:
        lost.close()
    elif step % 3 == 1:
        del lost
        gc.collect()
    else:
        with warned(1):
            lost.capture(scene, size=4)
    with warned(0):
        scene.background = (0.1 * step, 0.2, 0.3)
        cube = new.capture(scene, size=4).faces
        assert np.array_equal(cube, cc.Renderer(device="software").capture(scene, size=4).faces)
        new.close()
"""
    )


def test_a_context_of_another_library_on_the_ended_display_is_left_alone():
    """VTK ends the display, opens it again and draws: a lost renderer must not draw in VTK's context."""
    run_python(
        ROOM
        + """
import ctypes
display = displays()[-1]
def theirs():
    assert EGL.eglInitialize(display, None, None) and EGL.eglBindAPI(0x30A2)
    attributes = (ctypes.c_int * 7)(0x3098, 4, 0x30FB, 5, 0x30FD, 1, 0x3038)
    context = EGL.eglCreateContext(display, None, None, attributes)
    assert context, hex(EGL.eglGetError())
    return context
def function(name, result, *arguments):
    return ctypes.CFUNCTYPE(result, *arguments)(EGL.eglGetProcAddress(name))
get_error = function(b"glGetError", ctypes.c_uint)
generate = function(b"glGenTextures", None, ctypes.c_int, ctypes.c_void_p)
is_texture = function(b"glIsTexture", ctypes.c_ubyte, ctypes.c_uint)
bind = function(b"glBindTexture", None, ctypes.c_uint, ctypes.c_uint)
for step in range(8):
    lost = cc.Renderer(device="software")
    lost.render(scene, camera, (8, 8))
    end_displays()
    contexts = [theirs() for _ in range(3)]
    assert EGL.eglMakeCurrent(display, None, None, contexts[0])
    names = (ctypes.c_uint * 40)()
    generate(40, names)
    for name in names:
        bind(0x0DE1, name)
    with warned(1):
        lost.render(scene, camera, (8, 8))
    lost.close()
    assert EGL.eglGetCurrentContext() == contexts[0]
    assert all(is_texture(name) for name in names) and get_error() == 0
    for context in contexts:  # all of them still live
        assert EGL.eglMakeCurrent(display, None, None, context) and get_error() == 0
    assert EGL.eglMakeCurrent(display, None, None, None)
    for context in contexts:
        assert EGL.eglDestroyContext(display, context)
"""
    )


def test_threads_draw_on_while_another_library_ends_the_display():
    """The driver frees an ended display when its last context is let go; a display made at that moment must live."""
    run_python(
        ROOM
        + """
warnings.simplefilter("ignore", cc.RendererWarning)
stop, wrong, drawn = threading.Event(), [], [0] * 4
def work(index, mine):
    try:
        while not stop.is_set():
            if not np.array_equal(draw(mine), want):
                wrong.append("other pixels")
            drawn[index] += 1
    except BaseException as error:
        wrong.append(error)
mine = [cc.Renderer(device="software") for _ in range(2)]
for made in mine:
    made.update_probes(scene)
threads = [threading.Thread(target=work, args=(i, (renderer, renderer, *mine)[i])) for i in range(4)]
for thread in threads:
    thread.start()
for _ in range(20):
    end_displays()
    # Counted from the end on: of two more pictures the second is of a new context, so that no call loses two.
    before = list(drawn)
    while not wrong and any(a < b + 2 for a, b in zip(drawn, before)):
        stop.wait(0.01)
stop.set()
for thread in threads:
    thread.join()
assert not wrong, wrong[:3]
""",
        timeout=300,
    )
