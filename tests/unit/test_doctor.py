"""The doctor's checks, each on a machine made in a folder: what is missing is found, with what mends it."""

import json
import sys
from pathlib import Path

import pytest

import cubecam as cc
from cubecam.doctor import installation
from cubecam.doctor.devices import check_devices, check_variables
from cubecam.doctor.drawing import Drawing, check_drawing, read_drawing
from cubecam.doctor.egl_library import check_egl_library
from cubecam.doctor.examination import all_findings
from cubecam.doctor.extras import EXTRAS, check_extras
from cubecam.doctor.findings import Finding
from cubecam.doctor.mesa import check_mesa
from cubecam.doctor.module import Installed, explain
from cubecam.doctor.nodes import check_nodes
from cubecam.doctor.nvidia import check_nvidia
from cubecam.doctor.process import UNAVAILABLE, check_cache, check_helper, check_limits
from cubecam.doctor.report import as_json, as_lines, verdict
from cubecam.doctor.surroundings import check_surroundings
from cubecam.doctor.system import Ran, System
from cubecam.doctor.vendors import check_vendors
from tests.fake_system import (
    ALPINE,
    ARCH,
    DEBIAN,
    DRAWN,
    FEDORA,
    LLVMPIPE,
    MESA,
    MESA_JSON,
    NOT_DRAWN,
    NVIDIA_JSON,
    ROCKY,
    UBUNTU,
    FakeSystem,
    write,
)

VENDORS = "/usr/share/glvnd/egl_vendor.d"
GPU = {
    **LLVMPIPE,
    "index": 1,
    "name": "AMD Radeon",
    "software": False,
    "drm_node": "/dev/dri/renderD128",
}
GPU_DRAWN = Drawing((LLVMPIPE, GPU), {**DRAWN.chosen, "renderer": "AMD Radeon", "software": False})


def machine(folder, files=None, release=DEBIAN, **more):
    write(folder, {"/etc/os-release": release, **(files or {})})
    return FakeSystem(root=folder, **more)


def only(findings):
    (found,) = findings
    return found


# The EGL library


@pytest.mark.parametrize(
    ("release", "command"),
    [
        (DEBIAN, "sudo apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri"),
        (UBUNTU, "sudo apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri"),
        (FEDORA, "sudo dnf install -y libglvnd-egl mesa-libEGL mesa-dri-drivers"),
        (ROCKY, "sudo dnf install -y libglvnd-egl mesa-libEGL mesa-dri-drivers"),
        (ARCH, "sudo pacman -S --needed --noconfirm libglvnd mesa"),
        (ALPINE, "sudo apk add mesa-egl mesa-dri-gallium"),
        ("ID=haiku\n", "# install libEGL.so.1"),
    ],
)
def test_no_egl_library(tmp_path, release, command):
    found = only(check_egl_library(machine(tmp_path, release=release, libraries=()), NOT_DRAWN))
    assert found.status == "problem"
    assert "libEGL.so.1: cannot open shared object file" in found.text
    assert found.cure[-1].startswith(command)


def test_root_needs_no_sudo(tmp_path):
    found = only(check_egl_library(machine(tmp_path, libraries=(), uid=0), NOT_DRAWN))
    assert found.cure == (
        "apt-get update",
        "apt-get install -y libegl1 libegl-mesa0 libgl1-mesa-dri",
    )


def test_a_container_without_sudo_needs_its_dockerfile(tmp_path):
    system = machine(tmp_path, {"/.dockerenv": ""}, libraries=())
    found = only(check_egl_library(system, NOT_DRAWN))
    packages = "libegl1 libegl-mesa0 libgl1-mesa-dri"
    assert found.cure[-1] == f"RUN apt-get update && apt-get install -y {packages}"
    write(tmp_path, {"/usr/bin/sudo": ""})
    found = only(check_egl_library(system, NOT_DRAWN))
    assert found.cure[-1] == f"sudo apt-get install -y {packages}"


def test_an_egl_library_that_the_loader_does_not_find(tmp_path):
    place = "/usr/lib/x86_64-linux-gnu/libEGL.so.1"
    found = only(check_egl_library(machine(tmp_path, {place: ""}, libraries=()), NOT_DRAWN))
    assert place in found.text
    assert found.cure[0] == "sudo ldconfig"
    assert f"export CUBECAM_EGL_LIBRARY={place}" in found.cure


def test_a_wrong_path_of_the_egl_library(tmp_path):
    environ = {"CUBECAM_EGL_LIBRARY": "/nowhere/libEGL.so"}
    found = only(check_egl_library(machine(tmp_path, environ=environ), NOT_DRAWN))
    assert (found.status, found.cure) == ("problem", ("unset CUBECAM_EGL_LIBRARY",))
    assert "/nowhere/libEGL.so" in found.text
    found = only(check_egl_library(machine(tmp_path, environ=environ, libraries=()), NOT_DRAWN))
    assert "apt-get install" in found.cure[-1]  # without the variable there is none either


