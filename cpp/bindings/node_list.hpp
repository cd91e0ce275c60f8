/// Lists of nodes that do not keep the nodes alive, from Python and back.
#pragma once

#include "objects.hpp"

#include "cubecam/scene/node.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <pybind11/pybind11.h>

#include <memory>

namespace cubecam::bindings {

using Nodes = OneOf<py::typing::Iterable<Node>>;

inline WeakNodes to_nodes(py::handle nodes, const char* name) {
    if (py::isinstance<Node>(nodes) || !py::isinstance<py::iterable>(nodes)) {
        refuse(nodes, name, "a sequence of Nodes");
    }
    WeakNodes weak;
    for (const py::handle node : py::iter(nodes)) {
        weak.push_back(to_shared<Node>(node, name, "Nodes"));
    }
    return weak;
}

/// A tuple of the nodes that are still alive.
inline py::tuple from_nodes(const WeakNodes& nodes) {
    py::list alive;
    for (const auto& weak : nodes) {
        if (const auto node = weak.lock()) alive.append(node);
    }
    return py::tuple(alive);
}

}  // namespace cubecam::bindings
