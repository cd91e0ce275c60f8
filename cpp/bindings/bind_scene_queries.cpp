// What cubecam.Scene says about its nodes: iteration, names and bounds.
#include "bounds.hpp"
#include "docs/scene_queries.hpp"
#include "near_names.hpp"
#include "node_state.hpp"
#include "objects.hpp"

#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cubecam::bindings {

namespace {

using NodeList = std::vector<std::shared_ptr<Node>>;

NodeList named(const Scene& scene, const std::string& name) {
    return scene.find([&](std::int32_t, const NodeValue& node) { return node.name == name; });
}

NodeList find_nodes(const Scene& scene, const OneOf<py::str, py::none>& name,
                    const OneOf<WholeNumber, py::none>& label) {
    if (name.is_none() && label.is_none()) {
        throw py::type_error("Scene.find: expected a name or a label, got neither");
    }
    std::optional<std::string> wanted;
    if (!name.is_none()) {
        if (!py::isinstance<py::str>(name)) refuse(name, "name", "a str or None");
        wanted = name.cast<std::string>();
    }
    std::optional<std::int32_t> number;
    if (!label.is_none()) number = to_label(label);
    return scene.find([&](std::int32_t, const NodeValue& node) {
        return (!wanted || node.name == *wanted) && (!number || node.label == *number);
    });
}

[[noreturn]] void refuse_name(const Scene& scene, const std::string& name) {
    std::set<std::string> names;
    for (const auto& node : scene.nodes()) names.insert(node->value().name);
    names.erase("");
    throw py::key_error("expected the name of a node of the scene, got " +
                        with_near_names(name, names));
}

std::shared_ptr<Node> get_item(const Scene& scene, const OneOf<py::str>& name) {
    if (!py::isinstance<py::str>(name)) refuse(name, "name", "the name of a node (a str)");
    const auto wanted = name.cast<std::string>();
    const NodeList found = named(scene, wanted);
    if (found.empty()) refuse_name(scene, wanted);
    return found.front();
}

bool contains_thing(const Scene& scene, py::handle thing) {
    if (py::isinstance<Node>(thing)) return scene.contains(thing.cast<const Node&>());
    if (py::isinstance<py::str>(thing)) return !named(scene, thing.cast<std::string>()).empty();
    if (py::isinstance<Camera>(thing)) return scene.contains(thing.cast<const Camera&>());
    if (py::isinstance<Animation>(thing)) return scene.contains(thing.cast<const Animation&>());
    return py::isinstance<Light>(thing) && scene.contains(thing.cast<const Light&>());
}

}  // namespace

}  // namespace cubecam::bindings

void bind_scene_queries(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto scene = declared<Scene>();
    scene.def(
        "__iter__",
        [](const Scene& self) -> py::typing::Iterator<Node> {
            return py::iter(py::cast(self.nodes()));
        },
        "Iterate over all nodes, in order of id, as they are at this moment.");
    scene.def(
        "__len__", [](const Scene& self) { return self.nodes().size(); }, "The number of nodes.");
    scene.def(
        "__bool__", [](const Scene&) { return true; },
        "True, also for a scene without nodes, so that ``scene or other`` is the scene.");
    scene.def(
        "__contains__", &contains_thing, py::arg("thing"),
        "Whether a node, a light, a camera, an animation or a node of a name is in the scene.");
    scene.def("__getitem__", &get_item, py::arg("name"), docs::get_item);
    scene.def("find", &find_nodes, py::arg("name") = py::none(), py::kw_only(),
              py::arg("label") = py::none(), docs::find);
    scene.def_property_readonly(
        "bounds", [](const Scene& self) { return bounds_array(self.bounds()); },
        docs::scene_bounds);
}