def test_a_sound_egl_library(tmp_path):
    assert only(check_egl_library(machine(tmp_path), DRAWN)).status == "ok"
    chosen = machine(tmp_path, environ={"CUBECAM_EGL_LIBRARY": "libEGL.so.1"})
    assert only(check_egl_library(chosen, DRAWN)).status == "ok"


# Vendor files


def test_no_vendor_file(tmp_path):
    there = only(check_vendors(machine(tmp_path), NOT_DRAWN))
    assert there.cure[-1].endswith(f"| sudo tee {VENDORS}/50_mesa.json")  # the library is there
    without = machine(tmp_path, libraries=("libEGL.so.1", "libGLdispatch.so.0"))
    found = only(check_vendors(without, NOT_DRAWN))
    assert found.status == "problem"
    assert "/etc/glvnd/egl_vendor.d or /usr/share/glvnd/egl_vendor.d" in found.text
    assert "libegl-mesa0" in found.cure[-1]


def test_alpine_has_no_vendor_files(tmp_path):
    assert check_vendors(machine(tmp_path, release=ALPINE, libraries=("libEGL.so.1",)), DRAWN) == []


def test_a_vendor_file_without_its_library(tmp_path):
    files = {f"{VENDORS}/50_mesa.json": MESA_JSON}
    system = machine(tmp_path, files, libraries=("libEGL.so.1", "libGLdispatch.so.0"))
    found = only(check_vendors(system, NOT_DRAWN))
    assert found.status == "problem"
    assert "50_mesa.json names libEGL_mesa.so.0, which cannot be loaded" in found.text
    assert "libegl-mesa0" in found.cure[-1]


def test_one_sound_driver_makes_another_one_a_warning(tmp_path):
    files = {f"{VENDORS}/10_nvidia.json": NVIDIA_JSON, f"{VENDORS}/50_mesa.json": MESA_JSON}
    sound, broken = check_vendors(machine(tmp_path, files, release=UBUNTU), DRAWN)
    assert (sound.status, broken.status) == ("ok", "warning")
    assert "50_mesa.json (libEGL_mesa.so.0)" in sound.text
    assert "libEGL_nvidia.so.0" in broken.text


@pytest.mark.parametrize("text", ["", "{", "[]", '{"ICD": 3}'])
def test_a_vendor_file_that_cannot_be_read(tmp_path, text):
    files = {f"{VENDORS}/50_mesa.json": MESA_JSON, f"{VENDORS}/60_x.json": text}
    _, broken = check_vendors(machine(tmp_path, files), DRAWN)
    assert broken.status == "warning"
    assert "60_x.json: expected" in broken.text
    alone = only(check_vendors(machine(tmp_path / "b", {f"{VENDORS}/60_x.json": text}), NOT_DRAWN))
    assert alone.status == "problem"
    assert broken.cure == (f"sudo rm {VENDORS}/60_x.json",)


@pytest.mark.parametrize("kind", ["FILENAMES", "DIRS"])
def test_variables_that_name_no_vendor_file(tmp_path, kind):
    variable = f"__EGL_VENDOR_LIBRARY_{kind}"
    files = {f"{VENDORS}/50_mesa.json": MESA_JSON}
    system = machine(tmp_path, files, environ={variable: "/nowhere/a"})
    found = only(check_vendors(system, NOT_DRAWN))
    assert found.status == "problem"
    assert f"{variable}" in found.text
    assert "/nowhere/a" in found.text
    assert found.cure[0] == f"unset {variable}"
    assert "50_mesa.json" in found.cure[1]


def test_variables_that_name_vendor_files(tmp_path):
    own = write(tmp_path, {"/own/a.json": MESA_JSON})
    for environ in (
        {"__EGL_VENDOR_LIBRARY_FILENAMES": "/own/a.json"},
        {"__EGL_VENDOR_LIBRARY_DIRS": "/own"},
    ):
        found = only(check_vendors(machine(own, environ=environ), DRAWN))
        assert (found.status, "a.json" in found.text) == ("ok", True)


# Mesa's drivers


def test_mesa_without_drivers(tmp_path):
    files = {"/usr/lib/x86_64-linux-gnu/libEGL_mesa.so.0": ""}
    found = only(check_mesa(machine(tmp_path, files), NOT_DRAWN))
    assert found.status == "problem"
    assert "libgl1-mesa-dri" in found.cure[-1]
    assert check_mesa(machine(tmp_path, files), DRAWN) == []  # they lie elsewhere


@pytest.mark.parametrize("driver", ["dri/swrast_dri.so", "libgallium-25.0.7.so"])
def test_mesa_with_drivers(tmp_path, driver):
    lib = "/usr/lib/x86_64-linux-gnu"
    system = machine(tmp_path, {f"{lib}/libEGL_mesa.so.0": "", f"{lib}/{driver}": ""})
    assert only(check_mesa(system, DRAWN)).status == "ok"


