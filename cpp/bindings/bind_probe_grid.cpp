// cubecam.ProbeGrid
#include "arrays.hpp"
#include "bounds.hpp"
#include "docs/probe_grid.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/probe_grid.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using Counts = Shown<"tuple[int, int, int]">;

glm::ivec3 to_counts(const Counts& counts) {
    constexpr const char* expected = "three whole numbers (nx, ny, nz)";
    if (py::isinstance<py::str>(counts) || !py::isinstance<py::sequence>(counts)) {
        refuse(counts, "counts", expected);
    }
    const auto items = py::reinterpret_borrow<py::sequence>(counts);
    if (py::len(items) != 3) refuse(counts, "counts", expected);
    glm::ivec3 found;
    for (int axis = 0; axis < 3; ++axis) {
        const py::object item = items[static_cast<std::size_t>(axis)];
        found[axis] = static_cast<int>(to_int(item, "counts", 2, most_grid_texels));
    }
    return found;
}

std::vector<py::ssize_t> shape_of(const ProbeGridValue& value,
                                  std::initializer_list<py::ssize_t> rest) {
    std::vector<py::ssize_t> shape{value.counts.z, value.counts.y, value.counts.x};
    shape.insert(shape.end(), rest);
    return shape;
}

std::string text_of_shape(const std::vector<py::ssize_t>& shape) {
    std::string text;
    for (const py::ssize_t length : shape) {
        text += (text.empty() ? "" : ", ") + std::to_string(length);
    }
    return "(" + text + ")";
}

SharedNumbers<float> to_numbers(const ArrayLike& value, const char* name,
                                const std::vector<py::ssize_t>& shape) {
    const auto array = float_array(value, name, text_of_shape(shape));
    return std::make_shared<const std::vector<float>>(to_vector(array));
}

template <class Value>
void option(Class<ProbeGrid>& grid, const char* name, Value ProbeGridValue::* member,
            const char* doc) {
    grid.def_property(
        name, [member](const ProbeGrid& self) { return self.value().*member; },
        [member](ProbeGrid& self, Strict<Value> value) {
            self.edit([&](ProbeGridValue& next) { next.*member = *value; });
        },
        doc);
}

void bind_arrays_of(Class<ProbeGrid>& grid) {
    grid.def_property(
        "coefficients",
        [](const ProbeGrid& self) -> OneOf<py::array_t<float>> {
            const ProbeGridValue value = self.value();
            return readonly_view(value.coefficients, shape_of(value, {9, 3}));
        },
        [](ProbeGrid& self, const ArrayLike& given) {
            const auto numbers = to_numbers(given, "coefficients", shape_of(self.value(), {9, 3}));
            self.edit([&](ProbeGridValue& next) { next.coefficients = numbers; });
        },
        "ndarray (nz, ny, nx, 9, 3) float32: integrals of radiance times the basis of "
        "`CubeMap.sh` at each node; read-only.");
    grid.def_property(
        "distances",
        [](const ProbeGrid& self) -> OneOf<py::array_t<float>> {
            const ProbeGridValue value = self.value();
            return readonly_view(value.distances,
                                 shape_of(value, {value.resolution, value.resolution, 2}));
        },
        [](ProbeGrid& self, const ArrayLike& given) {
            const int edge = self.value().resolution;
            const auto numbers =
                to_numbers(given, "distances", shape_of(self.value(), {edge, edge, 2}));
            self.edit([&](ProbeGridValue& next) { next.distances = numbers; });
        },
        "ndarray (nz, ny, nx, R, R, 2) float32: means of the distance and of its square round the "
        "directions of an octahedral map of R = `resolution`, world units; read-only.");
    grid.def_property(
        "active", [](const ProbeGrid& self)->Shown<"numpy.typing.NDArray[numpy.bool_]"> {
            const ProbeGridValue value = self.value();
            return readonly_view(py::dtype::of<bool>(), shape_of(value, {}), value.active->data(),
                                 value.active);
        },
        [](ProbeGrid& self, const ArrayLike& given) {
            const py::array array = to_array(given, "active");
            if (array.dtype().kind() != 'b') refuse(given, "active", "an array of bool");
            check_shape(array, "active", text_of_shape(shape_of(self.value(), {})));
            const ContiguousArray<std::uint8_t> bytes(
                array.attr("astype")(py::dtype::of<std::uint8_t>()));
            const auto numbers = std::make_shared<const std::vector<std::uint8_t>>(
                bytes.data(), bytes.data() + bytes.size());
            self.edit([&](ProbeGridValue& next) { next.active = numbers; });
        },
        "ndarray (nz, ny, nx) bool: False for nodes that lie in bodies, which count only where no "
        "other node does; read-only.");
}

}  // namespace

}  // namespace cubecam::bindings

void bind_probe_grid(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto grid = declared<ProbeGrid>();
    grid.attr("__doc__") = docs::probe_grid;
    grid.def(py::init([](const ArrayLike& box, const Counts& counts, Int size, Int resolution,
                         Flag visibility, Real normal_bias, Real view_bias) {
                 ProbeGridValue value =
                     empty_grid(to_bounds(box, "box"), to_counts(counts), resolution);
                 value.visibility = visibility;
                 value.normal_bias = normal_bias;
                 value.view_bias = view_bias;
                 value.size = size;
                 return std::make_shared<ProbeGrid>(std::move(value));
             }),
             py::arg("box"), py::arg("counts"), py::kw_only(), py::arg("size") = 32,
             py::arg("resolution") = 16, py::arg("visibility") = true, py::arg("normal_bias") = 0.1,
             py::arg("view_bias") = 0.2);
    grid.def_property_readonly(
        "box", [](const ProbeGrid& self) { return bounds_array(self.value().box); },
        "ndarray (2, 3) float64: the first and the last node, world; read-only.");
    grid.def_property_readonly(
        "counts",
        [](const ProbeGrid& self) -> py::typing::Tuple<int, int, int> {
            const glm::ivec3 counts = self.value().counts;
            return py::make_tuple(counts.x, counts.y, counts.z);
        },
        "tuple of three int: nodes along x, y and z.");
    grid.def_property_readonly(
        "resolution", [](const ProbeGrid& self) { return self.value().resolution; },
        "int: texels along an edge of the map of distances of a node.");
    option(grid, "size", &ProbeGridValue::size,
           "int: texels along an edge of the cubemaps that `bake` captures.");
    option(grid, "visibility", &ProbeGridValue::visibility,
           "bool: whether nodes that do not see a point count less there.");
    option(grid, "normal_bias", &ProbeGridValue::normal_bias,
           "float: how far before its surface the visibility of a point counts, in least steps.");
    option(grid, "view_bias", &ProbeGridValue::view_bias,
           "float: how far towards the viewer the visibility of a point counts, in least steps.");
    bind_arrays_of(grid);
    grid.def("__repr__", [](const ProbeGrid& self) {
        const glm::ivec3 counts = self.value().counts;
        return "ProbeGrid(" + std::to_string(counts.x) + " x " + std::to_string(counts.y) + " x " +
               std::to_string(counts.z) + " nodes)";
    });
    grid.def("__reduce__", [](const py::object& self) {
        return reduced(
            self,
            attributes_of(self, "box", "counts", "size", "resolution", "visibility", "normal_bias",
                          "view_bias"),
            py::make_tuple(self.attr("coefficients"), self.attr("distances"), self.attr("active")));
    });
    def_setstate(grid, "tuple", [](const py::object& self, const py::tuple& state) {
        self.attr("coefficients") = state[0];
        self.attr("distances") = state[1];
        self.attr("active") = state[2];
    });
}
