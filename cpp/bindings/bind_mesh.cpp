// cubecam.Mesh
#include "bind_mesh_docs.hpp"
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/geometry/mesh.hpp"
#include "cubecam/geometry/primitives.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstring>
#include <string>
#include <vector>

namespace cubecam::bindings {

namespace {

template <class Vector, class Scalar>
std::vector<Vector> to_vectors(const ContiguousArray<Scalar>& array) {
    static_assert(sizeof(Vector) == Vector::length() * sizeof(Scalar));
    std::vector<Vector> vectors(static_cast<std::size_t>(array.shape(0)));
    if (!vectors.empty())
        std::memcpy(vectors.data(), array.data(), vectors.size() * sizeof(Vector));
    return vectors;
}

/// (V, 3) or (V, 4); bytes stand for value/255, all other numbers for themselves.
std::vector<glm::vec4> to_vertex_colors(py::handle colors) {
    const py::array given = py::module_::import("numpy").attr("asarray")(colors);
    const bool bytes = given.dtype().kind() == 'u' && given.itemsize() == 1;
    const bool rgb = given.ndim() == 2 && given.shape(1) == 3;
    const bool rgba = given.ndim() == 2 && given.shape(1) == 4;
    const char* shape = rgb ? "(V, 3)" : rgba ? "(V, 4)" : "(V, 3) or (V, 4)";
    const auto array = float_array(given, "colors", shape);
    std::vector<glm::vec4> vectors(static_cast<std::size_t>(array.shape(0)), glm::vec4(1.0F));
    const float* from = array.data();
    for (glm::vec4& vector : vectors) {
        for (int i = 0; i < (rgb ? 3 : 4); ++i) vector[i] = bytes ? *from++ / 255.0F : *from++;
    }
    return vectors;
}

std::shared_ptr<Mesh> make_mesh(const ArrayLike& positions, const ArrayLike& indices,
                                const OrNone<ArrayLike>& normals, const OrNone<ArrayLike>& uvs,
                                const OrNone<ArrayLike>& colors) {
    Mesh::Arrays arrays;
    arrays.positions = to_vectors<glm::vec3>(float_array(positions, "positions", "(V, 3)"));
    arrays.triangles =
        to_vectors<glm::uvec3>(index_array(indices, "indices", "(F, 3)", arrays.positions.size()));
    if (!normals.is_none()) {
        arrays.normals = to_vectors<glm::vec3>(float_array(normals, "normals", "(V, 3)"));
    }
    if (!uvs.is_none()) arrays.uvs = to_vectors<glm::vec2>(float_array(uvs, "uvs", "(V, 2)"));
    if (!colors.is_none()) arrays.colors = to_vertex_colors(colors);
    const py::gil_scoped_release release;
    return std::make_shared<Mesh>(std::move(arrays));
}

/// A read-only view, or None.
template <class Scalar, class Vector>
py::object rows(const Mesh::Array<Vector>& vectors) {
    if (!vectors) return py::none();
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(vectors->size()),
                                         Vector::length()};
    return readonly_view(py::dtype::of<Scalar>(), shape, vectors->data(), vectors);
}

using FloatRows = py::array_t<float>;
using FloatRowsOrNone = OrNone<FloatRows>;

py::array_t<double> bounds_array(const Mesh& mesh) {
    py::array_t<double> array({2, 3});
    for (int i = 0; i < 3; ++i) {
        array.mutable_at(0, i) = mesh.bounds().low[i];
        array.mutable_at(1, i) = mesh.bounds().high[i];
    }
    array.attr("flags").attr("writeable") = false;
    return array;
}

std::string represent_mesh(const Mesh& mesh) {
    return "Mesh(" + std::to_string(mesh.positions()->size()) + " vertices, " +
           std::to_string(mesh.triangles()->size()) + " triangles)";
}

/// Meshes of many triangles take a while: other threads may go on meanwhile.
template <class... Args>
auto built_by(Mesh (*build)(Args...)) {
    return [build](Args... args) {
        const py::gil_scoped_release release;
        return std::make_shared<Mesh>(build(args...));
    };
}

void bind_primitives(Class<Mesh>& mesh) {
    namespace make = cubecam::primitives;
    mesh.def_static("plane", built_by(&make::plane), py::arg("width") = 1.0, py::arg("depth") = 1.0,
                    plane_doc);
    mesh.def_static(
        "box",
        [](const OneOf<py::float_, ArrayLike>& size) {
            return std::make_shared<Mesh>(make::box(to_scale(size, "size")));
        },
        py::arg("size") = 1.0, box_doc);
    mesh.def_static("sphere", built_by(&make::sphere), py::arg("radius") = 1.0,
                    py::arg("segments") = 64, py::arg("rings") = 32, sphere_doc);
    mesh.def_static("icosphere", built_by(&make::icosphere), py::arg("radius") = 1.0,
                    py::arg("subdivisions") = 3, icosphere_doc);
    mesh.def_static("cylinder", built_by(&make::cylinder), py::arg("radius") = 1.0,
                    py::arg("height") = 1.0, py::arg("segments") = 64, cylinder_doc);
    mesh.def_static("cone", built_by(&make::cone), py::arg("radius") = 1.0, py::arg("height") = 1.0,
                    py::arg("segments") = 64, cone_doc);
    mesh.def_static("torus", built_by(&make::torus), py::arg("radius") = 1.0,
                    py::arg("tube") = 0.25, py::arg("segments") = 64, py::arg("sides") = 32,
                    torus_doc);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_mesh(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto mesh = declare<Mesh>(module, "Mesh", mesh_doc);
    mesh.def(py::init(&make_mesh), py::arg("positions"), py::arg("indices"), py::kw_only(),
             py::arg("normals") = py::none(), py::arg("uvs") = py::none(),
             py::arg("colors") = py::none());
    bind_primitives(mesh);
    mesh.def(
        "resized",
        [](const Mesh& self, double size) {
            const py::gil_scoped_release release;
            return std::make_shared<Mesh>(centred_and_scaled(self, size));
        },
        py::arg("size"), resized_doc);

    mesh.def_property_readonly(
        "positions", [](const Mesh& self) -> FloatRows { return rows<float>(self.positions()); },
        "ndarray (V, 3) float32: a read-only view.");
    mesh.def_property_readonly(
        "indices",
        [](const Mesh& self) -> py::array_t<std::uint32_t> {
            return rows<std::uint32_t>(self.triangles());
        },
        "ndarray (F, 3) uint32: the corners of each triangle, counter-clockwise seen from outside;"
        " a read-only view.");
    mesh.def_property_readonly(
        "normals", [](const Mesh& self) -> FloatRows { return rows<float>(self.normals()); },
        "ndarray (V, 3) float32: unit vectors; a read-only view.");
    mesh.def_property_readonly(
        "uvs", [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.uvs()); },
        "ndarray (V, 2) float32 or None: (0, 0) is a picture's bottom-left; a read-only view.");
    mesh.def_property_readonly(
        "colors", [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.colors()); },
        "ndarray (V, 4) float32 or None: linear RGBA; a read-only view.");
    mesh.def_property_readonly(
        "bounds", &bounds_array,
        "ndarray (2, 3) float64: the least and the greatest x, y, z of the vertices.");

    mesh.def("__repr__", &represent_mesh);
    mesh.def("__reduce__", [](const py::object& self) {
        return reduced(self,
                       attributes_of(self, "positions", "indices", "normals", "uvs", "colors"));
    });
    // What never changes need not be copied.
    mesh.def("__copy__", [](const py::object& self) { return self; });
    mesh.def(
        "__deepcopy__", [](const py::object& self, const py::dict&) { return self; },
        py::arg("memo"));
}