def test_a_wrong_path_of_mesas_drivers(tmp_path):
    files = {"/usr/lib64/libEGL_mesa.so.0": "", "/usr/lib64/dri/swrast_dri.so": ""}
    system = machine(tmp_path, files, environ={"LIBGL_DRIVERS_PATH": "/nowhere"})
    found = only(check_mesa(system, NOT_DRAWN))
    assert (found.status, found.cure) == ("problem", ("unset LIBGL_DRIVERS_PATH",))
    assert only(check_mesa(system, DRAWN)).status == "warning"  # a Mesa that does not read it


# NVIDIA

SMI = {"nvidia-smi": Ran(0, "GPU 0: NVIDIA H100")}


@pytest.mark.parametrize(
    ("files", "programs"),
    [({"/dev/nvidia0": ""}, {}), ({}, SMI)],
    ids=["device file", "nvidia-smi"],
)
def test_nvidia_in_a_container_without_the_right_to_draw(tmp_path, files, programs):
    system = machine(
        tmp_path,
        {**files, "/.dockerenv": "", f"{VENDORS}/50_mesa.json": MESA_JSON},
        environ={"NVIDIA_DRIVER_CAPABILITIES": "compute,utility"},
        programs=programs,
    )
    found = only(check_nvidia(system, DRAWN))
    assert found.status == "warning"
    assert "NVIDIA_DRIVER_CAPABILITIES=compute,utility lacks graphics" in found.text
    assert "docker run --gpus all -e NVIDIA_DRIVER_CAPABILITIES=all IMAGE" in found.cure


def test_nvidia_in_a_container_that_says_nothing_of_rights(tmp_path):
    system = machine(tmp_path, {"/dev/nvidia0": "", "/.dockerenv": ""})
    found = only(check_nvidia(system, DRAWN))
    assert "NVIDIA_DRIVER_CAPABILITIES is not set" in found.text
    assert "docker run --gpus all -e NVIDIA_DRIVER_CAPABILITIES=all IMAGE" in found.cure


@pytest.mark.parametrize("value", ["all", "compute, graphics"])
def test_nvidia_in_a_container_of_a_host_without_egl(tmp_path, value):
    """The container has the right to draw: no other start of it helps."""
    system = machine(
        tmp_path,
        {"/dev/nvidia0": "", "/.dockerenv": ""},
        environ={"NVIDIA_DRIVER_CAPABILITIES": value},
    )
    found = only(check_nvidia(system, DRAWN))
    assert "lacks" not in found.text
    assert "on the host" in found.cure[0]
    assert not any("docker run" in line for line in found.cure)


def test_nvidia_in_wsl(tmp_path):
    """The driver is that of Windows: NVIDIA's packages for Linux would break it."""
    files = {
        "/proc/version": "Linux version 5.15.1-microsoft-standard-WSL2",
        f"{VENDORS}/50_mesa.json": MESA_JSON,
    }
    assert check_nvidia(machine(tmp_path, files, release=UBUNTU, programs=SMI), DRAWN) == []


@pytest.mark.parametrize("branch", ["570", "570-server"])
def test_nvidia_packages_of_the_installed_kind(tmp_path, branch):
    installed = f"/var/lib/dpkg/info/libnvidia-compute-{branch}:amd64.list"
    found = only(
        check_nvidia(machine(tmp_path, {"/dev/nvidia0": "", installed: ""}, release=UBUNTU), DRAWN)
    )
    assert found.cure[-1] == f"sudo apt-get install -y libnvidia-gl-{branch}"


@pytest.mark.parametrize(
    ("release", "source"), [(FEDORA, "RPM Fusion"), (DEBIAN, "non-free"), (ARCH, "")]
)
def test_where_nvidias_packages_are(tmp_path, release, source):
    found = only(check_nvidia(machine(tmp_path, {"/dev/nvidia0": ""}, release=release), DRAWN))
    told = [line for line in found.cure if line.startswith("#")]
    assert source in only(told) if source else not told


def test_nvidia_for_computing_only(tmp_path):
    version = "NVRM version: NVIDIA UNIX x86_64 Kernel Module  570.86.15  Fri Jan 24\n"
    files = {"/dev/nvidia0": "", "/proc/driver/nvidia/version": version}
    found = only(check_nvidia(machine(tmp_path, files, release=UBUNTU), DRAWN))
    assert found.cure[-1] == "sudo apt-get install -y libnvidia-gl-570"
    open_module = version.replace("Kernel Module ", "Open Kernel Module for x86_64 ")
    write(tmp_path, {"/proc/driver/nvidia/version": open_module})
    found = only(
        check_nvidia(
            machine(tmp_path, files | {"/proc/driver/nvidia/version": open_module}, release=UBUNTU),
            DRAWN,
        )
    )
    assert found.cure[-1] == "sudo apt-get install -y libnvidia-gl-570"
    assert only(check_nvidia(machine(tmp_path, files), DRAWN)).cure[-1].endswith("nvidia-egl-icd")


def test_nvidia_without_its_vendor_file(tmp_path):
    system = machine(tmp_path, {"/dev/nvidia0": ""}, libraries=(*MESA, "libEGL_nvidia.so.0"))
    found = only(check_nvidia(system, DRAWN))
    line = found.cure[-1]
    assert line.endswith(f"| sudo tee {VENDORS}/10_nvidia.json")
    text = line.partition("'")[2].partition("'")[0]
    assert json.loads(text)["ICD"]["library_path"] == "libEGL_nvidia.so.0"


