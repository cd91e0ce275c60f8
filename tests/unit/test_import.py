"""What an import of cubecam loads, and what the module contains."""

import pathlib
import subprocess

import pytest

import cubecam as cc
from tests.helpers import need_no_sanitizer, run_python


def test_import_opens_nothing_and_loads_nothing_heavy():
    run_python(
        """
        import os, sys
        import cubecam
        maps = open("/proc/self/maps").read()
        for library in ("libEGL", "libGL", "libX11", "libGLX", "swrast"):
            assert library not in maps, library
        for module in ("numpy", "OpenImageIO", "trimesh", "matplotlib", "PIL", "click", "rich", "IPython"):
            assert module not in sys.modules, module
        devices = [os.readlink(f"/proc/self/fd/{fd}") for fd in os.listdir("/proc/self/fd")
                   if os.path.exists(f"/proc/self/fd/{fd}")]
        assert not [d for d in devices if d.startswith("/dev/dri") or "nvidia" in d], devices
        """
    )


def test_what_is_loaded_late_looks_as_if_it_were_there():
    run_python(
        """
        import inspect, sys
        import cubecam as cc
        assert {"load_mesh", "to_screen", "demo", "navigation"} <= set(dir(cc))
        try:
            cc.lode_mesh
        except AttributeError as error:
            assert (str(error), error.name) == ("module 'cubecam' has no attribute 'lode_mesh'", "lode_mesh")
        late = vars(cc.CubeMap)["save"]
        assert not inspect.isfunction(late)
        assert "io.cubemap_save" not in " ".join(sys.modules)
        assert "_repr_html_" in vars(cc.Scene)
        assert "cubecam.pictures" not in sys.modules
        # Programs that write documentation unwrap what a class's __dict__ holds.
        assert inspect.unwrap(late).__doc__.startswith("Write a cubemap")
        assert cc.CubeMap.save is vars(cc.CubeMap)["save"]
        assert list(inspect.signature(cc.CubeMap.save).parameters)[:2] == ["cube", "path"]
        names = {}
        exec("from cubecam import *", names)
        assert names["load_mesh"] is cc.load_mesh is vars(cc)["load_mesh"]
        assert cc.io.meshes.load.load_mesh is cc.load_mesh
        """
    )


def test_cpu_work_needs_no_context():
    """CubeMaps, meshes and scenes do not need EGL at all."""
    run_python(
        """
        import numpy as np, cubecam as cc
        cube = cc.CubeMap.from_equirect(np.ones((8, 16, 3)))
        cube.to_equirect(); cube.sample([0, 0, 1]); cube.resize(3)
        scene = cc.Scene(environment=cube)
        scene.add(cc.Mesh.sphere(1), cc.MirrorMaterial())
        assert "libEGL" not in open("/proc/self/maps").read()
        """,
        CUBECAM_EGL_LIBRARY="libnone.so",
    )


def test_the_extension_links_no_gl_egl_or_x11():
    need_no_sanitizer("the module links its library")
    from cubecam import _core

    wanted = subprocess.run(
        ["readelf", "-d", _core.__file__], capture_output=True, text=True, check=True
    ).stdout
    needed = [line.split("[")[1].rstrip("]") for line in wanted.splitlines() if "(NEEDED)" in line]
    assert needed
    allowed = {
        "libstdc++",
        "libm",
        "libgcc_s",
        "libc",
        "ld-linux-x86-64",
        "ld-linux-aarch64",
        "libpthread",
        "libdl",
    }
    assert {name.split(".so")[0] for name in needed} <= allowed


def test_no_symbols_leak():
    """The module exports only its entry function, so that it works beside other GL libraries."""
    from cubecam import _core

    symbols = subprocess.run(
        ["nm", "-D", "--defined-only", _core.__file__], capture_output=True, text=True, check=True
    ).stdout.split("\n")
    names = [line.split()[-1] for line in symbols if line]
    assert "PyInit__core" in names
    assert not [name for name in names if "glad" in name.lower() or name.startswith(("gl", "egl"))]


def test_public_names_exist_and_say_where_they_live():
    for name in cc.__all__:
        thing = getattr(cc, name)
        if isinstance(thing, type):
            assert thing.__module__ == "cubecam", name


@pytest.mark.parametrize(
    "name",
    [
        "Scene",
        "Mesh",
        "Image",
        "CubeMap",
        "Face",
        "Probe",
        "Node",
        "BasicMaterial",
        "PhongMaterial",
        "MirrorMaterial",
        "GlassMaterial",
        "PointLight",
        "DirectionalLight",
        "AmbientLight",
        "Camera",
        "PerspectiveCamera",
        "OrthographicCamera",
        "Renderer",
        "Frame",
        "Error",
        "ContextError",
        "ShaderError",
        "FileError",
        "ImageError",
        "MeshError",
        "axis_angle",
        "devices",
        "load_image",
        "save_image",
        "load_environment",
        "load_cubemap",
        "load_mesh",
        "load_scene",
        "save_animation",
        "sample_data",
    ],
)
def test_names_of_the_design_are_public(name):
    assert name in cc.__all__
    assert hasattr(cc, name)


def test_version_agrees_with_the_package():
    from importlib.metadata import version

    assert cc.__version__ == version("cubecam")


def test_typed():
    folder = pathlib.Path(cc.__file__).parent
    assert (folder / "py.typed").exists()
    assert (folder / "_core.pyi").exists()


def test_there_are_no_subclasses_of_bound_classes():
    """Methods that exist only in Python are attached to the bound classes, so that a capture returns a cc.CubeMap."""
    for name in ("CubeMap", "Frame", "Scene", "Renderer", "Mesh", "Image"):
        assert getattr(cc, name).__subclasses__() == []
    assert callable(cc.CubeMap.save)
