// cubecam.Mesh
#include "bounds.hpp"
#include "docs/mesh.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/geometry/primitives.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

template <class Vector, class Scalar>
std::vector<Vector> to_vectors(const ContiguousArray<Scalar>& array) {
    static_assert(sizeof(Vector) == Vector::length() * sizeof(Scalar));
    const auto* from = reinterpret_cast<const Vector*>(array.data());
    return std::vector<Vector>(from, from + array.shape(0));
}

/// The shape "(V, 3)", with the number of vertices in place of V if the number is known.
std::string rows_of(std::optional<std::size_t> vertices, int columns) {
    return "(" + (vertices ? std::to_string(*vertices) : "V") + ", " + std::to_string(columns) +
           ")";
}

/// Colours from an array (V, 3) or (V, 4); uint8 stands for value/255.
std::vector<glm::vec4> to_vertex_colors(py::handle colors,
                                        std::optional<std::size_t> vertices = std::nullopt) {
    const py::array given = to_array(colors, "colors");
    const bool bytes = given.dtype().kind() == 'u' && given.itemsize() == 1;
    const bool rgb = given.ndim() == 2 && given.shape(1) == 3;
    const bool rgba = given.ndim() == 2 && given.shape(1) == 4;
    const std::string shape = rgb    ? rows_of(vertices, 3)
                              : rgba ? rows_of(vertices, 4)
                                     : rows_of(vertices, 3) + " or " + rows_of(vertices, 4);
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
                                const OrNone<ArrayLike>& colors, const OrNone<ArrayLike>& uvs1,
                                const OrNone<ArrayLike>& tangents) {
    MeshData::Arrays arrays;
    arrays.positions = to_vectors<glm::vec3>(float_array(positions, "positions", "(V, 3)"));
    arrays.triangles =
        to_vectors<glm::uvec3>(index_array(indices, "indices", "(F, 3)", arrays.positions.size()));
    if (!normals.is_none()) {
        arrays.normals = to_vectors<glm::vec3>(float_array(normals, "normals", "(V, 3)"));
    }
    if (!uvs.is_none()) arrays.uvs = to_vectors<glm::vec2>(float_array(uvs, "uvs", "(V, 2)"));
    if (!colors.is_none()) arrays.colors = to_vertex_colors(colors);
    if (!uvs1.is_none()) arrays.uvs1 = to_vectors<glm::vec2>(float_array(uvs1, "uvs1", "(V, 2)"));
    if (!tangents.is_none()) {
        arrays.tangents = to_vectors<glm::vec4>(float_array(tangents, "tangents", "(V, 4)"));
    }
    const py::gil_scoped_release release;
    return std::make_shared<Mesh>(MeshData(std::move(arrays)));
}

std::size_t vertices_of(const Mesh& mesh) { return mesh.data()->positions()->size(); }

std::vector<glm::vec3> new_positions(const Mesh& mesh, py::handle positions) {
    return to_vectors<glm::vec3>(
        float_array(positions, "positions", rows_of(vertices_of(mesh), 3)));
}

std::vector<glm::vec3> new_normals(const Mesh& mesh, py::handle normals) {
    return to_vectors<glm::vec3>(float_array(normals, "normals", rows_of(vertices_of(mesh), 3)));
}

std::vector<glm::vec2> new_uvs(const Mesh& mesh, py::handle uvs, const char* name) {
    return to_vectors<glm::vec2>(float_array(uvs, name, rows_of(vertices_of(mesh), 2)));
}

std::vector<glm::vec4> new_tangents(const Mesh& mesh, py::handle tangents) {
    return to_vectors<glm::vec4>(float_array(tangents, "tangents", rows_of(vertices_of(mesh), 4)));
}

void apply(Mesh& mesh, MeshUpdate update) {
    const py::gil_scoped_release release;
    mesh.update(std::move(update));
}

void update_mesh(Mesh& self, const OrNone<ArrayLike>& positions, const OrNone<ArrayLike>& normals,
                 const OrNone<ArrayLike>& uvs, const OrNone<ArrayLike>& colors,
                 const OrNone<ArrayLike>& uvs1, const OrNone<ArrayLike>& tangents) {
    MeshUpdate update;
    if (!positions.is_none()) update.positions = new_positions(self, positions);
    if (!normals.is_none()) update.normals = new_normals(self, normals);
    if (!uvs.is_none()) update.uvs = new_uvs(self, uvs, "uvs");
    if (!colors.is_none()) update.colors = to_vertex_colors(colors, vertices_of(self));
    if (!uvs1.is_none()) update.uvs1 = new_uvs(self, uvs1, "uvs1");
    if (!tangents.is_none()) update.tangents = new_tangents(self, tangents);
    apply(self, std::move(update));
}

