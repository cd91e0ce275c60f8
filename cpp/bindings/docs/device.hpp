/// Docstrings of cubecam.Device and cubecam.devices().
#pragma once

namespace cubecam::docs {

inline constexpr const char* device =
    R"doc(A device that can render, as `devices` lists it.

Attributes
----------
index : int
    The place of the device in `devices()`, for ``Renderer(device=index)``; -1 for a context without an EGL
    device.
name : str
    For example ``"NVIDIA GeForce RTX 4090"`` or ``"llvmpipe (LLVM 15.0.6, 256 bits)"``;
    ``"unknown"`` if the driver does not report it.
vendor : str
    The maker of the driver, or ``"unknown"``.
driver : str
    The driver's name or version, for example ``"nvidia"`` or ``"Mesa 22.3.6"``; empty if the driver does
    not report it.
software : bool
    Whether the device renders on the CPU.
uuid : str
    32 hexadecimal digits in groups of 8-4-4-4-12; empty if the driver does not report it.
cuda_index : int or None
    CUDA's number of the same GPU, which may differ from `index`.
drm_node : str
    For example ``"/dev/dri/renderD128"``; empty if there is none.
platform : str
    ``"device"``; for a renderer's own device also ``"surfaceless"`` or ``"default"``.
problem : str
    Why the device cannot be used; empty if it can.
)doc";

inline constexpr const char* devices =
    R"doc(List the devices that can render.

The list does not affect which device a `Renderer` chooses. The first call may start drivers to learn
their names. A device whose driver does not start is listed too, with the reason in its `problem`.

Returns
-------
list of Device
    The devices in the order of ``Renderer(device=index)``. The list is empty if EGL cannot list devices; a
    `Renderer` may still find the surfaceless or the default display.

Raises
------
ContextError
    If there is no EGL library, or in a process forked after EGL was opened.
)doc";

}  // namespace cubecam::docs
