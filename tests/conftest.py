"""Fixtures: a session's renderer, a fresh one, the two drawing paths, fixed random numbers."""

import gc
import importlib.util
import os
import signal
import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

from tests.helpers import DEVICE, device, need_layers, on_llvmpipe, only_on_llvmpipe

#: Only `make test-browser` and `make test-torch` install what these tests need.
NEEDED = {"browser": "playwright", "torch": "torch"}
collect_ignore = [name for name, of in NEEDED.items() if importlib.util.find_spec(of) is None]

# nbformat imports jsonschema, which then compiles 38 grammars of addresses of the web: two seconds in each process of
# pytest. No format that these check is in a notebook. jsonschema does without this package where it is not installed.
sys.modules.setdefault("rfc3987_syntax", None)  # type: ignore[arg-type]

# Plots are drawn without a window, whatever the machine has.
os.environ.setdefault("MPLBACKEND", "agg")

# A shell starts what runs in its background with Ctrl-C ignored, and so would every process that a test starts.
if (
    signal.getsignal(signal.SIGINT) is signal.SIG_IGN
    and threading.current_thread() is threading.main_thread()
):
    signal.signal(signal.SIGINT, signal.default_int_handler)

# Every run uses the same examples, so that a failure can be repeated.
settings.register_profile("cubecam", derandomize=True, deadline=None, database=None)
settings.load_profile("cubecam")


def pytest_addoption(parser):
    parser.addoption(
        "--regenerate-references",
        action="store_true",
        help="write tests/images/*.png from the present pictures, and fail, so that someone looks at them",
    )


def pytest_sessionstart(session):
    module = os.environ.get("CUBECAM_EXPECT_MODULE")
    if module:  # scripts/sanitize.py
        from cubecam import _core

        if _core.__file__ != module:
            pytest.exit(f"CUBECAM_EXPECT_MODULE={module}, got {_core.__file__}", returncode=1)
    if os.environ.get("CUBECAM_EXPECT_SOFTWARE") == "1":
        text, llvmpipe = device()
        if not llvmpipe:
            pytest.exit(f"CUBECAM_EXPECT_SOFTWARE=1, expected llvmpipe, got {text}", returncode=1)


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """Leave what pytest keeps to the end, a million objects, out of the searches for garbage.

    Many tests call gc.collect(), and each such search would take half a second.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.collect()
        gc.freeze()


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Notebooks and files with slow tests are first, so that no process works on one while the others have ended."""
    slow = {item.path for item in items if item.get_closest_marker("slow")}
    items.sort(key=lambda item: (item.path.suffix != ".ipynb", item.path not in slow))


def pytest_sessionfinish(session, exitstatus):
    # At its end the interpreter frees everything; libraries with a count of their objects would report them as lost.
    gc.unfreeze()


def pytest_report_header(config):
    try:
        import cubecam
    except ImportError as error:
        return f"cubecam: not importable ({error})"
    place = Path(cubecam.__file__).parent
    return [
        f"cubecam {cubecam.__version__} at {place}, numpy {np.__version__}",
        f"device: {device()[0]}",
    ]


@pytest.fixture(autouse=True)
def skip_what_holds_on_llvmpipe_alone(request):
    marker = request.node.get_closest_marker("llvmpipe")
    if marker is not None and not on_llvmpipe():
        (reason,) = marker.args
        only_on_llvmpipe(reason)


@pytest.fixture
def rng():
    return np.random.default_rng(20240229)


@pytest.fixture(autouse=True)
def close_figures():
    """Close the figures that a test or an example leaves open: pyplot keeps them, and warns about many."""
    yield
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None:
        pyplot.close("all")


@pytest.fixture(scope="session")
def shared_renderers():
    """One renderer per path for the whole session, made when first needed."""
    import cubecam

    made = {}

    def get(layered):
        if layered not in made:
            made[layered] = cubecam.Renderer(device=DEVICE, layered=layered, debug=True)
        return made[layered]

    yield get
    for renderer in made.values():
        renderer.close()


@pytest.fixture
def renderer(shared_renderers):
    """The session's renderer on the path the device offers."""
    return shared_renderers(None)


@pytest.fixture(params=[None, False], ids=["layered", "one_pass"])
def any_path(request, shared_renderers):
    """The session's renderers of both paths, one after the other."""
    return shared_renderers(request.param)


@pytest.fixture
def fresh_renderer():
    """A renderer of the test's own, which has drawn nothing yet."""
    import cubecam

    with cubecam.Renderer(device=DEVICE) as made:
        yield made


@pytest.fixture
def new_renderer():
    """A function that makes renderers with options; all of them are closed at the end.

    With layered=True it skips the test on a device without layers.
    """
    import cubecam

    made = []

    def make(**options):
        if options.get("layered"):
            need_layers()
        made.append(cubecam.Renderer(**{"device": DEVICE, **options}))
        return made[-1]

    yield make
    for renderer in made:
        renderer.close()
