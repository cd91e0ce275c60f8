"""How much memory there is by the machine, control groups and limits of the process, and who asks before taking it.

The files of /proc and /sys/fs/cgroup are made by the tests, after proc(5), cgroups(7) and the documentation of
both versions of control groups.
"""

import numpy as np
import pytest

import cubecam as cc
from cubecam import _core
from tests.helpers import run_python

MIB = 1 << 20


@pytest.fixture
def machine(tmp_path):
    """A tree with proc/ and sys/: write(path, text)."""

    def write(path, text):
        file = tmp_path / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    write("proc/self/statm", "1000 500 100 10 0 400 0\n")
    write(
        "proc/meminfo",
        "MemTotal: 64000 kB\nMemFree: 1 kB\nMemAvailable: 48000 kB\nSwapTotal: 9000 kB\nSwapFree: 2000 kB\n",
    )
    return write


def left(tmp_path):
    return _core._memory_left(str(tmp_path))


def test_what_the_machine_has_free(machine, tmp_path):
    assert left(tmp_path) == (50_000 * 1024, "the free memory of this machine")


def test_the_second_version_of_control_groups(machine, tmp_path):
    """A group without a limit, "max", changes nothing; each group above counts; pages of files can be given back."""
    machine("proc/self/cgroup", "0::/outer/inner\n")
    group = "sys/fs/cgroup/outer"
    machine(f"{group}/inner/memory.max", "max\n")
    machine(f"{group}/inner/memory.current", "1000\n")
    assert left(tmp_path)[0] == 50_000 * 1024
    machine(f"{group}/memory.max", f"{30 * MIB}\n")
    machine(f"{group}/memory.current", f"{20 * MIB}\n")
    machine(f"{group}/memory.swap.max", "0\n")
    assert left(tmp_path) == (10 * MIB, "the control group's limit of 30 MiB")
    machine(f"{group}/memory.stat", f"anon 5\ninactive_file {3 * MIB}\nactive_file {1 * MIB}\n")
    assert left(tmp_path)[0] == 14 * MIB
    machine(f"{group}/memory.swap.max", f"{MIB}\n")
    machine(f"{group}/memory.swap.current", f"{MIB // 2}\n")
    assert left(tmp_path)[0] == 14.5 * MIB
    machine(f"{group}/inner/memory.max", f"{2 * MIB}\n")
    machine(f"{group}/inner/memory.current", f"{3 * MIB}\n")
    machine(f"{group}/inner/memory.swap.max", "0\n")
    assert left(tmp_path) == (0, "the control group's limit of 2 MiB")


def test_a_group_whose_path_the_container_does_not_see(machine, tmp_path):
    machine("proc/self/cgroup", "0::/docker/0123456789ab\n")
    machine("sys/fs/cgroup/memory.max", f"{8 * MIB}\n")
    machine("sys/fs/cgroup/memory.current", f"{MIB}\n")
    machine("sys/fs/cgroup/memory.swap.max", "0\n")
    assert left(tmp_path)[0] == 7 * MIB


def test_the_first_version_of_control_groups(machine, tmp_path):
    machine("proc/self/cgroup", "5:cpu,cpuacct:/job\n4:memory:/job\n1:name=systemd:/job\n")
    group = "sys/fs/cgroup/memory/job"
    machine(f"{group}/memory.usage_in_bytes", f"{5 * MIB}\n")
    machine(f"{group}/memory.limit_in_bytes", "9223372036854771712\n")
    assert left(tmp_path)[0] == 50_000 * 1024
    machine(f"{group}/memory.limit_in_bytes", f"{16 * MIB}\n")
    machine(f"{group}/memory.stat", f"cache 1\ntotal_inactive_file {MIB}\ntotal_active_file 0\n")
    assert left(tmp_path) == (12 * MIB, "the control group's limit of 16 MiB")


def test_without_proc_the_memory_of_the_machine_counts(tmp_path):
    bytes_left, limit = left(tmp_path)
    assert limit == "the memory of this machine"
    assert bytes_left > 100 * MIB


def test_this_machine_has_some():
    assert _core._memory_left()[0] > 50 * MIB


LIMITED = """
    import resource, numpy as np, cubecam as cc
    from cubecam import _core
    renderer = cc.Renderer()
    renderer.capture(cc.Scene(), size=8)

    def used():
        with open("/proc/self/statm") as file:
            pages = [int(word) for word in file.read().split()]
        return {used} * resource.getpagesize()

    def leave(mebibytes):
        for attempt in range(1000):  # until no thread of the driver takes or gives back memory meanwhile
            before = used()
            resource.setrlimit(resource.{name}, (before + (mebibytes << 20), resource.RLIM_INFINITY))
            left, limit = _core._memory_left()
            if used() == before:
                break
        assert limit == "{name}", (left, limit)
        assert abs(left - (mebibytes << 20)) < 1 << 20, (left, limit)

    def refused(error, call):
        try:
            call()
        except error as found:
            assert "MiB of memory ({name})" in str(found), found
        else:
            raise SystemExit("expected an error")
"""

