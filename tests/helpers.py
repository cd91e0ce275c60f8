"""Small things that many tests share."""

import contextlib
import copy
import functools
import importlib.util
import os
import pickle
import re
import subprocess
import sys
import textwrap
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.reference.cube_faces import CONVENTIONS, FACE_IDS, LAYOUTS

#: The device on which tests draw.
DEVICE = os.environ.get("CUBECAM_TEST_DEVICE", "software")

faces = pytest.mark.parametrize("face", range(6), ids=FACE_IDS)
conventions = pytest.mark.parametrize("convention", CONVENTIONS)
layouts = pytest.mark.parametrize("layout", LAYOUTS)
dtypes = pytest.mark.parametrize("dtype", ["uint8", "float16", "float32"])
channel_counts = pytest.mark.parametrize("channels", [1, 3, 4])
#: The two ways to make a copy: through bytes and by deepcopy.
copies = pytest.mark.parametrize(
    "make_copy",
    [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy],
    ids=["pickle", "deepcopy"],
)


def load_script(name: str) -> Any:
    """Import scripts/<name>.py, which is in no package, as a module of its own."""
    path = Path(__file__).resolve().parents[1] / "scripts" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@functools.cache
def device():
    """(The name of the device on which tests draw, whether it is llvmpipe); (the error, False) where there is none."""
    import cubecam

    try:
        with cubecam.Renderer(device=DEVICE) as renderer:
            info = renderer.info
            text = f"{info.renderer} ({info.vendor}), GL {info.version}, layered {info.layered}"
            return text, info.software and info.renderer.startswith("llvmpipe")
    except cubecam.ContextError as error:
        return f"none: {error}", False


@functools.cache
def draws_layers():
    """Whether the device draws all faces of a cubemap in one pass."""
    import cubecam

    with cubecam.Renderer(device=DEVICE) as renderer:
        return renderer.info.layered


def need_layers():
    """Skip the running test, which compares the layered path with another one, where there is none."""
    if not draws_layers():
        pytest.skip(f"{device()[0]} lacks GL_ARB_shader_viewport_layer_array")


def need_equal_pixels():
    """Skip the running test on zink above lavapipe.

    There a few pixels of surfaces that are drawn without a depth test, or blended, differ between two drawings: 2 of
    3,456 values of one picture, 132 of 6,912 of another one (Mesa 26.2). Why is not known.
    """
    if device()[0].startswith("zink") and "llvmpipe" in device()[0]:
        pytest.skip(
            f"{device()[0]} draws some blended pixels in two ways, for a reason that is not known"
        )


def need_own_memory():
    """Skip the running test, which measures the memory of the process, under a sanitizer, which keeps freed memory."""
    need_no_sanitizer("it keeps freed memory, and its own counts")


def least_cpu_seconds(call, enough, tries=5):
    """Call until it takes at most `enough` seconds of CPU time of all threads; return the least, and what it gave.

    It tells linear time from quadratic time. One measurement cannot: on a busy machine the same work takes twice as
    long, and the kernel may clear or move memory meanwhile.
    """
    least = float("inf")
    for _ in range(tries):
        begin = time.process_time()
        result = call()
        least = min(least, time.process_time() - begin)
        if least <= enough:
            break
    return least, result


def open_files(*kinds):
    """Return what open files of this process are, of those whose names begin so, such as "pipe:" or "socket:".

    All of them are not a measure: what earlier tests left to the garbage collector may open or close some meanwhile.
    """
    found = set()
    for file in Path("/proc/self/fd").iterdir():
        with contextlib.suppress(FileNotFoundError):  # the listing's own
            if (target := str(file.readlink())).startswith(kinds):
                found.add(target)
    return found


def need_no_sanitizer(reason):
    """Skip the running test in `make sanitize`."""
    if "CUBECAM_EXPECT_MODULE" in os.environ:
        pytest.skip(f"not under a sanitizer: {reason}")


def need_terminals():
    """Skip the running test, which shows something in a pseudo-terminal, on a system without them (a bare chroot)."""
    try:
        ends = os.openpty()
    except OSError as error:
        pytest.skip(f"no pseudo-terminal can be opened, /dev/pts may not be mounted: {error}")
    for end in ends:
        os.close(end)


def on_llvmpipe():
    """Whether the tests draw with llvmpipe by itself, for which this suite promises bytes."""
    return device()[1]


def only_on_llvmpipe(reason):
    """Skip the running test, whose assertion holds on llvmpipe alone."""
    pytest.skip(f"holds on llvmpipe alone ({reason}); this is {device()[0]}")


def run_python(code, timeout=120, check=True, **environment):
    """Run a script in an interpreter of its own; return the finished process with its output as text."""
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", textwrap.dedent(code)],
        env={**os.environ, **{key: str(value) for key, value in environment.items()}},
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )
    # Mesa prints the line for zink on a CPU, which needs LIBGL_ALWAYS_SOFTWARE.
    done.stderr = re.sub(
        r"^MESA-EGL: warning: Not allowed to force.*\n", "", done.stderr, flags=re.M
    )
    if check and done.returncode != 0:
        raise AssertionError(f"exit status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


def same_content(a, b):
    """Whether two cubemaps hold the same faces, bit for bit."""
    return a.dtype == b.dtype and np.array_equal(a.faces, b.faces)
