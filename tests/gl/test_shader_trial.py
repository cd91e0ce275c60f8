"""A user's GLSL is tried in a process of its own first: what ends the driver there raises ShaderError here.

The sources that end it were found with Mesa's llvmpipe (any version from 22.3 on), so these tests draw in software.
"""

import contextlib
import os
import shutil
import signal
import threading
import time
from pathlib import Path

import numpy as np
import psutil
import pytest

import cubecam as cc
from tests.gl.trials import (
    DEADLY,
    ENDLESS,
    LOOPS,
    OBVIOUS,
    RECORD,
    SLOW,
    draw,
    helpers,
    is_running,
    shade,
    wait_until,
)
from tests.helpers import need_no_sanitizer, run_python

PLAIN = "return vec3(0.25, 0.5, 1.0);"
COLOR = np.array([0.25, 0.5, 1, 1], np.float32)


@pytest.fixture(autouse=True)
def _own_limits():
    need_no_sanitizer("its memory counts in the limits of the helper")


@pytest.fixture
def software():
    with cc.Renderer(device="software") as renderer:
        yield renderer


def check_draws(renderer):
    np.testing.assert_array_equal(draw(renderer, shade(PLAIN)).color, np.tile(COLOR, (8, 8, 1)))


@pytest.mark.parametrize(("source", "words"), DEADLY.values(), ids=DEADLY)
def test_a_source_that_ends_the_driver(source, words, software, capfd):
    for _ in range(2):  # the second time from memory
        with pytest.raises(cc.ShaderError, match=f"^fragment: the driver .*{words}"):
            draw(software, source)
    check_draws(software)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("source", "words"), OBVIOUS.values(), ids=OBVIOUS)
def test_amounts_in_plain_sight_never_reach_a_driver(source, words, software):
    check_draws(software)
    (helper,) = helpers()
    with pytest.raises(
        cc.ShaderError, match=rf"^fragment does not compile:\nfragment:\d+: .*{words}"
    ):
        draw(software, source)
    assert helpers() == [helper]


@contextlib.contextmanager
def signals_to_busy_helpers(number):
    """Send a signal, again and again, to each helper that has worked for a while."""
    stop = threading.Event()

    def work():
        while not stop.wait(0.05):
            for process in helpers():
                with contextlib.suppress(psutil.Error, ProcessLookupError):
                    # One that starts has used a few hundredths of a second of CPU.
                    if psutil.Process(process).cpu_times().user > 0.5:
                        os.kill(process, number)

    thread = threading.Thread(target=work)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()


@pytest.mark.slow
@pytest.mark.parametrize("name", ENDLESS)
def test_a_source_that_takes_minutes(name, software):
    """The clock of the helper ends "cases"; "array" gets its signal sooner. Others may need too much memory first."""
    sooner: contextlib.AbstractContextManager[None] = contextlib.nullcontext()
    if name == "array":
        for (
            process
        ) in helpers():  # one that has worked for other tests would get the signal too soon
            os.kill(process, signal.SIGKILL)
        assert wait_until(lambda: helpers() == [])
        sooner = signals_to_busy_helpers(signal.SIGPROF)
    begin = time.process_time()
    with (
        sooner,
        pytest.raises(cc.ShaderError, match=r"10 seconds|1024 MiB|crashed") as caught,
    ):
        draw(software, ENDLESS[name])
    assert name not in ("array", "cases") or "10 seconds" in str(caught.value)
    assert time.process_time() - begin < 5  # the helper's time, not that of the user's process
    check_draws(software)


@pytest.mark.parametrize("source", LOOPS.values(), ids=LOOPS)
def test_loops_without_an_end_are_cut(source, software):
    assert draw(software, source).color.shape == (8, 8, 4)


def test_the_message_names_the_users_file(software, tmp_path):
    path = tmp_path / "water.glsl"
    path.write_text(DEADLY["division"][0] + "// of a file")
    with pytest.raises(cc.ShaderError, match=f"^{path}: the driver crashed"):
        draw(software, path)


