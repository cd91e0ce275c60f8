// cubecam.Node and cubecam.axis_angle
#include "bounds.hpp"
#include "docs/node.hpp"
#include "look_target.hpp"
#include "node_state.hpp"
#include "values.hpp"

#include "cubecam/math/transform.hpp"
#include "cubecam/scene/node.hpp"
#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace cubecam::bindings {

namespace {

py::array_t<double> axis_angle(const ArrayLike& axis, Real degrees) {
    const glm::dvec3 direction = to_point(axis, "axis");
    const double length = glm::length(direction);
    expect(length > 0.0 && std::isfinite(length), "an axis of some length", describe(direction));
    expect_finite(degrees, "angle in degrees");
    // The half angle is brought within -180 to 180 degrees, so that large angles stay exact.
    const double half = 0.5 * radians(std::remainder(degrees, 720.0));
    const glm::dvec3 v = direction / length * std::sin(half);
    py::array_t<double> result(4);
    double* to = result.mutable_data();
    to[0] = std::cos(half);
    for (int i = 0; i < 3; ++i) to[i + 1] = v[i];
    return result;
}

glm::dvec3 position_of(const Placing& placing) {
    const auto* matrix = std::get_if<glm::dmat4>(&placing);
    return matrix ? glm::dvec3((*matrix)[3]) : std::get<Transform>(placing).position;
}

/// The nodes above a node, from the root to its parent. When they are pickled in this order, each
/// finds its own parent in pickle's memo, so that a long chain needs no deep recursion.
std::vector<std::shared_ptr<Node>> ancestors(const Node& node) {
    std::vector<std::shared_ptr<Node>> chain;
    for (auto above = node.parent(); above; above = above->parent()) chain.push_back(above);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

void bind_placing(Class<Node>& node) {
    node.def_property(
        "position", [](const Node& self) { return point_array(position_of(self.value().placing)); },
        [](Node& self, const ArrayLike& value) {
            const glm::dvec3 position = to_point(value, "position");
            self.edit_placing([&](Placing& next) { set_position(next, position); });
        },
        "ndarray (3,) float64: relative to the parent, read-only.");
    node.def_property(
        "rotation",
        [](const Node& self) {
            return quaternion_array(transform_of(self.value().placing).rotation);
        },
        [](Node& self, const ArrayLike& value) {
            const glm::dquat rotation = to_rotation(value, "rotation", ", or matrix= in its place");
            self.edit_placing([&](Placing& next) {
                Transform transform = transform_of(next);
                transform.rotation = rotation;
                next = transform;
            });
        },
        "ndarray (4,) float64: unit quaternion (w, x, y, z), read-only; see `axis_angle`.");
    node.def_property(
        "scale",
        [](const Node& self) { return point_array(transform_of(self.value().placing).scale); },
        [](Node& self, const OneOf<py::float_, ArrayLike>& value) {
            const glm::dvec3 scale = to_scale(value, "scale");
            self.edit_placing([&](Placing& next) {
                Transform transform = transform_of(next);
                transform.scale = scale;
                next = transform;
            });
        },
        "ndarray (3,) float64: along the node's own axes, read-only; one number sets all three.");
    node.def_property(
        "matrix", [](const Node& self) { return matrix_array(matrix_of(self.value().placing)); },
        [](Node& self, const ArrayLike& value) {
            const glm::dmat4 matrix = to_mat4(value, "matrix");
            self.edit_placing([&](Placing& next) { next = matrix; });
        },
        "ndarray (4, 4) float64: node to parent, read-only. Setting it replaces position, rotation"
        " and scale; it must not be singular, and its last row is (0, 0, 0, 1).");
    node.def_property_readonly(
        "world_matrix", [](const Node& self) { return matrix_array(self.world_matrix()); },
        "ndarray (4, 4) float64: node to world, read-only.");
    node.def_property_readonly(
        "world_bounds", [](const Node& self) { return bounds_array(self.world_bounds()); },
        docs::world_bounds);
    node.def(
        "look_at",
        [](Node& self, const LookTarget& target, const ArrayLike& up) {
            self.look_at(to_look_target(target), to_point(up, "up"));
        },
        py::arg("target"), py::kw_only(), py::arg("up") = py::make_tuple(0, 1, 0), docs::look_at);
}

void bind_contents(Class<Node>& node) {
    node.def_property_readonly("id", &Node::id,
                               "int: from 1 in order of add, never used again in the scene; the "
                               "output id is 0 where the background is.");
    node.def_property(
        "name", [](const Node& self) { return self.value().name; },
        [](Node& self, const Text& value) {
            self.edit([&](NodeValue& next) { next.name = value; });
        },
        "str: a name for people; need not be unique.");
    node.def_property(
        "mesh", [](const Node& self) { return or_none(self.value().mesh); },
        [](Node& self, const OrNone<Mesh>& value) {
            const auto mesh = to_mesh(value);
            self.edit([&](NodeValue& next) { next.mesh = mesh; });
        },
        "Mesh or None: the shape; a node without a mesh is a group.");
    node.def_property(
        "material", [](const Node& self) { return or_none(self.value().material); },
        [](Node& self, const OrNone<Material>& value) {
            const auto material = to_material(value);
            self.edit([&](NodeValue& next) {
                next.material = material;
                next.own_material.reset();
            });
        },
        "Material or None: the surface; on a node with a mesh, None becomes a new PhongMaterial. A "
        "material that is set becomes the node's own, also while the scene shows a variant.");
    node.def_property_readonly(
        "own_material",
        [](const Node& self) {
            const NodeValue value = self.value();
            return or_none(value.own_material.value_or(value.material));
        },
        "Material or None: the `material` that the node has while the scene shows no variant.");
    node.def_property(
        "variants",
        [](const Node& self) -> py::typing::Dict<py::str, Material> {
            return from_variants(self.value().variants);
        },
        [](Node& self, const OneOf<py::typing::Dict<py::str, Material>>& value) {
            self.set_variants(to_variants(value));
        },
        docs::node_variants);
    node.def_property(
        "skin", [](const Node& self) { return or_none(self.value().skin); },
        [](Node& self, const OrNone<Skin>& value) {
            const auto skin = to_skin(value);
            self.edit([&](NodeValue& next) { next.skin = skin; });
        },
        docs::node_skin);
    node.def_property(
        "weights", [](const Node& self) { return weights_array(self.value()); },
        [](Node& self, const ArrayLike& value) {
            const auto weights = to_weights(value);
            self.edit([&](NodeValue& next) { next.weights = weights; });
        },
        docs::node_weights);
    node.def_property(
        "environment",
        [](const Node& self) -> EnvironmentLike {
            return from_cube_source(self.value().environment);
        },
        [](Node& self, const EnvironmentLike& value) {
            const CubeSource environment = to_environment_source(value, "environment");
            self.edit([&](NodeValue& next) { next.environment = environment; });
        },
        "CubeMap, Probe, ProbeBlend, PlanarMirror or None: what mirrors and glass show. None: the "
        "scene's environment.");
    node.def_property(
        "visible", [](const Node& self) { return self.value().visible; },
        [](Node& self, Flag value) { self.edit([&](NodeValue& next) { next.visible = value; }); },
        "bool: False: no picture shows the node or any node below it.");
    node.def_property(
        "in_captures", [](const Node& self) { return self.value().in_captures; },
        [](Node& self, Flag value) {
            self.edit([&](NodeValue& next) { next.in_captures = value; });
        },
        "bool: False: captures, probes and planar mirrors show neither the node nor any node below "
        "it. Frames do, "
        "and "
        "the node still shows its own probe there.");
    node.def_property(
        "render_order", [](const Node& self) { return self.value().render_order; },
        [](Node& self, const WholeNumber& value) {
            const std::int32_t order = to_render_order(value);
            self.edit([&](NodeValue& next) { next.render_order = order; });
        },
        "int: nodes of lower order are drawn first, before any distance counts, among opaque and "
        "among "
        "translucent nodes; 0 by default. Nodes below this one have an order of their own.");
    node.def_property(
        "cast_shadow", [](const Node& self) { return self.value().cast_shadow; },
        [](Node& self, Flag value) {
            self.edit([&](NodeValue& next) { next.cast_shadow = value; });
        },
        "bool: False: neither the node nor any node below it casts shadows. Translucent nodes "
        "never do.");
    node.def_property(
        "receive_shadow", [](const Node& self) { return self.value().receive_shadow; },
        [](Node& self, Flag value) {
            self.edit([&](NodeValue& next) { next.receive_shadow = value; });
        },
        "bool: whether shadows show on the node's own surface.");
    node.def_property(
        "label", [](const Node& self) { return self.value().label; },
        [](Node& self, const WholeNumber& value) {
            const std::int32_t label = to_label(value);
            self.edit([&](NodeValue& next) { next.label = label; });
        },
        "int: a number of your own, such as a class or an instance, that the output label shows: "
        "any of 32 bits, 0 by default (as the background). Nodes may share a label; nodes below "
        "this one have labels of their own.");
}

}  // namespace

}  // namespace cubecam::bindings

