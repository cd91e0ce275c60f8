"""Another library's EGL context, current on this thread, is left as it was found, also after an error."""

import pytest

from tests.helpers import run_python

EGL = '''
import ctypes, ctypes.util, sys
import numpy as np
import cubecam as cc

egl = ctypes.CDLL("libEGL.so.1")
for name in ("eglGetPlatformDisplay", "eglCreateContext", "eglGetCurrentContext", "eglGetCurrentDisplay",
             "eglGetProcAddress"):
    getattr(egl, name).restype = ctypes.c_void_p
P, I = ctypes.c_void_p, ctypes.c_int
egl.eglGetPlatformDisplay.argtypes = [ctypes.c_uint, P, P]
egl.eglInitialize.argtypes = [P, P, P]
egl.eglChooseConfig.argtypes = [P, P, P, I, P]
egl.eglCreateContext.argtypes = [P, P, P, P]
egl.eglMakeCurrent.argtypes = [P, P, P, P]
egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
SURFACELESS, OPENGL, ES, NONE = 0x31DD, 0x30A2, 0x30A0, 0x3038


def foreign(api):
    """A context of ours, current on this thread."""
    display = egl.eglGetPlatformDisplay(SURFACELESS, None, None)
    assert display and egl.eglInitialize(display, None, None)
    assert egl.eglBindAPI(api)
    config, count = P(), I()
    bit = 0x0008 if api == OPENGL else 0x0040  # EGL_OPENGL_BIT, EGL_OPENGL_ES3_BIT
    wanted = (I * 5)(0x3040, bit, 0x3033, 0, NONE)
    assert egl.eglChooseConfig(display, wanted, ctypes.byref(config), 1, ctypes.byref(count)) and count.value
    attributes = (I * 3)(0x3098, 3, NONE)
    context = egl.eglCreateContext(display, config, None, attributes)
    assert context
    assert egl.eglMakeCurrent(display, None, None, context)
    return display, context


def function(name, result, *arguments):
    return ctypes.CFUNCTYPE(result, *arguments)(egl.eglGetProcAddress(name))


def state():
    return egl.eglGetCurrentContext(), egl.eglGetCurrentDisplay(), egl.eglQueryAPI()


def work():
    scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 4, 4, 3), np.float32)))
    with cc.Renderer() as renderer:
        renderer.capture(scene, size=8)
        yield
        renderer.render(scene, cc.PerspectiveCamera(fov=50, position=(0, 0, 3), target=(0, 0, 0)), (8, 8))
        yield
        try:
            renderer.capture(scene, size=8, samples=100000)
        except ValueError:
            pass
        yield
    yield
    try:
        cc.Renderer(device="no such card")
    except (cc.ContextError, ValueError):
        pass
    yield
    cc.devices()
    yield
'''


@pytest.mark.parametrize("api", ["OPENGL", "ES"])
def test_a_foreign_context_stays_current_with_its_state(api):
    run_python(
        EGL
        + f"""
display, context = foreign({api})
clear = function(b"glClearColor", None, *[ctypes.c_float] * 4)
get = function(b"glGetFloatv", None, ctypes.c_uint, P)
clear(0.25, 0.5, 0.75, 1.0)
before = state()
for step in work():
    assert state() == before, (step, before, state())
    color = (ctypes.c_float * 4)()
    get(0x0C22, color)
    assert list(color) == [0.25, 0.5, 0.75, 1.0]
"""
    )


def test_none_of_ours_stays_current():
    run_python(
        EGL
        + """
renderer = cc.Renderer()
renderer.capture(cc.Scene(), size=4)
for step in work():
    assert not egl.eglGetCurrentContext()
"""
    )


def test_their_context_can_be_destroyed_and_ours_goes_on():
    """A closed renderer does not terminate the display that both contexts may share."""
    run_python(
        EGL
        + """
display, context = foreign(OPENGL)
renderer = cc.Renderer()
renderer.capture(cc.Scene(), size=4)
renderer.close()
version = function(b"glGetString", ctypes.c_char_p, ctypes.c_uint)
assert version(0x1F02)  # theirs still answers
egl.eglDestroyContext.argtypes = [P, P]
assert egl.eglMakeCurrent(display, None, None, None)
assert egl.eglDestroyContext(display, context)
cc.Renderer().capture(cc.Scene(), size=4)
"""
    )