def test_vertex_sources_and_effects_are_tried(software):
    vertex = "void vertex(inout Vertex v) { v.position.x += float((-2147483647 - 1) / -1); }"
    with pytest.raises(cc.ShaderError, match=r"^fragment and vertex: the driver crashed"):
        draw(software, shade(PLAIN), {"vertex": vertex})
    effect = cc.ImageEffect("vec4 effect(vec2 uv) { return vec4((-2147483647 - 1) / -1); }")
    with pytest.raises(cc.ShaderError, match=r"^fragment: the driver crashed"):
        draw(software, shade(PLAIN), effects=[effect])
    scene = cc.Scene()
    scene.add(cc.PointLight(position=(0, 5, 0), shadow=cc.Shadow(size=64)))
    scene.add(cc.Mesh.sphere(1), cc.ShaderMaterial(shade(PLAIN), vertex=vertex))
    with pytest.raises(cc.ShaderError, match="the driver crashed"):
        software.shadow_map(scene, scene.lights[0])


def test_errors_of_a_source_are_those_of_the_driver(software):
    with pytest.raises(cc.ShaderError, match=r"fragment:2.*error"):
        draw(software, shade("return vec3(nothing);"))


def test_trusted_sources_are_drawn_at_once(software):
    source = shade("return s.normal_object + vec3(s.uv, 0.0);")
    tried = draw(software, source).color
    before = set(helpers())
    with cc.Renderer(device="software", trust_shaders=True) as renderer:
        trusted = draw(renderer, source + "// trusted").color
    np.testing.assert_array_equal(tried, trusted)
    assert set(helpers()) == before


# What is tried, and what is known.

STATES = """
import os, sys
import numpy as np
import cubecam as cc
from tests.gl.trials import RECORD, draw, helpers, shade

verdicts = os.path.join(os.environ["XDG_CACHE_HOME"], "cubecam", "shader_verdicts")
count = lambda: os.path.getsize(verdicts) // RECORD if os.path.exists(verdicts) else 0
texture = lambda **options: cc.Image(np.ones((4, 4, 4), np.float32), **options)
renderer = cc.Renderer(device="software")
"""


def run_states(code, folder):
    return run_python(STATES + code, XDG_CACHE_HOME=folder, timeout=300)


def test_each_state_of_a_draw_call_is_tried_once(tmp_path):
    run_states(
        """
source = shade("return vec3(0.5);")
stencil = cc.Stencil(func="always", depth_pass="replace")
states = [
    ({}, {}),
    ({}, {"format": "rgba8"}),
    ({}, {"samples": 4}),
    ({}, {"outputs": ("id",)}),
    ({}, {"depth_format": "depth24_stencil8"}),
    ({"opacity": 0.5}, {}),
    ({"blend": "additive"}, {}),
    ({"depth_test": False}, {}),
    ({"depth_write": False}, {}),
    ({"color_write": (True, False, True, True)}, {}),
    ({"stencil": stencil}, {"depth_format": "depth24_stencil8"}),
]
for number, (material, options) in enumerate(states):
    draw(renderer, source, material, **options)
    assert count() == number + 1, (number, count())
known = count()
for material, options in states:
    draw(renderer, source, material, **options)
    draw(renderer, source, {**material, "uniforms": {}}, **options, exposure=0.0)
assert count() == known
""",
        tmp_path,
    )


def test_other_textures_and_meshes_are_tried(tmp_path):
    run_states(
        """
source = shade("return texture(map, s.uv).rgb + s.color.rgb;", "uniform sampler2D map;")
images = [
    texture(),
    texture(wrap="clamp"),
    texture(mag_filter="nearest"),
    texture(min_filter="linear_mipmap_linear"),
    cc.Image(np.ones((4, 4, 4), np.uint8)),
    cc.Image(np.ones((5, 4, 4), np.float32)),
    cc.Image(np.ones((4, 4, 1), np.float32)),
]
for number, image in enumerate(images):
    draw(renderer, source, {"textures": {"map": image}})
    assert count() == number + 1, (number, count())
draw(renderer, source, {"textures": {"map": cc.Image(np.zeros((8, 2, 4), np.float32))}})
assert count() == len(images)
""",
        tmp_path,
    )