def test_nvidia_left_out_by_a_variable(tmp_path):
    files = {"/dev/nvidia0": "", f"{VENDORS}/50_mesa.json": MESA_JSON}
    environ = {"__EGL_VENDOR_LIBRARY_FILENAMES": f"{VENDORS}/50_mesa.json"}
    found = only(check_nvidia(machine(tmp_path, files, environ=environ), DRAWN))
    assert (found.status, found.cure) == ("warning", ("unset __EGL_VENDOR_LIBRARY_FILENAMES",))


def test_nvidia_that_is_sound_or_absent(tmp_path):
    assert check_nvidia(machine(tmp_path), DRAWN) == []
    files = {"/dev/nvidia0": "", f"{VENDORS}/10_nvidia.json": NVIDIA_JSON}
    assert only(check_nvidia(machine(tmp_path, files), DRAWN)).status == "ok"


def test_nvidia_after_an_update(tmp_path):
    told = Ran(18, "Failed to initialize NVML: Driver/library version mismatch\n")
    found = only(check_nvidia(machine(tmp_path, programs={"nvidia-smi": told}), DRAWN))
    assert "different versions" in found.text
    assert "restart" in found.cure[0]


# /dev/dri

NODE = "/dev/dri/renderD128"


def with_node(tmp_path, group="render:x:992:", number=992, files=None, **more):
    files = {NODE: "", "/etc/group": f"root:x:0:\n{group}\n", **(files or {})}
    return machine(tmp_path, files, closed=(NODE,), owners={NODE: number}, **more)


def test_no_right_to_the_gpu(tmp_path):
    found = only(check_nodes(with_node(tmp_path), DRAWN))
    assert found.status == "warning"
    assert "it belongs to the group render (992)" in found.text
    assert found.cure[0] == "sudo usermod -aG render alice"


def test_no_right_to_the_gpu_in_a_container(tmp_path):
    system = with_node(tmp_path, "", 104, {"/run/.containerenv": ""})
    found = only(check_nodes(system, DRAWN))
    assert "docker run --device /dev/dri --group-add 104 IMAGE" in found.cure


def test_a_user_without_a_name_is_that_of_a_container(tmp_path):
    found = only(check_nodes(with_node(tmp_path, name=""), DRAWN))
    assert "docker run --device /dev/dri --group-add 992 IMAGE" in found.cure
    assert "joined" not in found.text


def test_a_group_that_the_session_does_not_have_yet(tmp_path):
    found = only(check_nodes(with_node(tmp_path, "render:x:992:bob,alice"), DRAWN))
    assert "joined after this session began" in found.text
    assert found.cure[1] == "newgrp render"


def test_a_node_of_root_alone(tmp_path):
    found = only(check_nodes(with_node(tmp_path, "", 0), DRAWN))
    assert found.cure[0].startswith(f"sudo chmod 666 {NODE}")


def test_a_node_that_can_be_opened(tmp_path):
    assert only(check_nodes(machine(tmp_path, {NODE: ""}), DRAWN)).status == "ok"
    assert check_nodes(machine(tmp_path / "none"), DRAWN) == []


def card(vendor, kind="0x030000"):
    folder = "/sys/bus/pci/devices/0000:03:00.0"
    return {f"{folder}/class": f"{kind}\n", f"{folder}/vendor": f"{vendor}\n"}


@pytest.mark.parametrize(
    ("vendor", "sign", "words"),
    [
        ("0x1002", {"/.dockerenv": ""}, "docker run --device /dev/dri IMAGE"),
        ("0x10de", {"/.dockerenv": ""}, "--gpus all -e NVIDIA_DRIVER_CAPABILITIES=all"),
        ("0x1002", {}, "dmesg"),
    ],
)
def test_a_gpu_without_a_node(tmp_path, vendor, sign, words):
    found = only(check_nodes(machine(tmp_path, {**card(vendor), **sign}), DRAWN))
    assert found.status == "note"
    assert words in " ".join(found.cure)


@pytest.mark.parametrize(("vendor", "kind"), [("0x1a03", "0x030000"), ("0x10de", "0x040300")])
def test_what_is_no_gpu(tmp_path, vendor, kind):
    """The picture of a server's maintenance console, and the sound of a graphics card."""
    assert check_nodes(machine(tmp_path, card(vendor, kind)), DRAWN) == []


# Containers and WSL


@pytest.mark.parametrize(
    ("files", "environ"),
    [
        ({"/.dockerenv": ""}, {}),
        ({"/run/.containerenv": ""}, {}),
        ({"/proc/1/cgroup": "0::/kubepods/burstable/pod1\n"}, {}),
        ({}, {"container": "podman"}),
    ],
)
def test_containers(tmp_path, files, environ):
    text = only(check_surroundings(machine(tmp_path, files, environ=environ))).text
    assert "in a container" in text
    assert "Debian GNU/Linux 13 (trixie)" in text


