// cubecam.Mesh
#include "bounds.hpp"
#include "docs/mesh.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "unlocked.hpp"
#include "values.hpp"
#include "vectors.hpp"
#include "vertices.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/geometry/primitives.hpp"
#include "cubecam/geometry/simplify.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

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

using TargetsLike = OneOf<py::typing::Iterable<MorphTarget>>;

/// The shape "(V, 4 k)".
void check_influence_shape(const py::array& array, const char* name, std::size_t vertices) {
    if (array.ndim() == 2 && array.shape(0) == static_cast<py::ssize_t>(vertices) &&
        array.shape(1) > 0 && array.shape(1) % 4 == 0) {
        return;
    }
    throw py::value_error(std::string(name) + ": expected shape (" + std::to_string(vertices) +
                          ", 4 k), got " + shape_text(array));
}

/// Joints with weights; both are given or neither.
std::shared_ptr<const Influences> to_influences(py::handle joints, py::handle weights,
                                                std::size_t vertices) {
    if (joints.is_none() && weights.is_none()) return nullptr;
    if (joints.is_none() || weights.is_none()) {
        throw py::value_error("joints: expected joints and joint_weights together, got only " +
                              std::string(joints.is_none() ? "joint_weights" : "joints"));
    }
    const py::array given = to_array(joints, "joints");
    check_influence_shape(given, "joints", vertices);
    const std::string shape =
        "(" + std::to_string(vertices) + ", " + std::to_string(given.shape(1)) + ")";
    const auto numbers = index_array(given, "joints", shape, std::uint64_t{1} << 16);
    const auto shares = float_array(weights, "joint_weights", shape);
    return std::make_shared<const Influences>(
        static_cast<std::size_t>(given.shape(1)),
        std::vector<std::uint16_t>(numbers.data(), numbers.data() + numbers.size()),
        to_vector(shares));
}

MorphTargets to_targets(py::handle targets) {
    if (py::isinstance<MorphTarget>(targets) || !py::isinstance<py::iterable>(targets)) {
        refuse(targets, "morph_targets", "a sequence of MorphTargets");
    }
    MorphTargets found;
    for (const py::handle target : py::iter(targets)) {
        found.push_back(to_shared<MorphTarget>(target, "morph_targets", "MorphTargets"));
    }
    return found;
}

using LevelsLike = OneOf<
    py::typing::Iterable<py::typing::Tuple<ArrayLike, py::typing::Union<py::int_, py::float_>>>>;
using Levels =
    py::typing::Tuple<py::typing::Tuple<py::array_t<std::uint32_t>, py::float_>, py::ellipsis>;

std::vector<MeshLevel> to_levels(py::handle levels, std::size_t vertices) {
    constexpr const char* wanted = "a sequence of pairs (indices, error)";
    if (py::isinstance<py::str>(levels) || !py::isinstance<py::iterable>(levels)) {
        refuse(levels, "levels", wanted);
    }
    std::vector<MeshLevel> found;
    for (const py::handle level : py::iter(levels)) {
        const bool pair = (py::isinstance<py::tuple>(level) || py::isinstance<py::list>(level)) &&
                          py::len(level) == 2;
        if (!pair) refuse(level, "levels", wanted);
        const py::object indices = level[py::int_(0)];
        const py::object error = level[py::int_(1)];
        const auto number = real_number(error);
        if (!number) refuse(error, "levels", "an error as float in each pair");
        found.push_back(
            {to_vectors<glm::uvec3>(index_array(indices, "levels", "(F, 3)", vertices)), *number});
    }
    return found;
}

Levels levels_of(const Mesh& mesh) {
    py::list list;
    if (const auto levels = mesh.data()->levels()) {
        for (const DrawnLevel& level : *levels) {
            list.append(py::make_tuple(rows<std::uint32_t>(level.triangles), level.error));
        }
    }
    return py::tuple(list);
}

