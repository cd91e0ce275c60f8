// cubecam.ProbeBlend
#include "docs/probe_blend.hpp"
#include "objects.hpp"

#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/probe_blend.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using Probes = OneOf<py::typing::Iterable<Probe>>;

std::shared_ptr<ProbeBlend> make_blend(const Probes& probes) {
    if (!py::isinstance<py::iterable>(probes)) refuse(probes, "probes", "a sequence of Probes");
    std::vector<std::shared_ptr<Probe>> found;
    for (const py::handle probe : py::iter(probes)) {
        found.push_back(to_shared<Probe>(probe, "probes", "Probes"));
    }
    return std::make_shared<ProbeBlend>(std::move(found));
}

py::tuple probes_of(const ProbeBlend& blend) {
    py::list probes;
    for (const auto& probe : blend.probes()) probes.append(probe);
    return py::tuple(probes);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_probe_blend(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto blend = declared<ProbeBlend>();
    blend.attr("__doc__") = docs::probe_blend;
    blend.def(py::init(&make_blend), py::arg("probes"));
    blend.def_property_readonly(
        "probes",
        [](const ProbeBlend& self) -> py::typing::Tuple<Probe, py::ellipsis> {
            return probes_of(self);
        },
        "tuple of Probe: in the order in which they were given.");
    blend.def("__repr__", [](const ProbeBlend& self) {
        const std::size_t count = self.probes().size();
        return "ProbeBlend(" + std::to_string(count) + (count == 1 ? " probe)" : " probes)");
    });
    blend.def("__reduce__",
              [](const py::object& self) { return reduced(self, attributes_of(self, "probes")); });
}