void bind_node(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    module.def("axis_angle", &axis_angle, py::arg("axis"), py::arg("degrees"), docs::axis_angle)
        .attr("axis_angle")
        .attr("__module__") = "cubecam";

    auto node = declared<Node>();
    node.attr("__doc__") = docs::node;
    bind_contents(node);
    bind_placing(node);
    node.def_property(
        "parent", [](const Node& self) { return or_none(self.parent()); },
        [](Node& self, const OrNone<Node>& value) {
            self.set_parent(to_shared_or_none<Node>(value, "parent", "a Node or None"));
        },
        "Node or None: the node that this one moves with. Setting it keeps position, rotation and "
        "scale, "
        "which are relative to the parent; a cycle raises ValueError.");
    node.def_property_readonly(
        "children",
        [](const Node& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return py::tuple(py::cast(self.children()));
        },
        "tuple of Node: in order of id.");
    node.def("__repr__", [](const Node& self) {
        const NodeValue value = self.value();
        const glm::dvec3 position = position_of(value.placing);
        return "Node(id=" + std::to_string(self.id()) +
               (value.name.empty()
                    ? std::string()
                    : ", name=" + py::repr(py::str(value.name)).cast<std::string>()) +
               (value.mesh ? "" : ", group") + ", position=" + tuple_text(position) + ")";
    });

    // A node of a scene is that scene's node of its id: so a pickle is no deeper for many nodes
    // that lead to each other by their probes. One in no scene takes those above it along.
    node.def("__reduce__", [](const std::shared_ptr<Node>& self) -> py::tuple {
        const py::object call = py::module_::import("operator").attr("methodcaller");
        if (const auto scene = self->scene()) {
            return py::make_tuple(call("_restore", self->id()), py::make_tuple(scene));
        }
        return py::make_tuple(
            call("_loose", self->id()), py::make_tuple(py::type::of<Scene>()),
            closed_state(py::make_tuple(state_of_node(self->value()), ancestors(*self))));
    });
    def_setstate(node, "tuple", [](Node& self, const py::tuple& state) {
        const NodeValue value = node_from_state(state[0]);
        self.edit([&](NodeValue& next) { next = value; });
        const auto above = state[1].cast<std::vector<std::shared_ptr<Node>>>();
        if (!above.empty()) self.set_parent(above.back());
    });
}