/// The mesh with simplified levels; what joints and morph targets move has none.
std::shared_ptr<Mesh> with_levels(const Mesh& mesh, double ratio) {
    const Unlocked unlocked;
    const auto data = mesh.data();
    auto made = std::make_shared<Mesh>(MeshData(*data));
    MeshUpdate update;
    update.levels = simplified_levels(*data, ratio);
    made->update(std::move(update));
    return made;
}

std::shared_ptr<Mesh> make_mesh(const ArrayLike& positions, const ArrayLike& indices,
                                const OrNone<ArrayLike>& normals, const OrNone<ArrayLike>& uvs,
                                const OrNone<ArrayLike>& colors, const OrNone<ArrayLike>& uvs1,
                                const OrNone<ArrayLike>& tangents, const OrNone<ArrayLike>& joints,
                                const OrNone<ArrayLike>& joint_weights,
                                const TargetsLike& morph_targets, const LevelsLike& levels) {
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
    arrays.influences = to_influences(joints, joint_weights, arrays.positions.size());
    arrays.targets = to_targets(morph_targets);
    arrays.levels = to_levels(levels, arrays.positions.size());
    const Unlocked unlocked;
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
    const Unlocked unlocked;
    mesh.update(std::move(update));
}

template <class Scalar>
py::object influence_rows(const std::shared_ptr<const Influences>& owner,
                          const std::vector<Scalar>& values) {
    return readonly_view(
        py::dtype::of<Scalar>(),
        {static_cast<py::ssize_t>(owner->vertices()), static_cast<py::ssize_t>(owner->count())},
        values.data(), owner);
}

py::object joints_of(const Mesh& mesh) {
    const auto influences = mesh.data()->influences();
    if (!influences) return py::none();
    return influence_rows(influences, influences->joints());
}

py::object joint_weights_of(const Mesh& mesh) {
    const auto influences = mesh.data()->influences();
    if (!influences) return py::none();
    return influence_rows(influences, influences->weights());
}

void update_mesh(Mesh& self, const OrNone<ArrayLike>& positions, const OrNone<ArrayLike>& normals,
                 const OrNone<ArrayLike>& uvs, const OrNone<ArrayLike>& colors,
                 const OrNone<ArrayLike>& uvs1, const OrNone<ArrayLike>& tangents,
                 const OrNone<ArrayLike>& joints, const OrNone<ArrayLike>& joint_weights,
                 const OneOf<py::typing::Iterable<MorphTarget>, py::none>& morph_targets) {
    MeshUpdate update;
    if (!positions.is_none()) update.positions = new_positions(self, positions);
    if (!normals.is_none()) update.normals = new_normals(self, normals);
    if (!uvs.is_none()) update.uvs = new_uvs(self, uvs, "uvs");
    if (!colors.is_none()) update.colors = to_vertex_colors(colors, vertices_of(self));
    if (!uvs1.is_none()) update.uvs1 = new_uvs(self, uvs1, "uvs1");
    if (!tangents.is_none()) update.tangents = new_tangents(self, tangents);
    if (!joints.is_none() || !joint_weights.is_none()) {
        const py::object numbers = joints.is_none() ? joints_of(self) : py::object(joints);
        const py::object shares =
            joint_weights.is_none() ? joint_weights_of(self) : py::object(joint_weights);
        update.influences = to_influences(numbers, shares, vertices_of(self));
    }
    if (!morph_targets.is_none()) update.targets = to_targets(morph_targets);
    apply(self, std::move(update));
}

std::string represent(const Mesh& mesh) {
    const auto data = mesh.data();
    const std::size_t levels = data->levels() ? data->levels()->size() : 0;
    return "Mesh(" + std::to_string(data->positions()->size()) + " vertices, " +
           std::to_string(data->triangles()->size()) + " triangles" +
           (levels == 0 ? ""
                        : ", " + std::to_string(levels) + (levels == 1 ? " level" : " levels")) +
           ")";
}

