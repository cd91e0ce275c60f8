// cubecam._core._read_radiance, for cubecam/io/radiance.py
#include "objects.hpp"
#include "unlocked.hpp"

#include "cubecam/image/radiance.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace cubecam::bindings {

namespace {

pybind11::array_t<float> decode_radiance(const pybind11::bytes& data, std::size_t start,
                                         std::size_t scanlines, std::size_t length) {
    const std::string_view text = data;
    const auto* first = reinterpret_cast<const std::uint8_t*>(text.data());
    const std::span<const std::uint8_t> all(first, text.size());
    const std::span<const std::uint8_t> bytes = all.subspan(std::min(start, all.size()));
    RadianceScan scan;
    {
        const Unlocked unlocked;
        scan = scan_radiance(bytes, scanlines, length);
    }
    pybind11::array_t<float> made({scanlines, length, std::size_t{3}});
    const std::span<float> out(made.mutable_data(), static_cast<std::size_t>(made.size()));
    {
        const Unlocked unlocked;
        read_radiance(scan, out);
    }
    return made;
}

}  // namespace

}  // namespace cubecam::bindings

void bind_radiance(pybind11::module_& module) {
    namespace py = pybind11;
    module.def("_read_radiance", &cubecam::bindings::decode_radiance, py::arg("data"),
               py::arg("start"), py::arg("scanlines"), py::arg("length"),
               "The scanlines of a Radiance picture, (scanlines, length, 3) float32.\n\n"
               "ValueError names the scanline that is broken.");
}
