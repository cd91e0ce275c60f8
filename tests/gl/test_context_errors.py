"""No EGL library, no device, an unknown device: the errors say what was tried and what would help."""

import pytest

import cubecam as cc
from tests.helpers import need_no_sanitizer, run_python

TRY = """
import cubecam as cc
for call in ({calls}):
    try:
        call()
    except cc.ContextError as error:
        print(error)
    else:
        raise SystemExit("expected a ContextError")
"""


def refused(calls="cc.Renderer,", **environment):
    return run_python(TRY.replace("{calls}", calls), **environment).stdout


@pytest.mark.parametrize("call", ["cc.Renderer,", "cc.devices,"])
def test_no_egl_library(call):
    text = refused(call, CUBECAM_EGL_LIBRARY="libnowhere.so.9")
    assert "libnowhere.so.9" in text
    assert "libegl1" in text
    assert "`cubecam doctor`" in text


@pytest.mark.llvmpipe("variables that choose another driver change the advice")
def test_no_device(tmp_path):
    """Without a vendor library, the error names every platform that was tried, and what to install."""
    text = refused(__EGL_VENDOR_LIBRARY_FILENAMES="/nonexistent")
    for word in ("device", "surfaceless", "default"):
        assert word in text.lower()
    assert "libgl1-mesa-dri" in text
    assert "`cubecam doctor`" in text


def test_after_a_failure_the_process_lives_on():
    run_python(
        """
        import numpy as np, cubecam as cc
        for _ in range(3):
            try:
                cc.Renderer()
            except cc.ContextError:
                pass
        assert cc.CubeMap(np.ones((6, 2, 2, 3))).sample([0, 0, 1]).shape == (3,)
        """,
        CUBECAM_EGL_LIBRARY="libnowhere.so.9",
    )


@pytest.mark.parametrize("device", ["no such card", 99, "12345678-1234-1234-1234-123456789abc"])
def test_unknown_devices_are_refused_listing_those_there_are(device):
    with pytest.raises((cc.ContextError, ValueError)) as raised:
        cc.Renderer(device=device)
    assert str(device) in str(raised.value)
    assert cc.devices()[0].name.split()[0] in str(raised.value)


@pytest.mark.parametrize(
    ("device", "error"), [(-1, (cc.ContextError, ValueError)), (1.5, TypeError), ([], TypeError)]
)
def test_what_is_no_device_is_refused(device, error):
    with pytest.raises(error):
        cc.Renderer(device=device)


def test_software_is_software():
    with cc.Renderer(device="software") as renderer:
        assert renderer.info.software is True


def test_gpu_is_a_gpu_or_refused():
    if any(not device.software for device in cc.devices()):
        with cc.Renderer(device="gpu") as renderer:
            assert renderer.info.software is False
    else:
        with pytest.raises(cc.ContextError, match=r"(?i)gpu"):
            cc.Renderer(device="gpu")


def test_devices_tell_what_there_is():
    devices = cc.devices()
    assert devices
    for index, device in enumerate(devices):
        assert device.index == index
        assert device.name
        assert device.vendor
        assert isinstance(device.software, bool)
        for name in ("driver", "uuid", "cuda_index", "drm_node", "platform"):
            assert hasattr(device, name)
        assert device.name in repr(device)


def test_a_device_is_chosen_by_index_name_part_and_uuid():
    for device in cc.devices():
        choices: list[int | str] = [device.index, device.name, device.name.split()[0].upper()[:6]]
        if device.uuid:
            choices += [device.uuid, f"GPU-{device.uuid}", f"GPU-{device.uuid}".lower()]
        for choice in choices:
            with cc.Renderer(device=choice) as renderer:
                assert renderer.info.device.name == device.name or device.name in str(
                    renderer.info.device
                )


@pytest.mark.parametrize("value", ["software", "0"])
def test_the_environment_variable_says_the_same(value):
    done = run_python(
        "import cubecam as cc; print(cc.Renderer().info.renderer)", CUBECAM_DEVICE=value
    )
    assert done.stdout.strip()


def test_the_environment_variable_is_told_in_its_error():
    text = refused(CUBECAM_DEVICE="no such card")
    assert "no such card" in text
    assert "CUBECAM_DEVICE" in text


def test_an_argument_goes_before_the_environment_variable():
    run_python(
        "import cubecam as cc; cc.Renderer(device='software')", CUBECAM_DEVICE="no such card"
    )


def test_info_tells_what_was_chosen(renderer):
    info = renderer.info
    for name in ("vendor", "renderer", "version", "glsl_version", "platform"):
        assert isinstance(getattr(info, name), str)
        assert getattr(info, name)
    assert info.version.startswith("4.")
    assert isinstance(info.software, bool)
    assert info.limits.max_samples >= 4
    assert info.limits.max_texture_size >= 4096
    assert info.limits.max_cube_map_texture_size >= 4096


def test_too_many_open_files_are_called_that():
    """The driver is there, and nothing is to be installed; with files closed, it works."""
    need_no_sanitizer("it looks at memory through a pipe, for which no file is left")
    run_python(
        """
        import os, resource
        import cubecam as cc
        hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
        resource.setrlimit(resource.RLIMIT_NOFILE, (64, hard))
        files = []
        try:
            while True:
                files.append(os.open("/dev/null", os.O_RDONLY))
        except OSError:
            pass
        for spare in range(3):  # too few for the library, or for its driver
            try:
                cc.Renderer()
            except cc.ContextError as error:
                text = str(error)
                assert "as many files open" in text and "ulimit -n" in text, text
                assert "apt install" not in text, text
            else:
                assert spare > 0
                break
            os.close(files.pop())
        for file in files:
            os.close(file)
        assert cc.Renderer().capture(cc.Scene(), size=2).size == 2
        """
    )
