/// The target of `look_at`, from Python.
#pragma once

#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/scene/node.hpp"

#include <glm/glm.hpp>

namespace cubecam::bindings {

using LookTarget = OneOf<Node, ArrayLike>;

/// A point of the world; a node stands for its origin.
inline glm::dvec3 to_look_target(py::handle value) {
    if (!py::isinstance<Node>(value)) return to_point(value, "target");
    return {py::cast<const Node&>(value).world_matrix()[3]};
}

}  // namespace cubecam::bindings
