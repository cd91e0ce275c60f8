"""Another library in the process that ends the EGL display, and the warnings that follow, for scripts of tests."""

import contextlib
import ctypes
import warnings

import cubecam as cc

DEVICE_PLATFORM, SURFACELESS = 0x313F, 0x31DD
EXTENSIONS, VERSION, TRACK_REFERENCES, NONE = 0x3055, 0x3054, 0x3352, 0x3038


def load_egl(name="libEGL.so.1"):
    """Return EGL with the types of the functions that the tests call."""
    egl = ctypes.CDLL(name)
    pointer, number = ctypes.c_void_p, ctypes.c_int
    for function, arguments in {
        "eglGetProcAddress": [ctypes.c_char_p],
        "eglGetPlatformDisplay": [ctypes.c_uint, pointer, pointer],
        "eglCreateContext": [pointer] * 4,
        "eglGetCurrentContext": [],
    }.items():
        getattr(egl, function).argtypes = arguments
        getattr(egl, function).restype = pointer
    egl.eglQueryString.argtypes = [pointer, number]
    egl.eglQueryString.restype = ctypes.c_char_p
    egl.eglInitialize.argtypes = [pointer] * 3
    egl.eglTerminate.argtypes = [pointer]
    egl.eglMakeCurrent.argtypes = [pointer] * 4
    egl.eglDestroyContext.argtypes = [pointer] * 2
    egl.eglBindAPI.argtypes = [ctypes.c_uint]
    egl.eglQueryAPI.restype = ctypes.c_uint
    egl.eglGetError.restype = number
    return egl


EGL = load_egl()


def displays(kind=None):
    """Return the displays of all devices and of the surfaceless platform; `kind` is a list of attributes."""
    query = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)(
        EGL.eglGetProcAddress(b"eglQueryDevicesEXT")
    )
    devices, count = (ctypes.c_void_p * 16)(), ctypes.c_int()
    assert query(16, devices, ctypes.byref(count))
    found = [EGL.eglGetPlatformDisplay(SURFACELESS, None, kind)]
    for device in devices[: count.value]:
        found.append(EGL.eglGetPlatformDisplay(DEVICE_PLATFORM, device, kind))
    return [display for display in found if display]


def end_displays():
    """Terminate every display that cubecam may use, as VTK does when a plot is closed.

    A display that counts its users ends when it was terminated as often as it was initialised.
    """
    for display in displays():
        EGL.eglTerminate(display)
    if b"EGL_KHR_display_reference" in EGL.eglQueryString(None, EXTENSIONS).split():
        for display in displays((ctypes.c_ssize_t * 3)(TRACK_REFERENCES, 1, NONE)):
            while EGL.eglQueryString(display, VERSION) is not None:
                EGL.eglTerminate(display)


@contextlib.contextmanager
def warned(times, match="the OpenGL context was lost"):
    """Expect so many RendererWarnings in this block, and no other warning; give the list of them."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield caught
    texts = [str(item.message) for item in caught]
    assert len(caught) == times, texts
    for item in caught:
        assert item.category is cc.RendererWarning, item
        assert match in str(item.message), texts


class EndsBeforeEachCall:
    """A renderer whose context another library ends before each call."""

    def __init__(self, renderer):
        self.renderer, self.calls = renderer, 0

    def __getattr__(self, name):
        method = getattr(self.renderer, name)

        def call(*args, **kwargs):
            end_displays()
            self.calls += 1
            return method(*args, **kwargs)

        return call
