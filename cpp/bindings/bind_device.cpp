// cubecam.Device and cubecam.devices().
#include "objects.hpp"

#include "cubecam/gl/devices.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

constexpr const char* device_doc = R"doc(A device that can render, as `devices` lists it.

Attributes
----------
index : int
    Its place in `devices()`, for ``Renderer(device=index)``; -1 for a context that no EGL device
    stands behind.
name : str
    For example ``"NVIDIA GeForce RTX 4090"`` or ``"llvmpipe (LLVM 15.0.6, 256 bits)"``;
    ``"unknown"`` if the driver does not tell.
vendor : str
    Who made the driver, or ``"unknown"``.
driver : str
    The driver's name or version, for example ``"nvidia"`` or ``"Mesa 22.3.6"``; empty if it does
    not tell.
software : bool
    Whether it renders on the CPU.
uuid : str
    32 hexadecimal digits in groups of 8-4-4-4-12; empty if the driver does not tell.
cuda_index : int or None
    CUDA's number of the same GPU, which need not be `index`.
drm_node : str
    For example ``"/dev/dri/renderD128"``; empty if there is none.
platform : str
    ``"device"``; for a renderer's own device also ``"surfaceless"`` or ``"default"``.
problem : str
    Why it cannot be used; empty when it can.
)doc";

constexpr const char* devices_doc = R"doc(The devices that can render.

Nothing is chosen or kept. The first call may start drivers to learn their names. A device whose
driver does not start is listed too, with the reason in its `problem`.

Returns
-------
list of Device
    In the order that ``Renderer(device=index)`` counts them. Empty if EGL cannot list devices; a
    `Renderer` may still find the surfaceless or the default display.

Raises
------
ContextError
    If there is no EGL library, or in a process forked after EGL was opened.
)doc";

std::string quoted(const std::string& text) { return py::repr(py::str(text)).cast<std::string>(); }

std::string represent_device(const gl::DeviceInfo& device) {
    std::string text = "Device(index=" + std::to_string(device.index) +
                       ", name=" + quoted(device.name) + ", vendor=" + quoted(device.vendor) +
                       ", driver=" + quoted(device.driver) +
                       ", software=" + (device.software ? "True" : "False");
    if (!device.uuid.empty()) text += ", uuid=" + quoted(device.uuid);
    if (device.cuda_index) text += ", cuda_index=" + std::to_string(*device.cuda_index);
    if (!device.drm_node.empty()) text += ", drm_node=" + quoted(device.drm_node);
    text += ", platform=" + quoted(device.platform);
    if (!device.problem.empty()) text += ", problem=" + quoted(device.problem);
    return text + ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_device(py::module_& module) {
    using namespace cubecam::bindings;
    using cubecam::gl::DeviceInfo;

    auto device = declare<DeviceInfo>(module, "Device", device_doc);
    device.def_readonly("index", &DeviceInfo::index)
        .def_readonly("name", &DeviceInfo::name)
        .def_readonly("vendor", &DeviceInfo::vendor)
        .def_readonly("driver", &DeviceInfo::driver)
        .def_readonly("software", &DeviceInfo::software)
        .def_readonly("uuid", &DeviceInfo::uuid)
        .def_readonly("cuda_index", &DeviceInfo::cuda_index)
        .def_readonly("drm_node", &DeviceInfo::drm_node)
        .def_readonly("platform", &DeviceInfo::platform)
        .def_readonly("problem", &DeviceInfo::problem)
        .def("__repr__", &represent_device);

    module.def("devices", &cubecam::gl::list_devices, py::call_guard<py::gil_scoped_release>(),
               devices_doc);
}
