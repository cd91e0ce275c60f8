/// Nodes, from Python's arguments and to pickles and back.
#pragma once

#include "cube_source.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/scene/node.hpp"

#include <pybind11/pybind11.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam::bindings {

inline std::shared_ptr<Mesh> to_mesh(py::handle value) {
    return to_shared_or_none<Mesh>(
        value, "mesh", "a Mesh (see cubecam.load_mesh), a Light, a Camera, an Animation or None");
}

inline std::shared_ptr<Material> to_material(py::handle value) {
    return to_shared_or_none<Material>(value, "material", "a Material or None");
}

using Variants = std::vector<std::pair<std::string, std::shared_ptr<Material>>>;

/// The materials of variants: a dict of Materials by name.
inline Variants to_variants(py::handle value) {
    constexpr const char* expected = "a dict of Materials by the names of variants";
    if (!py::isinstance<py::dict>(value)) refuse(value, "variants", expected);
    Variants variants;
    for (const auto& [name, material] : py::reinterpret_borrow<py::dict>(value)) {
        if (!py::isinstance<py::str>(name)) refuse(name, "variants", expected);
        variants.emplace_back(name.cast<std::string>(),
                              to_shared<Material>(material, "variants", expected));
    }
    return variants;
}

inline py::dict from_variants(const Variants& variants) {
    py::dict made;
    for (const auto& [name, material] : variants) made[py::str(name)] = material;
    return made;
}

inline std::shared_ptr<Skin> to_skin(py::handle value) {
    return to_shared_or_none<Skin>(value, "skin", "a Skin or None");
}

inline std::vector<float> to_weights(py::handle value) {
    return to_vector(float_array(value, "weights", "(T,)"));
}

/// A weight for each morph target of the node's mesh, read-only.
inline py::array_t<float> weights_array(const NodeValue& value) {
    const std::size_t targets = value.mesh ? value.mesh->data()->target_count() : 0;
    py::array_t<float> array(static_cast<py::ssize_t>(targets));
    for (std::size_t i = 0; i < targets; ++i) {
        array.mutable_data()[i] = i < value.weights.size() ? value.weights[i] : 0.0F;
    }
    array.attr("flags").attr("writeable") = false;
    return array;
}

inline std::int32_t to_render_order(py::handle value) {
    return static_cast<std::int32_t>(to_int(value, "render_order",
                                            std::numeric_limits<std::int32_t>::min(),
                                            std::numeric_limits<std::int32_t>::max()));
}

inline std::int32_t to_label(py::handle value) {
    return static_cast<std::int32_t>(to_int(value, "label",
                                            std::numeric_limits<std::int32_t>::min(),
                                            std::numeric_limits<std::int32_t>::max()));
}

/// The place of a node from the arguments of scene.add or from a pickle: a matrix, or any of
/// position, rotation and scale.
inline Placing to_placing(py::handle position, py::handle rotation, py::handle scale,
                          py::handle matrix) {
    if (!matrix.is_none()) {
        if (!position.is_none() || !rotation.is_none() || !scale.is_none()) {
            throw py::value_error(
                "matrix: expected either a matrix or position, rotation and scale, got both");
        }
        return to_mat4(matrix, "matrix");
    }
    Transform transform;
    if (!position.is_none()) transform.position = to_point(position, "position");
    if (!rotation.is_none())
        transform.rotation = to_rotation(rotation, "rotation", ", or matrix= in its place");
    if (!scale.is_none()) transform.scale = to_scale(scale, "scale");
    return transform;
}

/// The state of a node in a pickle: (mesh, material, position, rotation, scale, matrix,
/// environment, visible, in_captures, name, render_order, cast_shadow, receive_shadow, label, skin,
/// weights, a dict of the materials of variants and what belongs to them).
inline py::tuple state_of_node(const NodeValue& value) {
    const auto* parts = std::get_if<Transform>(&value.placing);
    py::dict more;
    if (!value.variants.empty()) more["variants"] = from_variants(value.variants);
    if (value.own_material) more["own_material"] = *value.own_material;
    return py::make_tuple(
        value.mesh, value.material, parts ? py::object(point_array(parts->position)) : py::none(),
        parts ? py::object(quaternion_array(parts->rotation)) : py::none(),
        parts ? py::object(point_array(parts->scale)) : py::none(),
        parts ? py::none() : py::object(matrix_array(std::get<glm::dmat4>(value.placing))),
        from_cube_source(value.environment), value.visible, value.in_captures, value.name,
        value.render_order, value.cast_shadow, value.receive_shadow, value.label, value.skin,
        weights_array(value), more);
}

/// Sets what the last entry of a node's state holds.
inline void set_more(NodeValue& value, const py::dict& more) {
    if (more.contains("variants")) value.variants = to_variants(more["variants"]);
    if (more.contains("own_material")) value.own_material = to_material(more["own_material"]);
}

/// Older pickles of the same format have no label, or none of what follows it.
inline NodeValue node_from_state(const py::tuple& state) {
    NodeValue value{to_placing(state[2], state[3], state[4], state[5]),
                    to_mesh(state[0]),
                    to_material(state[1]),
                    to_environment_source(state[6], "environment"),
                    state[7].cast<bool>(),
                    state[8].cast<bool>(),
                    state[9].cast<std::string>(),
                    to_render_order(state[10]),
                    state[11].cast<bool>(),
                    state[12].cast<bool>(),
                    state.size() > 13 ? to_label(state[13]) : 0,
                    state.size() > 14 ? to_skin(state[14]) : nullptr,
                    state.size() > 15 ? to_weights(state[15]) : std::vector<float>()};
    if (state.size() > 16) set_more(value, state[16]);
    return value;
}

}  // namespace cubecam::bindings