def test_no_container(tmp_path):
    text = only(check_surroundings(machine(tmp_path, {"/proc/1/cgroup": "0::/init.scope\n"}))).text
    assert "container" not in text


def test_wsl(tmp_path):
    files = {"/proc/version": "Linux version 5.15.1-microsoft-standard-WSL2"}
    assert "wsl --update" in check_surroundings(machine(tmp_path, files))[1].cure[0]
    found = check_surroundings(machine(tmp_path, {**files, "/dev/dxg": ""}))[1]
    assert "export LIBGL_ALWAYS_SOFTWARE=1" in found.cure
    assert any("GALLIUM_DRIVER=d3d12" in line for line in found.cure)
    container = check_surroundings(machine(tmp_path / "other", {**files, "/.dockerenv": ""}))[1]
    assert any("docker run --device /dev/dxg" in line for line in container.cure)
    assert not any("wsl --" in line for line in container.cure)


# Devices and variables


def test_a_gpu_that_does_not_start(tmp_path):
    broken = {**GPU, "problem": "eglInitialize: EGL_NOT_INITIALIZED"}
    drawing = Drawing((LLVMPIPE, broken), DRAWN.chosen)
    found = only(check_devices(machine(tmp_path), drawing, None))
    assert found.status == "warning"
    assert "device 1 (AMD Radeon)" in found.text
    assert "EGL_NOT_INITIALIZED" in found.text
    assert "cubecam doctor --device gpu" in found.cure
    assert (
        len(only(check_devices(machine(tmp_path), drawing, "gpu")).cure) == 1
    )  # just that was asked


@pytest.mark.parametrize(
    ("environ", "device", "reason", "status"),
    [
        ({}, None, "software", "warning"),
        ({"LIBGL_ALWAYS_SOFTWARE": "1"}, None, "as LIBGL_ALWAYS_SOFTWARE says", "note"),
        ({"CUBECAM_DEVICE": "software"}, None, "as CUBECAM_DEVICE=software says", "note"),
        ({"GALLIUM_DRIVER": "llvmpipe"}, None, "as GALLIUM_DRIVER says", "note"),
        ({}, "software", "as --device software says", "note"),
    ],
)
def test_a_gpu_that_was_passed_over(tmp_path, environ, device, reason, status):
    drawing = Drawing((LLVMPIPE, GPU), DRAWN.chosen)
    found = only(check_devices(machine(tmp_path, environ=environ), drawing, device))
    assert found.status == status
    assert reason in found.text


def test_several_gpus_that_were_passed_over(tmp_path):
    drawing = Drawing((LLVMPIPE, GPU, {**GPU, "index": 2}), DRAWN.chosen)
    text = only(check_devices(machine(tmp_path), drawing, None)).text
    assert "device 1 (AMD Radeon), device 2 (AMD Radeon) are GPUs that can be used" in text


def test_gpus_that_are_used(tmp_path):
    assert only(check_devices(machine(tmp_path), GPU_DRAWN, None)).status == "ok"
    assert "no GPU" in only(check_devices(machine(tmp_path), DRAWN, None)).text
    assert check_devices(machine(tmp_path), NOT_DRAWN, None) == []


@pytest.mark.parametrize(
    "name",
    [
        "LIBGL_ALWAYS_SOFTWARE",
        "GALLIUM_DRIVER",
        "MESA_LOADER_DRIVER_OVERRIDE",
        "MESA_GL_VERSION_OVERRIDE",
        "EGL_PLATFORM",
    ],
)
def test_variables(tmp_path, name):
    system = machine(tmp_path, environ={name: "x"})
    found = only(check_variables(system, DRAWN, None))
    assert (found.status, found.cure) == ("note", (f"unset {name}",))
    error = Drawing(error=f"ContextError: {name}=x is set: without it another driver may start.")
    assert only(check_variables(system, error, None)).status == "problem"
    assert check_variables(machine(tmp_path, environ={name: "0"}), DRAWN, None) == []


def test_a_variable_that_wsl_needs(tmp_path):
    """What the doctor advises in WSL is not to be undone, unless nothing is drawn with it."""
    files = {"/proc/version": "Linux version 5.15.1-microsoft-standard-WSL2"}
    system = machine(tmp_path, files, environ={"GALLIUM_DRIVER": "d3d12"})
    assert only(check_variables(system, DRAWN, None)).cure == ()
    assert only(check_variables(system, NOT_DRAWN, None)).cure == ("unset GALLIUM_DRIVER",)
    elsewhere = machine(tmp_path / "other", environ={"GALLIUM_DRIVER": "d3d12"})
    assert only(check_variables(elsewhere, DRAWN, None)).cure == ("unset GALLIUM_DRIVER",)


def test_a_device_that_a_variable_names(tmp_path):
    system = machine(tmp_path, environ={"CUBECAM_DEVICE": "gpu"})
    error = Drawing(error='ContextError: no device "gpu" (from CUBECAM_DEVICE)')
    found = only(check_variables(system, error, None))
    assert (found.status, found.cure) == ("problem", ("unset CUBECAM_DEVICE",))
    assert only(check_variables(system, DRAWN, None)).status == "note"
    assert check_variables(system, DRAWN, "software") == []