#: glibc gives each thread that allocates an arena of its own, 64 or 128 MiB of address space. The driver's threads
#: have low priorities, so on a busy machine one of them may take its arena only after the limit was set.
ONE_ARENA = {"MALLOC_ARENA_MAX": 1}


@pytest.mark.parametrize(("name", "used"), [("RLIMIT_AS", "pages[0]"), ("RLIMIT_DATA", "pages[5]")])
def test_the_limits_of_the_process(name, used):
    """Targets of 1024 * 1024 texels, 6 faces, 20 bytes take 120 MiB, what is read 96 MiB more."""
    run_python(
        LIMITED.format(name=name, used=used)
        + """
    leave(180)
    refused(ValueError, lambda: renderer.capture(cc.Scene(), size=1024))
    refused(ValueError, lambda: renderer.render(cc.Scene(), cc.PerspectiveCamera(), (8192, 4096)))
    cube = cc.CubeMap(np.zeros((6, 4, 4, 1), np.float32))
    refused(ValueError, lambda: cube.resize(4096))
    refused(ValueError, lambda: cube.to_equirect(width=16384))
    refused(ValueError, lambda: cube.prefilter(2, 4096))
    refused(ValueError, lambda: cube.irradiance(4096))
    refused(ValueError, lambda: cc.CubeMap.from_sh(np.ones((1, 3)), size=4096))
    refused(ValueError, lambda: cc.Mesh.sphere(1, 4000, 1000))
    refused(ValueError, lambda: cc.Mesh.icosphere(1, 9))
    scene = cc.Scene()
    light = scene.add(cc.DirectionalLight(shadow=cc.Shadow(size=8192)))
    scene.add(cc.Mesh.box(1))
    refused(ValueError, lambda: renderer.shadow_map(scene, light))
    assert renderer.capture(cc.Scene(), size=8).size == 8
    """,
        timeout=120,
        **ONE_ARENA,
    )


def test_work_of_which_no_argument_says_the_size_is_a_memory_error():
    """The faces of this cube take 96 MiB; its cross takes twice as much, and what is between them as well."""
    run_python(
        LIMITED.format(name="RLIMIT_AS", used="pages[0]")
        + """
    cube = cc.CubeMap(np.zeros((6, 4096, 4096, 1), np.uint8))
    leave(60)
    refused(MemoryError, lambda: cube.to_layout("cross"))
    refused(MemoryError, lambda: cc.CubeMap(cube.faces))
    """,
        **ONE_ARENA,
    )


def test_results_are_counted_besides_the_target():
    """The target of 120 MiB alone would fit; with the faces that are read from it, it does not."""
    run_python(
        LIMITED.format(name="RLIMIT_AS", used="pages[0]")
        + """
    leave(150)
    refused(ValueError, lambda: renderer.capture(cc.Scene(), size=1024))
    resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    assert renderer.capture(cc.Scene(), size=1024).size == 1024
    """,
        **ONE_ARENA,
    )


def test_small_things_pass_without_a_look():
    _core._check_memory(0, "nothing")
    with pytest.raises(ValueError, match=r"^size: expected what fits into \d+ MiB of memory \("):
        _core._check_memory(2.0**60, "2 pixels")


def test_pictures_of_a_viewer_are_counted():
    from cubecam.viewer.cube_view import CubeView

    view = CubeView(cc.CubeMap([[[[0.5]]]] * 6), size=(8, 8))
    with pytest.raises(ValueError, match="MiB of memory"):
        view.draw((1 << 20, 1 << 20))
    with pytest.raises(ValueError, match=r"^size: expected a width and a height from 1 to 1048576"):
        view.size = (10**400, 1)


@pytest.mark.parametrize(
    "use",
    [
        lambda huge: cc.brdf(huge, 0.5),
        lambda huge: cc.reflect(huge, huge),
        lambda huge: cc.CubeMap(huge),
        lambda huge: cc.Image(huge),
        lambda huge: setattr(cc.StandardMaterial(), "normal_map", huge),
        lambda huge: cc.Mesh(huge, [[0, 1, 2]]),
    ],
)
def test_arrays_that_are_larger_than_their_memory(use):
    """An array of strides 0 has a million times a million numbers in 4 bytes."""
    huge = np.broadcast_to(np.float32(0), (6, 1 << 20, 1 << 20, 3))
    with pytest.raises(ValueError, match=r"MiB of memory|shape"):
        use(huge)
    with pytest.raises(ValueError, match="MiB of memory"):
        cc.CubeMap(huge)