@pytest.mark.llvmpipe("it measures what llvmpipe's cache of machine code saves")
def test_the_helpers_machine_code_is_that_of_the_program(tmp_path):
    """Mesa's disk cache hands it over, also after pictures in which vertex arrays changed."""
    run_states(
        """
import time
def seconds(renderer, number):
    begin = time.process_time()
    draw(renderer, shade(f"return vec3(s.uv, {number}.0 / 7.0);"))
    return time.process_time() - begin
trusting = cc.Renderer(device="software", trust_shaders=True)
tried = sorted(seconds(renderer, i) for i in range(9))[4]
trusted = sorted(seconds(trusting, i) for i in range(9))[4]
assert tried < 0.4 * trusted, (tried, trusted)
""",
        tmp_path,
    )


def test_programs_of_cubecam_are_not_tried(tmp_path):
    run_states(
        """
scene = cc.Scene(environment=cc.CubeMap(np.ones((6, 4, 4, 3), np.float32)))
scene.add(cc.PointLight(position=(0, 5, 0), shadow=cc.Shadow(size=64)))
for material in (cc.StandardMaterial(), cc.PhongMaterial(), cc.MirrorMaterial(), cc.GlassMaterial()):
    scene.add(cc.Mesh.sphere(1), material, position=(0, 0, -5))
renderer.capture(scene, size=8)
camera = cc.PerspectiveCamera(fov=60)
renderer.render(scene, camera, size=(8, 8), tonemap="aces", encode="srgb")
assert helpers() == [] and count() == 0
""",
        tmp_path,
    )


AGAIN = """
import sys
from tests.gl.trials import draw, helpers
import cubecam as cc
renderer = cc.Renderer(device="software")
for source, ends in (({deadly!r}, True), ({plain!r}, False)):
    try:
        draw(renderer, source)
    except cc.ShaderError as error:
        assert ends and "crashed (SIGFPE" in str(error), error
    else:
        assert not ends
print(len(helpers()))
"""


def test_verdicts_last_longer_than_the_process(tmp_path):
    code = AGAIN.format(deadly=DEADLY["division"][0], plain=shade(PLAIN))
    counts = [run_python(code, XDG_CACHE_HOME=tmp_path).stdout.strip() for _ in range(2)]
    assert counts == ["1", "0"]
    assert (tmp_path / "cubecam" / "shader_verdicts").stat().st_size == 2 * RECORD
    assert (tmp_path / "cubecam" / "shader_verdicts").stat().st_mode & 0o777 == 0o600


def spoil(path, how):
    data = path.read_bytes()
    if how == "noise":
        path.write_bytes(bytes(np.random.default_rng(1).integers(0, 256, 4096, np.uint8)))
    elif how == "cut":
        path.write_bytes(data[:-5])
    elif how == "changed":
        record = data[RECORD:]  # of the harmless source: now it crashes the driver
        path.write_bytes(data[:RECORD] + record[:24] + bytes([2]) + record[25:])
    elif how == "writable":
        path.chmod(0o666)  # somebody else may have written that a source is harmless
    elif how == "a pipe":
        path.unlink()
        os.mkfifo(path)
    else:
        path.unlink()
        path.symlink_to("/dev/zero")


@pytest.mark.parametrize("how", ["noise", "cut", "changed", "writable", "a pipe", "a link"])
def test_a_spoilt_file_of_verdicts(how, tmp_path):
    code = AGAIN.format(deadly=DEADLY["division"][0], plain=shade(PLAIN))
    run_python(code, XDG_CACHE_HOME=tmp_path)
    spoil(tmp_path / "cubecam" / "shader_verdicts", how)
    assert run_python(code, XDG_CACHE_HOME=tmp_path).stdout.strip() == "1"
    if how in ("noise", "cut", "changed"):  # the file is in order again
        assert run_python(code, XDG_CACHE_HOME=tmp_path).stdout.strip() == "0"