/// A read-only view, or None.
template <class Scalar, class Vector>
py::object rows(const MeshData::Array<Vector>& vectors) {
    if (!vectors) return py::none();
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(vectors->size()),
                                         Vector::length()};
    return readonly_view(py::dtype::of<Scalar>(), shape, vectors->data(), vectors);
}

using FloatRows = py::array_t<float>;
using FloatRowsOrNone = OrNone<FloatRows>;

std::string represent(const Mesh& mesh) {
    const auto data = mesh.data();
    return "Mesh(" + std::to_string(data->positions()->size()) + " vertices, " +
           std::to_string(data->triangles()->size()) + " triangles)";
}

/// A function that builds a mesh without the GIL, since a mesh of many triangles takes a while.
template <class... Args>
auto built_by(MeshData (*build)(Args...)) {
    return [build](Args... args) {
        const py::gil_scoped_release release;
        return std::make_shared<Mesh>(build(args...));
    };
}

void bind_primitives(Class<Mesh>& mesh) {
    namespace make = cubecam::primitives;
    mesh.def_static("plane", built_by(&make::plane), py::arg("width") = 1.0, py::arg("depth") = 1.0,
                    docs::plane);
    mesh.def_static(
        "box",
        [](const OneOf<py::float_, ArrayLike>& size) {
            return std::make_shared<Mesh>(make::box(to_scale(size, "size")));
        },
        py::arg("size") = 1.0, docs::box);
    mesh.def_static("sphere", built_by(&make::sphere), py::arg("radius") = 1.0,
                    py::arg("segments") = 64, py::arg("rings") = 32, docs::sphere);
    mesh.def_static("icosphere", built_by(&make::icosphere), py::arg("radius") = 1.0,
                    py::arg("subdivisions") = 3, docs::icosphere);
    mesh.def_static("cylinder", built_by(&make::cylinder), py::arg("radius") = 1.0,
                    py::arg("height") = 1.0, py::arg("segments") = 64, docs::cylinder);
    mesh.def_static("cone", built_by(&make::cone), py::arg("radius") = 1.0, py::arg("height") = 1.0,
                    py::arg("segments") = 64, docs::cone);
    mesh.def_static("torus", built_by(&make::torus), py::arg("radius") = 1.0,
                    py::arg("tube") = 0.25, py::arg("segments") = 64, py::arg("sides") = 32,
                    docs::torus);
    mesh.def_static(
        "arrow",
        [](double length, std::optional<double> radius, std::optional<double> head_length,
           std::optional<double> head_radius, int segments) {
            return std::make_shared<Mesh>(make::arrow(
                length, radius.value_or(0.05 * length), head_length.value_or(0.25 * length),
                head_radius.value_or(0.1 * length), segments));
        },
        py::arg("length") = 1.0, py::kw_only(), py::arg("radius") = py::none(),
        py::arg("head_length") = py::none(), py::arg("head_radius") = py::none(),
        py::arg("segments") = 64, docs::arrow);
}