# Drawing


def told(*lines, code=0, err=""):
    return Ran(code, "\n".join(json.dumps(line) for line in lines), err)


def test_a_picture_was_drawn(tmp_path):
    drawing = read_drawing(
        told({"devices": [LLVMPIPE]}, {"chosen": DRAWN.chosen, "index": 0}, {"warnings": []})
    )
    assert drawing.works
    found = only(check_drawing(machine(tmp_path), drawing, None))
    assert found.status == "ok"
    assert "llvmpipe (software), OpenGL 4.5" in found.text


def test_lines_of_a_driver_are_left_out():
    ran = told({"devices": []}, {"warnings": []})
    assert read_drawing(Ran(0, f"MESA: warning\n{ran.out}\n[1]\n")).works


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (-11, "was ended by SIGSEGV while starting the driver"),
        (None, "gave no answer within 90 s while starting the driver"),
    ],
)
def test_a_driver_that_crashes_or_hangs(tmp_path, code, words):
    steps = told({"step": "listing the devices"}, {"step": "starting the driver"}).out
    drawing = read_drawing(Ran(code, steps, late=code is None))
    assert drawing.crashed
    files = {f"{VENDORS}/10_nvidia.json": NVIDIA_JSON, f"{VENDORS}/50_mesa.json": MESA_JSON}
    found = only(check_drawing(machine(tmp_path, files), drawing, None))
    assert found.status == "problem"
    assert words in found.text
    assert f"export __EGL_VENDOR_LIBRARY_FILENAMES={VENDORS}/50_mesa.json" in found.cure


def test_an_error_without_its_advice(tmp_path):
    error = "ContextError: no context:\n  1. device 0: no\nTo render in software install Mesa"
    drawing = Drawing((LLVMPIPE,), error=error)
    found = only(check_drawing(machine(tmp_path), drawing, "gpu"))
    assert found.text == "no picture was drawn: ContextError: no context:\n  1. device 0: no"
    assert found.cure == ("# these devices are there: 0: llvmpipe", "cubecam doctor --device auto")


def test_a_process_that_cannot_be_started(tmp_path):
    """No driver is blamed for what the system refuses."""
    drawing = read_drawing(Ran(None, "", "[Errno 11] Resource temporarily unavailable"))
    assert not drawing.crashed
    found = only(check_drawing(machine(tmp_path), drawing, None))
    assert found.text == (
        "no picture was drawn: the process could not be started: [Errno 11] Resource temporarily unavailable"
    )
    assert found.cure == ()


def test_an_error_of_the_interpreter():
    drawing = read_drawing(Ran(1, "", "Traceback\nImportError: no numpy\n"))
    assert (
        drawing.error
        == "the process ended with status 1 while importing cubecam: ImportError: no numpy"
    )


# The installation


def installed(folder, **more):
    package = folder / "site-packages" / "cubecam"
    package.mkdir(parents=True, exist_ok=True)
    suffixes = (".cpython-311-x86_64-linux-gnu.so", ".abi3.so", ".so")
    return Installed(package, "/usr/bin/python3", suffixes, "linux", **more)


def module_finding(tmp_path, error, name="_core.cpython-311-x86_64-linux-gnu.so", **environ):
    package = installed(tmp_path)
    if name:
        (package.folder / name).touch()
    return explain(machine(tmp_path, environ=environ), package, error)


def test_no_compiled_module(tmp_path):
    found = module_finding(tmp_path, "no module", name=None)
    assert found.status == "problem"
    assert "has no compiled module (_core*.so)" in found.text
    assert found.cure == (
        "/usr/bin/python3 -m pip install --force-reinstall --no-cache-dir cubecam",
    )


def test_a_checkout_that_is_not_built(tmp_path):
    package = Installed(tmp_path / "python" / "cubecam")
    package.folder.mkdir(parents=True)
    write(tmp_path, {"/pyproject.toml": "", "/cpp/CMakeLists.txt": ""})
    assert explain(machine(tmp_path), package, "").cure == (f"make -C {tmp_path} dev",)


@pytest.mark.parametrize(
    "name", ["_core.cpython-313-x86_64-linux-gnu.so", "_core.cpython-311-aarch64-linux-gnu.so"]
)
def test_a_module_for_another_python_or_processor(tmp_path, name):
    found = module_finding(tmp_path, "no module", name=name)
    assert f"expected _core.cpython-311-x86_64-linux-gnu.so, got {name}" in found.text
    assert "--force-reinstall" in found.cure[0]