@pytest.mark.parametrize("folder", ["/proc/self", "/dev/null", "relative", ""])
def test_a_folder_that_cannot_be_written(folder):
    code = AGAIN.format(deadly=DEADLY["division"][0], plain=shade(PLAIN))
    off = {
        "MESA_SHADER_CACHE_DISABLE": "true",
        "MESA_GLSL_CACHE_DISABLE": "true",
    }  # it writes to relative folders
    assert run_python(code, XDG_CACHE_HOME=folder, HOME="/proc", **off).stdout.strip() == "1"
    assert not Path("relative").exists()


# The process.


def test_a_helper_that_was_killed_starts_again(software):
    check_draws(software)
    for process in helpers():
        os.kill(process, signal.SIGKILL)
    assert wait_until(lambda: helpers() == [])
    check_draws(software)
    assert len(helpers()) == 1


@pytest.mark.slow
def test_a_helper_that_is_killed_at_work(software):
    with (
        signals_to_busy_helpers(signal.SIGKILL),
        pytest.raises(cc.ShaderError, match="killed twice"),
    ):
        draw(software, SLOW)
    check_draws(software)


def without_helper(folder, script=None):
    """A package like ours, but for its helper."""
    package = folder / "cubecam"
    package.mkdir()
    for path in Path(cc.__file__).parent.iterdir():
        if path.name != "_shader_trial":
            (package / path.name).symlink_to(path)
    if script is not None:
        (package / "_shader_trial").write_text(script)
        (package / "_shader_trial").chmod(0o755)
    return folder


@pytest.mark.parametrize(
    ("script", "words"),
    [
        (None, "No such file"),
        ("#!/bin/sh\necho no such driver >&2\nexit 3\n", "ended at once: no such driver"),
        ("#!/nowhere\n", "No such file"),
        ("no program", "Exec format error|ended at once"),
    ],
    ids=["missing", "broken", "no interpreter", "text"],
)
def test_without_a_helper_there_is_one_warning(script, words, tmp_path):
    code = """
    import re, sys, warnings
    import cubecam as cc
    from tests.gl.trials import draw, shade
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for number in (0.25, 0.5):
            renderer = cc.Renderer(device="software")
            frame = draw(renderer, shade(f"return vec3({number});"))
            assert (frame.color[..., 0] == number).all()
    assert [w.category for w in caught] == [cc.RendererWarning], caught
    print(caught[0].message)
    """
    folder = without_helper(tmp_path, script)
    done = run_python(code, PYTHONPATH=f"{folder}{os.pathsep}{Path.cwd()}")
    assert "compiled in this process without a trial" in done.stdout
    assert any(word in done.stdout for word in words.split("|")), done.stdout


def test_a_helper_is_nobodys_child_and_has_a_session_of_its_own():
    run_python(
        """
        import os
        import cubecam as cc
        from tests.gl.trials import draw, helpers, shade
        draw(cc.Renderer(device="software"), shade("return vec3(1);"))
        (helper,) = helpers()
        assert os.getsid(helper) not in (os.getsid(0), os.getpid())
        try:
            os.wait()
        except ChildProcessError:
            pass
        else:
            raise AssertionError("expected no child")
        files = {os.readlink(f"/proc/{helper}/fd/{name}") for name in "012"}
        assert not any(name.startswith(("/dev/pts", "/dev/tty")) for name in files), files
        """
    )


@pytest.mark.parametrize("end", ["pass", "os._exit(0)", "os.kill(os.getpid(), 9)"])
def test_the_end_of_the_process_leaves_no_helper(end):
    done = run_python(
        f"""
        import os, sys
        import cubecam as cc
        from tests.gl.trials import draw, helpers, shade
        renderer = cc.Renderer(device="software")
        draw(renderer, shade("return vec3(1);"))
        print(*helpers(), flush=True)
        {end}
        """,
        check=False,
    )
    (helper,) = map(int, done.stdout.split())
    assert wait_until(lambda: not is_running(helper))