/// Defines the properties of the vertices. Setting one replaces the array, and arrays that were
/// read before keep their values.
void bind_vertices(Class<Mesh>& mesh) {
    mesh.def_property(
        "positions",
        [](const Mesh& self) -> FloatRows { return rows<float>(self.data()->positions()); },
        [](Mesh& self, const ArrayLike& value) {
            MeshUpdate update;
            update.positions = new_positions(self, value);
            apply(self, std::move(update));
        },
        docs::positions);
    mesh.def_property_readonly(
        "indices",
        [](const Mesh& self) -> py::array_t<std::uint32_t> {
            return rows<std::uint32_t>(self.data()->triangles());
        },
        "ndarray (F, 3) uint32: the corners of each triangle, counter-clockwise seen from outside;"
        " a read-only view.");
    mesh.def_property(
        "normals",
        [](const Mesh& self) -> FloatRows { return rows<float>(self.data()->normals()); },
        [](Mesh& self, const OrNone<ArrayLike>& value) {
            MeshUpdate update;
            update.normals.emplace();
            if (!value.is_none()) update.normals = new_normals(self, value);
            apply(self, std::move(update));
        },
        docs::normals);
    mesh.def_property(
        "uvs", [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.data()->uvs()); },
        [](Mesh& self, const OrNone<ArrayLike>& value) {
            MeshUpdate update;
            update.uvs.emplace();
            if (!value.is_none()) update.uvs = new_uvs(self, value, "uvs");
            apply(self, std::move(update));
        },
        docs::uvs);
    mesh.def_property(
        "colors",
        [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.data()->colors()); },
        [](Mesh& self, const OrNone<ArrayLike>& value) {
            MeshUpdate update;
            update.colors.emplace();
            if (!value.is_none()) update.colors = to_vertex_colors(value, vertices_of(self));
            apply(self, std::move(update));
        },
        docs::colors);
    mesh.def_property(
        "uvs1",
        [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.data()->uvs1()); },
        [](Mesh& self, const OrNone<ArrayLike>& value) {
            MeshUpdate update;
            update.uvs1.emplace();
            if (!value.is_none()) update.uvs1 = new_uvs(self, value, "uvs1");
            apply(self, std::move(update));
        },
        docs::uvs1);
    mesh.def_property(
        "tangents",
        [](const Mesh& self) -> FloatRowsOrNone { return rows<float>(self.data()->tangents()); },
        [](Mesh& self, const OrNone<ArrayLike>& value) {
            MeshUpdate update;
            update.tangents.emplace();
            if (!value.is_none()) update.tangents = new_tangents(self, value);
            apply(self, std::move(update));
        },
        docs::tangents);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_mesh(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto mesh = declare<Mesh>(module, "Mesh", docs::mesh);
    mesh.def(py::init(&make_mesh), py::arg("positions"), py::arg("indices"), py::kw_only(),
             py::arg("normals") = py::none(), py::arg("uvs") = py::none(),
             py::arg("colors") = py::none(), py::arg("uvs1") = py::none(),
             py::arg("tangents") = py::none());
    bind_primitives(mesh);
    mesh.def_static(
        "from_trimesh",
        [](const py::object& other) {
            const py::object read =
                py::module_::import("cubecam.io.meshes.from_trimesh").attr("_from_trimesh");
            return read(other).cast<std::shared_ptr<Mesh>>();
        },
        py::arg("mesh"), docs::from_trimesh);
    mesh.def(
        "resized",
        [](const Mesh& self, double size) {
            const py::gil_scoped_release release;
            return std::make_shared<Mesh>(self.data()->centered_and_scaled(size));
        },
        py::arg("size"), docs::resized);

    mesh.def(
        "flat_shaded",
        [](const Mesh& self) {
            const py::gil_scoped_release release;
            return std::make_shared<Mesh>(MeshData(*self.flat_shaded(self.data())));
        },
        docs::flat_shaded);
    mesh.def(
        "with_tangents",
        [](const Mesh& self, const WholeNumber& uv_set) {
            const int set = static_cast<int>(to_int(uv_set, "uv_set", 0, 1));
            const py::gil_scoped_release release;
            const auto data = self.data();
            expect(data->uvs(set) != nullptr, set == 0 ? "a mesh with uvs" : "a mesh with uvs1",
                   "none");
            return std::make_shared<Mesh>(MeshData(*self.with_tangents(data, set, false)));
        },
        py::kw_only(), py::arg("uv_set") = 0, docs::with_tangents);
    mesh.def("update", &update_mesh, py::kw_only(), py::arg("positions") = py::none(),
             py::arg("normals") = py::none(), py::arg("uvs") = py::none(),
             py::arg("colors") = py::none(), py::arg("uvs1") = py::none(),
             py::arg("tangents") = py::none(), docs::update);
    bind_vertices(mesh);
    mesh.def_property_readonly(
        "bounds", [](const Mesh& self) { return bounds_array(self.data()->bounds()); },
        "ndarray (2, 3) float64: the least and the greatest x, y, z of the vertices.");

    mesh.def("__repr__", &represent);
    mesh.def("__reduce__", [](const py::object& self) {
        py::dict arguments = attributes_of(self, "positions", "indices", "normals", "uvs", "colors",
                                           "uvs1", "tangents");
        // Smooth normals are computed again, so that those of the copy follow its positions, too.
        if (self.cast<const Mesh&>().data()->smooth()) arguments["normals"] = py::none();
        return reduced(self, arguments);
    });
}
