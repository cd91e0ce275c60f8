// cubecam.MorphTarget and cubecam.Skin
#include "docs/skin.hpp"
#include "node_list.hpp"
#include "values.hpp"
#include "vectors.hpp"
#include "vertices.hpp"

#include "cubecam/geometry/morph_target.hpp"
#include "cubecam/scene/skin.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

/// Displacements of colours; those without alpha leave it as it is.
std::vector<glm::vec4> to_color_displacements(py::handle colors) {
    const py::array given = to_array(colors, "colors");
    const py::ssize_t channels = given.ndim() == 2 ? given.shape(1) : 0;
    if (channels == 4) return to_vectors<glm::vec4>(float_array(given, "colors", "(V, 4)"));
    if (channels != 3) {
        throw py::value_error("colors: expected shape (V, 3) or (V, 4), got " + shape_text(given));
    }
    std::vector<glm::vec4> wide;
    for (const glm::vec3& color : to_vectors<glm::vec3>(float_array(given, "colors", "(V, 3)"))) {
        wide.emplace_back(color, 0.0F);
    }
    return wide;
}

std::shared_ptr<MorphTarget>
make_target(const OrNone<ArrayLike>& positions, const OrNone<ArrayLike>& normals,
            const OrNone<ArrayLike>& tangents, const OrNone<ArrayLike>& uvs,
            const OrNone<ArrayLike>& colors, const OrNone<ArrayLike>& uvs1, const Text& name) {
    MorphTarget::Arrays arrays;
    if (!positions.is_none()) {
        arrays.positions = to_vectors<glm::vec3>(float_array(positions, "positions", "(V, 3)"));
    }
    if (!normals.is_none()) {
        arrays.normals = to_vectors<glm::vec3>(float_array(normals, "normals", "(V, 3)"));
    }
    if (!tangents.is_none()) {
        arrays.tangents = to_vectors<glm::vec3>(float_array(tangents, "tangents", "(V, 3)"));
    }
    if (!uvs.is_none()) arrays.uvs = to_vectors<glm::vec2>(float_array(uvs, "uvs", "(V, 2)"));
    if (!colors.is_none()) arrays.colors = to_color_displacements(colors);
    if (!uvs1.is_none()) arrays.uvs1 = to_vectors<glm::vec2>(float_array(uvs1, "uvs1", "(V, 2)"));
    return std::make_shared<MorphTarget>(std::move(arrays), name);
}

void bind_morph_target(py::module_& module) {
    auto target = declare<MorphTarget>(module, "MorphTarget", docs::morph_target);
    target.def(py::init(&make_target), py::kw_only(), py::arg("positions") = py::none(),
               py::arg("normals") = py::none(), py::arg("tangents") = py::none(),
               py::arg("uvs") = py::none(), py::arg("colors") = py::none(),
               py::arg("uvs1") = py::none(), py::arg("name") = "");
    const auto array = [&target](const char* name, auto get, const char* doc) {
        target.def_property_readonly(
            name,
            [get](const MorphTarget& self) -> FloatRowsOrNone {
                return rows<float>((self.*get)());
            },
            doc);
    };
    array("positions", &MorphTarget::positions,
          "ndarray (V, 3) float32 or None: added to the positions; a read-only view.");
    array("normals", &MorphTarget::normals,
          "ndarray (V, 3) float32 or None: added to the normals; a read-only view.");
    array("tangents", &MorphTarget::tangents,
          "ndarray (V, 3) float32 or None: added to the tangents; a read-only view.");
    array("uvs", &MorphTarget::uvs,
          "ndarray (V, 2) float32 or None: added to the texture coordinates; a read-only view.");
    array("colors", &MorphTarget::colors,
          "ndarray (V, 4) float32 or None: added to the colours; a read-only view.");
    array("uvs1", &MorphTarget::uvs1,
          "ndarray (V, 2) float32 or None: added to the second texture coordinates; a read-only "
          "view.");
    target.def_property_readonly("name", &MorphTarget::name, "str: a name for people.");
    target.def("__repr__", [](const MorphTarget& self) {
        const std::string name =
            self.name().empty() ? "" : py::repr(py::str(self.name())).cast<std::string>() + ", ";
        return "MorphTarget(" + name + std::to_string(self.vertices()) + " vertices)";
    });
    target.def("__reduce__", [](const py::object& self) {
        return reduced(self, attributes_of(self, "positions", "normals", "tangents", "uvs",
                                           "colors", "uvs1", "name"));
    });
}