/// A function that builds a mesh without the GIL, since a mesh of many triangles takes a while.
template <class... Args>
auto built_by(MeshData (*build)(Args...)) {
    return [build](Argument<Args>... args) {
        const Unlocked unlocked;
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
        [](Real length, Argument<std::optional<double>> radius,
           Argument<std::optional<double>> head_length, Argument<std::optional<double>> head_radius,
           Int segments) {
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
    mesh.def_property_readonly(
        "joints",
        [](const Mesh& self) -> OrNone<py::array_t<std::uint16_t>> { return joints_of(self); },
        docs::joints);
    mesh.def_property_readonly(
        "joint_weights", [](const Mesh& self) -> FloatRowsOrNone { return joint_weights_of(self); },
        docs::joint_weights);
    mesh.def_property(
        "morph_targets",
        [](const Mesh& self) -> py::typing::Tuple<MorphTarget, py::ellipsis> {
            const auto targets = self.data()->targets();
            py::list list;
            if (!targets) return py::tuple(list);
            for (const auto& target : *targets) {
                list.append(std::const_pointer_cast<MorphTarget>(target));
            }
            return py::tuple(list);
        },
        [](Mesh& self, const TargetsLike& value) {
            MeshUpdate update;
            update.targets = to_targets(value);
            apply(self, std::move(update));
        },
        docs::morph_targets);
    mesh.def_property(
        "levels", &levels_of,
        [](Mesh& self, const LevelsLike& value) {
            MeshUpdate update;
            update.levels = to_levels(value, vertices_of(self));
            apply(self, std::move(update));
        },
        docs::levels);
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
             py::arg("tangents") = py::none(), py::arg("joints") = py::none(),
             py::arg("joint_weights") = py::none(), py::arg("morph_targets") = py::tuple(),
             py::arg("levels") = py::tuple());
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
        [](const Mesh& self, Real size) {
            const Unlocked unlocked;
            return std::make_shared<Mesh>(self.data()->centered_and_scaled(size));
        },
        py::arg("size"), docs::resized);

    mesh.def(
        "flat_shaded",
        [](const Mesh& self) {
            const Unlocked unlocked;
            const auto data = self.data();
            return std::make_shared<Mesh>(MeshData(*self.flat_shaded(data)).with_targets_of(*data));
        },
        docs::flat_shaded);
    mesh.def(
        "with_tangents",
        [](const Mesh& self, const WholeNumber& uv_set) {
            const int set = static_cast<int>(to_int(uv_set, "uv_set", 0, 1));
            const Unlocked unlocked;
            const auto data = self.data();
            expect(data->uvs(set) != nullptr, set == 0 ? "a mesh with uvs" : "a mesh with uvs1",
                   "none");
            return std::make_shared<Mesh>(
                MeshData(*self.with_tangents(data, set, false)).with_targets_of(*data));
        },
        py::kw_only(), py::arg("uv_set") = 0, docs::with_tangents);
    mesh.def(
        "with_levels", [](const Mesh& self, Real ratio) { return with_levels(self, ratio); },
        py::kw_only(), py::arg("ratio") = 0.5, docs::with_levels);
    mesh.def("update", &update_mesh, py::kw_only(), py::arg("positions") = py::none(),
             py::arg("normals") = py::none(), py::arg("uvs") = py::none(),
             py::arg("colors") = py::none(), py::arg("uvs1") = py::none(),
             py::arg("tangents") = py::none(), py::arg("joints") = py::none(),
             py::arg("joint_weights") = py::none(), py::arg("morph_targets") = py::none(),
             docs::update);
    bind_vertices(mesh);
    mesh.def_property_readonly(
        "bounds", [](const Mesh& self) { return bounds_array(self.data()->bounds()); },
        "ndarray (2, 3) float64: the least and the greatest x, y, z of the vertices.");

    mesh.def("__repr__", &represent);
    mesh.def("__reduce__", [](const py::object& self) {
        py::dict arguments =
            attributes_of(self, "positions", "indices", "normals", "uvs", "colors", "uvs1",
                          "tangents", "joints", "joint_weights", "morph_targets", "levels");
        // Smooth normals are computed again, so that those of the copy follow its positions, too.
        if (self.cast<const Mesh&>().data()->smooth()) arguments["normals"] = py::none();
        return reduced(self, arguments);
    });
}
