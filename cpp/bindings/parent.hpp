/// Parents of lights and cameras, from Python, to texts and to pickles.
#pragma once

#include "objects.hpp"

#include "cubecam/scene/node.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>

namespace cubecam::bindings {

inline std::shared_ptr<Node> to_parent(const OrNone<Node>& value) {
    return to_shared_or_none<Node>(value, "parent", "a Node or None");
}

inline std::string parent_text(const std::weak_ptr<Node>& parent) {
    const auto node = parent.lock();
    return node ? ", parent=node " + std::to_string(node->id()) : std::string();
}

/// The result of `__reduce__`. A parent goes into the state, which is pickled later, since its
/// scene may hold the object itself.
inline py::tuple reduced_with_parent(py::handle self, py::object args) {
    py::object parent = self.attr("parent");
    if (parent.is_none()) return reduced(self, std::move(args));
    return reduced(self, std::move(args), py::make_tuple(parent));
}

inline void set_parent_state(const py::object& self, const py::tuple& state) {
    self.attr("parent") = state[0];
}

}  // namespace cubecam::bindings