using Joints = OneOf<py::typing::Iterable<OrNone<Node>>>;

WeakNodes to_joints(py::handle joints) {
    constexpr const char* expected = "Nodes, or None for a node that is gone";
    if (py::isinstance<Node>(joints) || !py::isinstance<py::iterable>(joints)) {
        refuse(joints, "joints", "a sequence of Nodes");
    }
    WeakNodes weak;
    for (const py::handle joint : py::iter(joints)) {
        weak.push_back(to_shared_or_none<Node>(joint, "joints", expected));
    }
    return weak;
}

std::vector<glm::dmat4> to_matrices(const ContiguousArray<double>& given) {
    std::vector<glm::dmat4> matrices(static_cast<std::size_t>(given.shape(0)));
    const double* from = given.data();
    for (glm::dmat4& matrix : matrices) {
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) matrix[column][row] = *from++;
        }
    }
    return matrices;
}

std::shared_ptr<Skin> make_skin(const Joints& joints, const OrNone<ArrayLike>& matrices,
                                const OrNone<Node>& skeleton) {
    WeakNodes nodes = to_joints(joints);
    std::vector<glm::dmat4> inverse_bind;
    if (!matrices.is_none()) {
        inverse_bind = to_matrices(double_array(matrices, "inverse_bind_matrices",
                                                "(" + std::to_string(nodes.size()) + ", 4, 4)"));
    }
    return std::make_shared<Skin>(std::move(nodes), std::move(inverse_bind),
                                  to_shared_or_none<Node>(skeleton, "skeleton", "a Node or None"));
}

py::array_t<double> inverse_bind_of(const Skin& skin) {
    const auto& matrices = skin.inverse_bind();
    py::array_t<double> array(
        {static_cast<py::ssize_t>(matrices.size()), py::ssize_t{4}, py::ssize_t{4}});
    double* to = array.mutable_data();
    for (const glm::dmat4& matrix : matrices) {
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) *to++ = matrix[column][row];
        }
    }
    array.attr("flags").attr("writeable") = false;
    return array;
}

void bind_skin_class(py::module_& module) {
    auto skin = declare<Skin>(module, "Skin", docs::skin);
    skin.def(py::init(&make_skin), py::arg("joints"), py::arg("inverse_bind_matrices") = py::none(),
             py::kw_only(), py::arg("skeleton") = py::none());
    skin.def_property_readonly(
        "joints",
        [](const Skin& self) -> py::typing::Tuple<OrNone<Node>, py::ellipsis> {
            py::list joints;
            for (const auto& weak : self.joints()) joints.append(or_none(weak.lock()));
            return py::tuple(joints);
        },
        "tuple of Node or None: the nodes that `Mesh.joints` counts from 0; None for a node that "
        "is "
        "gone.");
    skin.def_property_readonly("inverse_bind_matrices", &inverse_bind_of,
                               "ndarray (J, 4, 4) float64: for each joint the matrix from the "
                               "mesh's space to that of the joint; read-only.");
    skin.def_property_readonly(
        "skeleton", [](const Skin& self) { return or_none(self.skeleton()); },
        "Node or None: the node above all joints; no picture depends on it.");
    skin.def("__repr__", [](const Skin& self) {
        const std::size_t joints = self.joints().size();
        return "Skin(" + std::to_string(joints) + (joints == 1 ? " joint)" : " joints)");
    });
    skin.def("__reduce__", [](const py::object& self) {
        return reduced(self, attributes_of(self, "joints", "inverse_bind_matrices", "skeleton"));
    });
}

}  // namespace

}  // namespace cubecam::bindings

void bind_skin(pybind11::module_& module) {
    cubecam::bindings::bind_morph_target(module);
    cubecam::bindings::bind_skin_class(module);
}
