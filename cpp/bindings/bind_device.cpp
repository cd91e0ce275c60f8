// cubecam.Device and cubecam.devices().
#include "docs/device.hpp"
#include "objects.hpp"
#include "unlocked.hpp"

#include "cubecam/gl/devices.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

std::string quoted(const std::string& text) { return py::repr(py::str(text)).cast<std::string>(); }

std::string represent(const gl::DeviceInfo& device) {
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

    auto device = declare<DeviceInfo>(module, "Device", cubecam::docs::device);
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
        .def("__repr__", &represent);

    module.def("devices", &cubecam::gl::list_devices, py::call_guard<Unlocked>(),
               cubecam::docs::devices);
}