@pytest.mark.parametrize(
    ("error", "environ", "words"),
    [
        ("libc.so.6: version `GLIBC_2.38' not found", {}, "GLIBC_2.38 or newer is needed"),
        ("libstdc++.so.6: version `GLIBCXX_3.4.32' not found", {}, "--no-binary"),
        (
            "libstdc++.so.6: version `GLIBCXX_3.4.32' not found",
            {"LD_LIBRARY_PATH": "/opt/old"},
            "unset LD_LIBRARY_PATH  # is /opt/old",
        ),
        (
            "libstdc++.so.6: version `CXXABI_1.3.15' not found",
            {"CONDA_PREFIX": "/opt/conda"},
            "conda install",
        ),
        ("Error loading shared library ld-linux-x86-64.so.2", {}, "python:3.12-slim"),
        ("libstdc++.so.6: cannot open shared object file", {}, "apt-get install -y libstdc++6"),
        ("failed to map segment from shared object", {}, "findmnt -T"),
        ("invalid ELF header", {}, "--force-reinstall"),
    ],
)
def test_a_module_that_the_loader_refuses(tmp_path, error, environ, words):
    found = module_finding(tmp_path, error, **environ)
    assert error in found.text
    assert words in "\n".join(found.cure)


def test_not_linux(tmp_path):
    package = Installed(tmp_path, platform="darwin")
    found = explain(machine(tmp_path), package, "")
    assert "runs on Linux, and this is darwin" in found.text


def test_a_second_package(tmp_path):
    for name in ("a", "b"):
        write(tmp_path, {f"/{name}/cubecam/__init__.py": ""})
    paths = [str(tmp_path / name) for name in ("a", "b", "none")]
    found = only(installation.check_copies(paths, (tmp_path / "a" / "cubecam").resolve()))
    assert found.status == "warning"
    assert str(tmp_path / "b" / "cubecam") in found.text
    assert installation.check_copies(paths[:1], (tmp_path / "a" / "cubecam").resolve()) == []


def test_a_link_to_the_package_is_no_second_one(tmp_path):
    write(tmp_path, {"/a/cubecam/__init__.py": ""})
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "cubecam").symlink_to(tmp_path / "a" / "cubecam")
    unreadable = "/" + 5000 * "x"  # no file may have such a name
    paths = [str(tmp_path / "a"), str(tmp_path / "b"), unreadable]
    assert installation.check_copies(paths, (tmp_path / "a" / "cubecam").resolve()) == []


def test_a_command_of_another_python(tmp_path):
    script = tmp_path / "cubecam"
    script.write_text("#!/opt/other/bin/python3\nimport cubecam\n")
    found = only(installation.check_script(str(script)))
    assert "/opt/other/bin/python3" in found.text
    script.write_text(f"#!{sys.prefix}/bin/python\n")
    assert installation.check_script(str(script)) == []
    (tmp_path / "bin").symlink_to(Path(sys.prefix) / "bin")
    script.write_text(f"#!{tmp_path}/bin/python\n")
    assert installation.check_script(str(script)) == []
    script.write_text("#!/bin/sh\n")
    assert installation.check_script(str(script)) == []
    assert installation.check_script(None) == []


def test_requirements():
    wrong = only(
        installation.check_requirements(["numpy>=1.24", "no-such-package>=2", "x; extra == 'a'"])
    )
    assert wrong.status == "problem"
    assert "no-such-package is missing" in wrong.text
    assert wrong.cure[0].endswith('-m pip install "no-such-package>=2"')
    old = only(installation.check_requirements(["numpy>=999.1"]))
    assert old.status == "warning"
    assert "expected 999.1 or newer, got" in old.text
    assert only(installation.check_requirements(["numpy>=1.24"])).status == "ok"


def test_versions_of_requirements(monkeypatch):
    """Two numbers are three with a zero; what a broken update left behind has none."""
    monkeypatch.setattr("importlib.metadata.version", {"a": "2", "b": None}.get)
    assert only(installation.check_requirements(["a>=2.0"])).status == "ok"
    assert only(installation.check_requirements(["a>=2.0.1"])).status == "warning"
    assert "b is missing" in only(installation.check_requirements(["b>=1"])).text


def test_extras_are_those_of_the_project():
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text()
    section = text.partition("[project.optional-dependencies]")[2].partition("\n[tool.")[0]
    declared = {
        line.partition(" = ")[0]
        for line in section.splitlines()
        if " = [" in line and line[0].isalpha()
    }
    of_developers = {
        "test", "browser", "light", "bench", "peers", "docs", "lowest", "dev", "packages", "conda", "torch", "deploy",
    }  # fmt: skip
    assert declared - of_developers == set(EXTRAS)
    assert {finding.status for finding in check_extras()} <= {"ok", "note"}


def test_an_extra_that_is_missing(monkeypatch):
    monkeypatch.setitem(EXTRAS, "plot", ("cc.plot", ("no_such_module", "numpy")))
    (found,) = [finding for finding in check_extras() if finding.cure]
    assert found.status == "note"
    assert 'pip install "cubecam[plot]"  # cc.plot (no_such_module)' in found.cure


def test_a_module_without_a_specification_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", type(sys)("matplotlib"))
    assert any('"cubecam[plot]"' in line for found in check_extras() for line in found.cure)


# The process