@pytest.mark.slow
def test_the_end_of_the_process_ends_a_helper_at_work():
    done = run_python(
        """
        import os, threading, time
        import cubecam as cc
        from tests.gl.trials import SLOW, draw, helpers
        def end():
            while not helpers():
                time.sleep(0.1)
            time.sleep(1)
            print(*helpers(), flush=True)
            os._exit(0)
        threading.Thread(target=end, daemon=True).start()
        draw(cc.Renderer(device="software"), SLOW)
        """
    )
    (helper,) = map(int, done.stdout.split())
    assert wait_until(lambda: not is_running(helper), seconds=5)


def test_a_forked_child_does_not_keep_the_helper():
    done = run_python(
        """
        import os, sys, time
        import cubecam as cc
        from tests.gl.trials import draw, helpers, is_running, shade, wait_until
        renderer = cc.Renderer(device="software")
        draw(renderer, shade("return vec3(1);"))
        (helper,) = helpers()
        read, write = os.pipe()
        if os.fork() == 0:  # it goes on when the parent has ended
            os.close(write)
            os.read(read, 1)
            print("ended" if wait_until(lambda: not is_running(helper)) else "left", flush=True)
            os._exit(0)
        os.close(read)
        os._exit(0)
        """
    )
    assert done.stdout == "ended\n"


def test_processes_of_a_pool_have_helpers_of_their_own():
    done = run_python(
        """
        import multiprocessing
        from tests.gl.trials import draw_plain
        if __name__ == "__main__":
            with multiprocessing.get_context("spawn").Pool(2) as pool:
                print(pool.map(draw_plain, [0.25, 0.5, 0.75]))
        """
    )
    assert done.stdout == "[0.25, 0.5, 0.75]\n"


def test_threads_share_a_helper():
    values = np.linspace(0, 1, 24)
    seen = np.zeros(len(values))

    def work(first):
        with cc.Renderer(device="software") as renderer:
            for i in range(first, len(values), 4):
                seen[i] = draw(renderer, shade(f"return vec3({values[i]:.9f});")).color[0, 0, 0]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    np.testing.assert_allclose(seen, values, atol=1e-6)
    assert len(helpers()) <= 2  # one for each size of stack


def test_a_thread_with_a_small_stack_gets_a_helper_with_a_smaller_one():
    """A sum that a thread of 16 MB can compile is refused for a thread that would crash with it."""
    done = run_python(
        """
        import threading
        import cubecam as cc
        from tests.gl.trials import LONG_SUM, draw
        def work(name):
            try:
                draw(cc.Renderer(device="software"), LONG_SUM)
                print(name, "drawn", flush=True)
            except cc.ShaderError as error:
                print(name, "refused", flush=True)
        for size in (512 << 10, 16 << 20):  # the other way round the driver's cache has it
            threading.stack_size(size)
            thread = threading.Thread(target=work, args=(size >> 10,))
            thread.start()
            thread.join()
        """
    )
    assert done.stdout == "512 refused\n16384 drawn\n"


@pytest.mark.slow
def test_ctrl_c_ends_a_trial():
    done = run_python(
        """
        import os, signal, threading, time
        import cubecam as cc
        from tests.gl.trials import SLOW, draw, helpers, is_running, shade, wait_until
        renderer = cc.Renderer(device="software")
        draw(renderer, shade("return vec3(1);"))
        (helper,) = helpers()
        sent = []
        def interrupt():
            time.sleep(1)
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
        threading.Thread(target=interrupt).start()
        try:
            draw(renderer, SLOW)
        except KeyboardInterrupt:
            print(time.monotonic() - sent[0])
        assert wait_until(lambda: not is_running(helper), 5)
        frame = draw(renderer, shade("return vec3(0.5);"))
        assert (frame.color[..., 0] == 0.5).all()
        """
    )
    # 0.1 seconds on an idle machine; the trial takes 10 seconds of CPU.
    assert float(done.stdout) < 5


def test_the_helper_is_in_the_package():
    assert shutil.which(Path(cc.__file__).parent / "_shader_trial")