def test_the_helper(tmp_path):
    assert only(check_helper(DRAWN, tmp_path)).status == "warning"  # none
    helper = tmp_path / "_shader_trial"
    helper.touch(0o644)
    found = only(check_helper(DRAWN, tmp_path))
    assert (found.status, found.cure) == ("warning", (f"chmod +x {helper}",))
    helper.chmod(0o755)
    assert only(check_helper(DRAWN, tmp_path)).status == "ok"
    warned = Drawing(
        (LLVMPIPE,), DRAWN.chosen, (f"new GLSL..., since {UNAVAILABLE}: no memory. A source with",)
    )
    found = only(check_helper(warned, tmp_path))
    assert found.status == "warning"
    assert found.text.endswith("cannot be started: no memory")


def test_the_words_of_the_notice_are_those_of_the_core():
    source = Path(__file__).parents[2] / "cpp" / "cubecam" / "trial" / "trial.cpp"
    joined = source.read_text().replace('"\n               "', "")
    assert f"{UNAVAILABLE}: " in joined
    assert '". A source' in joined


def test_little_memory(tmp_path):
    files = {"/proc/meminfo": "MemAvailable: 100000 kB\nSwapFree: 0 kB\n"}
    found = check_limits(machine(tmp_path, files))[0]
    assert (found.status, "97 MiB" in found.text) == ("warning", True)
    group = {
        "/proc/self/cgroup": "0::/\n",
        "/sys/fs/cgroup/memory.max": "99000000\n",
        "/sys/fs/cgroup/memory.current": "1000\n",
    }
    plenty = {"/proc/meminfo": "MemAvailable: 9000000 kB\n"}
    found = check_limits(machine(tmp_path, {**plenty, **group}))[0]
    assert "docker run --memory 4g IMAGE" in found.cure
    assert check_limits(machine(tmp_path / "b", plenty))[0].status == "ok"


def test_the_cache(tmp_path):
    home = write(tmp_path, {"/home/a/x": "", "/file": ""})
    assert only(check_cache(machine(home, environ={"HOME": "/home/a"}))).status == "ok"
    assert "HOME" in only(check_cache(machine(home))).text
    for environ in ({"HOME": "/home/a"}, {"HOME": "/home/a", "XDG_CACHE_HOME": "relative"}):
        closed = machine(home, environ=environ, closed=("/home/a",))
        found = only(check_cache(closed))
        assert (found.status, "/home/a/.cache/cubecam" in found.text) == ("note", True)
        assert found.cure[0].startswith("export XDG_CACHE_HOME=")
    chosen = machine(home, environ={"XDG_CACHE_HOME": "/file/cache"})
    assert only(check_cache(chosen)).status == "note"  # a file is where the folder should be


# Text and JSON


def test_the_report():
    findings = [
        Finding("a", "ok", "fine"),
        Finding("b", "problem", "one\n  two", ("# why", "do it")),
    ]
    assert as_lines(findings) == [
        "ok       a: fine",
        "problem  b: one",
        "           two",
        "           # why",
        "           do it",
    ]
    (line,) = as_lines([Finding("c", "note", "CUBECAM_DEVICE=\udcff")])
    assert line == r"note     c: CUBECAM_DEVICE=\udcff"
    assert verdict(findings) == "No picture can be drawn as asked: 1 problem, no warnings."
    assert verdict(findings[:1]) == "Pictures can be drawn; no warnings."
    report = json.loads(as_json(findings))
    assert report["works"] is False
    assert report["findings"][1]["cure"] == ["# why", "do it"]


# This machine


def test_this_machine_draws():
    findings = cc.doctor.examine()
    assert [finding for finding in findings if finding.status == "problem"] == []
    assert {"drawing", "egl-library", "shader-trial", "module"} <= {
        finding.name for finding in findings
    }


@pytest.mark.parametrize("device", [1.5, [], True])
def test_what_is_no_device(device):
    with pytest.raises(TypeError, match="device: expected str, int or None, got"):
        cc.doctor.examine(device)


def test_a_bare_system_in_a_folder(tmp_path):
    """Nothing at all is there: each finding says what is missing, and none is a traceback."""
    drawn = told(
        {"error": "ContextError: the EGL library libEGL.so.1 cannot be loaded. To install it: x"}
    )
    system = machine(tmp_path, libraries=(), programs={sys.executable: drawn})
    problems = [finding.name for finding in all_findings(system) if finding.status == "problem"]
    assert problems == ["egl-library", "drawing"]


def test_a_library_that_crashes_when_it_is_loaded(tmp_path):
    script = tmp_path / "python"
    script.write_text("#!/bin/sh\nkill -SEGV $$\n")
    script.chmod(0o755)
    problem = System(python=str(script)).library_problem("libEGL.so.1")
    assert problem == "a process that loads it was ended by SIGSEGV"


def test_libraries_and_files_of_this_machine():
    system = System()
    assert system.library_problem("libc.so.6") == ""
    assert "no-such.so" in system.library_problem("no-such.so")
    assert system.run(["no-such-program"]).code is None
    assert not system.run(["no-such-program"]).late
    assert "null byte" in system.run([sys.executable, "\0"]).err
    assert system.run([sys.executable, "-c", "import time; time.sleep(60)"], timeout=0.2).late
    assert system.group_of("/dev/null")[0] == Path("/dev/null").stat().st_gid
