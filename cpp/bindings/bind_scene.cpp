// cubecam.Scene
#include "docs/scene.hpp"
#include "near_names.hpp"
#include "node_list.hpp"
#include "node_state.hpp"
#include "values.hpp"

#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using BackgroundLike = OneOf<py::str, ArrayLike, CubeMap, py::none>;

std::shared_ptr<ProbeGrid> to_probe_grid(py::handle value) {
    return to_shared_or_none<ProbeGrid>(value, "probe_grid", "a ProbeGrid or None");
}

std::shared_ptr<CubeMap> to_environment(py::handle value) {
    return to_shared_or_none<CubeMap>(value, "environment",
                                      "a CubeMap (see cubecam.load_environment) or None");
}

Background to_background(py::handle value) {
    if (value.is_none()) return {};
    if (py::isinstance<CubeMap>(value)) return py::cast<std::shared_ptr<CubeMap>>(value);
    // A str is a sequence, too: the name of a colour. So is a Scene.
    if (!py::isinstance<py::sequence>(value) || py::isinstance<Scene>(value)) {
        refuse(value, "background", "a colour, a CubeMap or None");
    }
    return to_rgba(value, "background");
}

using BackgroundNow = OneOf<py::array_t<float>, CubeMap, py::none>;

BackgroundNow from_background(const Background& background) {
    if (const auto* color = std::get_if<glm::vec4>(&background)) return color_array(*color);
    if (const auto* cube = std::get_if<std::shared_ptr<CubeMap>>(&background)) {
        return py::cast(*cube);
    }
    return py::none();
}

std::shared_ptr<Node> add_node(Scene& scene, const OrNone<Mesh>& mesh,
                               const OrNone<Material>& material, const OrNone<ArrayLike>& position,
                               const OrNone<ArrayLike>& rotation,
                               const OneOf<py::float_, ArrayLike, py::none>& scale,
                               const OrNone<ArrayLike>& matrix, const OrNone<Node>& parent,
                               const EnvironmentLike& environment, Flag visible, Flag in_captures,
                               const Text& name, const WholeNumber& render_order, Flag cast_shadow,
                               Flag receive_shadow, const WholeNumber& label,
                               const OrNone<Skin>& skin, const OrNone<ArrayLike>& weights) {
    NodeValue value{{},
                    to_mesh(mesh),
                    to_material(material),
                    to_environment_source(environment, "environment"),
                    visible,
                    in_captures,
                    name,
                    to_render_order(render_order),
                    cast_shadow,
                    receive_shadow,
                    to_label(label),
                    to_skin(skin),
                    weights.is_none() ? std::vector<float>() : to_weights(weights)};
    value.placing = to_placing(position, rotation, scale, matrix);
    value.render_order = to_render_order(render_order);
    return scene.add(std::move(value), to_shared_or_none<Node>(parent, "parent", "a Node or None"));
}

void remove_thing(Scene& scene, const OneOf<Node, Light, Camera, Animation>& thing) {
    if (py::isinstance<Light>(thing)) {
        scene.remove(py::cast<std::shared_ptr<Light>>(thing));
    } else if (py::isinstance<Camera>(thing)) {
        scene.remove(py::cast<std::shared_ptr<Camera>>(thing));
    } else if (py::isinstance<Animation>(thing)) {
        scene.remove(py::cast<std::shared_ptr<Animation>>(thing));
    } else {
        scene.remove(to_shared<Node>(thing, "node", "a Node, a Light, a Camera or an Animation"));
    }
}

/// The animation that an index, a name or the animation itself means.
std::shared_ptr<Animation> to_animation(const Scene& scene, py::handle value) {
    constexpr const char* expected = "an index, a name or an Animation";
    if (py::isinstance<Animation>(value)) return value.cast<std::shared_ptr<Animation>>();
    const auto known = scene.animations();
    if (py::isinstance<py::str>(value)) {
        const auto name = value.cast<std::string>();
        std::set<std::string> names;
        for (const auto& animation : known) {
            if (!name.empty() && animation->name() == name) return animation;
            names.insert(animation->name());
        }
        names.erase("");
        throw py::key_error("animation: expected the name of an animation of the scene, got " +
                            with_near_names(name, names));
    }
    if (!whole_number(value)) refuse(value, "animation", expected);
    const std::int64_t index = to_int(value, "animation");
    const auto count = static_cast<std::int64_t>(known.size());
    if (index >= count || index < -count) {
        throw py::index_error("animation: expected an index of the scene's " +
                              std::to_string(count) + (count == 1 ? " animation" : " animations") +
                              ", got " + std::to_string(index));
    }
    return known[static_cast<std::size_t>(index < 0 ? index + count : index)];
}

std::vector<std::string> to_names(py::handle value) {
    constexpr const char* expected = "a sequence of names";
    if (py::isinstance<py::str>(value) || !py::isinstance<py::iterable>(value)) {
        refuse(value, "variants", expected);
    }
    std::vector<std::string> names;
    for (const py::handle name : py::iter(value)) {
        if (!py::isinstance<py::str>(name)) refuse(name, "variants", expected);
        names.push_back(name.cast<std::string>());
    }
    return names;
}

void set_variant(Scene& scene, const Argument<std::optional<std::string>>& given) {
    const std::optional<std::string> name = given;
    const auto known = scene.variants();
    const std::set<std::string> names(known.begin(), known.end());
    if (name && !names.contains(*name)) {
        throw py::value_error("variant: expected a variant of the scene or None, got " +
                              with_near_names(*name, names));
    }
    scene.set_variant(name);
}

/// Adds something and returns it.
template <class Thing>
std::shared_ptr<Thing> add_thing(Scene& scene, const std::shared_ptr<Thing>& thing) {
    scene.add(thing);
    return thing;
}

std::vector<std::shared_ptr<Node>> to_node_list(const Nodes& value) {
    if (py::isinstance<Node>(value) || !py::isinstance<py::iterable>(value)) {
        refuse(value, "nodes", "a sequence of Nodes");
    }
    std::vector<std::shared_ptr<Node>> nodes;
    for (const py::handle item : py::iter(value))
        nodes.push_back(to_shared<Node>(item, "nodes", "Nodes"));
    return nodes;
}

void set_positions(Scene& scene, const Nodes& nodes, const ArrayLike& positions) {
    const auto placed = to_node_list(nodes);
    const auto rows =
        double_array(positions, "positions", "(" + std::to_string(placed.size()) + ", 3)");
    const double* from = rows.data();
    scene.place(placed, [from](std::size_t i, Placing& placing) {
        const double* row = from + 3 * i;
        set_position(placing, glm::dvec3(row[0], row[1], row[2]));
    });
}

void set_matrices(Scene& scene, const Nodes& nodes, const ArrayLike& matrices) {
    const auto placed = to_node_list(nodes);
    const auto given =
        double_array(matrices, "matrices", "(" + std::to_string(placed.size()) + ", 4, 4)");
    const double* from = given.data();
    scene.place(placed, [from](std::size_t i, Placing& placing) {
        glm::dmat4 matrix;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column)
                matrix[column][row] = from[16 * i + static_cast<std::size_t>(4 * row + column)];
        }
        placing = matrix;
    });
}

py::dict state_of(const Scene& scene) {
    py::list nodes;
    for (const auto& node : scene.nodes()) {
        const auto parent = node->parent();
        nodes.append(
            py::make_tuple(node->id(), parent ? parent->id() : 0, state_of_node(node->value())));
    }
    py::dict state;
    state["environment"] = scene.environment();
    state["background"] = from_background(scene.background());
    const EnvironmentPlacing placing = scene.environment_placing();
    state["environment_intensity"] = placing.intensity;
    state["environment_rotation"] = quaternion_array(placing.rotation);
    state["probe_grid"] = scene.probe_grid();
    state["lights"] = py::list(py::cast(scene.lights()));
    state["cameras"] = py::list(py::cast(scene.cameras()));
    state["animations"] = py::list(py::cast(scene.animations()));
    state["variants"] = scene.variants();
    state["variant"] = scene.variant();
    state["nodes"] = nodes;
    state["next_id"] = scene.next_id();
    return state;
}

/// Unpickling may have restored some nodes already, without their values, because other objects in
/// the pickle refer to them.
void set_state(Scene& scene, const py::dict& state) {
    scene.set_environment(to_environment(state["environment"]));
    scene.set_background(to_background(state["background"]));
    if (state.contains("environment_intensity")) {  // older pickles have none
        scene.set_environment_intensity(state["environment_intensity"].cast<float>());
        scene.set_environment_rotation(
            to_rotation(state["environment_rotation"], "environment_rotation"));
    }
    if (state.contains("probe_grid")) scene.set_probe_grid(to_probe_grid(state["probe_grid"]));
    for (const py::handle light : state["lights"]) {
        scene.add(to_shared<Light>(light, "lights", "Lights"));
    }
    if (state.contains("cameras")) {  // older pickles have none of these
        for (const py::handle camera : state["cameras"]) {
            scene.add(to_shared<Camera>(camera, "cameras", "Cameras"));
        }
        for (const py::handle animation : state["animations"]) {
            scene.add(to_shared<Animation>(animation, "animations", "Animations"));
        }
        // The nodes, which follow, already have the materials of the variant.
        scene.set_variants(to_names(state["variants"]));
        scene.set_variant(state["variant"].cast<std::optional<std::string>>());
    }
    for (const py::handle item : state["nodes"]) {
        const auto record = py::reinterpret_borrow<py::tuple>(item);
        const NodeValue value = node_from_state(record[2]);
        scene.restore(record[0].cast<std::int32_t>())->edit([&](NodeValue& next) { next = value; });
    }
    for (const py::handle item : state["nodes"]) {
        const auto record = py::reinterpret_borrow<py::tuple>(item);
        const auto parent = record[1].cast<std::int32_t>();
        if (parent == 0) continue;
        scene.restore(record[0].cast<std::int32_t>())->set_parent(scene.restore(parent));
    }
    scene.skip_ids(state["next_id"].cast<std::int32_t>());
}

void bind_parts(Class<Scene>& scene) {
    scene.def_property_readonly(
        "cameras",
        [](const Scene& self) -> py::typing::Tuple<Camera, py::ellipsis> {
            return py::tuple(py::cast(self.cameras()));
        },
        "tuple of Camera: all cameras of the scene, in order of add; no picture depends on them.");
    scene.def_property_readonly(
        "animations",
        [](const Scene& self) -> py::typing::Tuple<Animation, py::ellipsis> {
            return py::tuple(py::cast(self.animations()));
        },
        "tuple of Animation: all animations of the scene, in order of add.");
    scene.def(
        "set_time",
        [](const OneOf<Scene>& self, Real seconds,
           const OneOf<WholeNumber, py::str, Animation>& animation) {
            auto& changed = self.cast<Scene&>();
            changed.set_time(seconds, *to_animation(changed, animation));
            return self;
        },
        py::arg("seconds"), py::arg("animation") = 0, docs::set_time);
    scene.def_property(
        "variants",
        [](const Scene& self) -> py::typing::Tuple<py::str, py::ellipsis> {
            return py::tuple(py::cast(self.variants()));
        },
        [](Scene& self, const OneOf<py::typing::Iterable<py::str>>& value) {
            self.set_variants(to_names(value));
        },
        "tuple of str: the names of the variants that the scene can show. If the present one is "
        "not "
        "among the names that are set, `variant` becomes None.");
    scene.def_property("variant", &Scene::variant, &set_variant, docs::variant);
}

void bind_pickling(Class<Scene>& scene) {
    scene.def("__reduce__", [](const py::object& self) {
        return reduced(self, py::tuple(), state_of(self.cast<const Scene&>()));
    });
    def_setstate(scene, "dict", &set_state);
    scene.def("_restore", &Scene::restore, py::arg("id"), "For unpickling: the node with an id.");
    scene.def_static(
        "_loose", [](std::int32_t id) { return std::make_shared<Node>(id, NodeValue()); },
        py::arg("id"), "For unpickling: an empty node that is in no scene.");
}

}  // namespace

}  // namespace cubecam::bindings

void bind_scene(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto scene = declared<Scene>();
    scene.attr("__doc__") = docs::scene;
    scene.def(py::init([](const OrNone<CubeMap>& environment, const BackgroundLike& background,
                          Strict<float> environment_intensity,
                          const OrNone<ArrayLike>& environment_rotation) {
                  auto made = std::make_shared<Scene>(to_environment(environment),
                                                      to_background(background));
                  made->set_environment_intensity(environment_intensity);
                  if (!environment_rotation.is_none()) {
                      made->set_environment_rotation(
                          to_rotation(environment_rotation, "environment_rotation"));
                  }
                  return made;
              }),
              py::kw_only(), py::arg("environment") = py::none(),
              py::arg("background") = py::none(), py::arg("environment_intensity") = 1.0F,
              py::arg("environment_rotation") = py::none());
    scene.def_property(
        "environment", [](const Scene& self) { return or_none(self.environment()); },
        [](Scene& self, const OrNone<CubeMap>& value) {
            self.set_environment(to_environment(value));
        },
        "CubeMap or None: what mirrors and glass without an environment of their own show.");
    scene.def_property(
        "probe_grid", [](const Scene& self) { return or_none(self.probe_grid()); },
        [](Scene& self, const OrNone<ProbeGrid>& value) {
            self.set_probe_grid(to_probe_grid(value));
        },
        "ProbeGrid or None: the light that falls on `StandardMaterial` from all around in its box, "
        "in place of the environment's.");
    scene.def_property(
        "background", [](const Scene& self) { return from_background(self.background()); },
        [](Scene& self, const BackgroundLike& value) { self.set_background(to_background(value)); },
        "ndarray (4,) float32, CubeMap or None: what pictures show where no node is. None: the "
        "environment if there is one, else transparent black.");

    scene.def_property(
        "environment_intensity",
        [](const Scene& self) { return shortest(self.environment_placing().intensity); },
        [](Scene& self, Strict<float> value) { self.set_environment_intensity(value); },
        "float: the factor of the light of the scene's environment, at least 0.");
    scene.def_property(
        "environment_rotation",
        [](const Scene& self) { return quaternion_array(self.environment_placing().rotation); },
        [](Scene& self, const ArrayLike& value) {
            self.set_environment_rotation(to_rotation(value, "environment_rotation"));
        },
        "ndarray (4,) float64: unit quaternion (w, x, y, z) that turns the scene's environment; "
        "read-only.");

    scene.def("add", &add_thing<Light>, py::arg("light"), docs::add_light);
    scene.def("add", &add_thing<Camera>, py::arg("camera"), docs::add_camera);
    scene.def("add", &add_thing<Animation>, py::arg("animation"), docs::add_animation);
    scene.def("add", &add_node, py::arg("mesh") = py::none(), py::arg("material") = py::none(),
              py::kw_only(), py::arg("position") = py::none(), py::arg("rotation") = py::none(),
              py::arg("scale") = py::none(), py::arg("matrix") = py::none(),
              py::arg("parent") = py::none(), py::arg("environment") = py::none(),
              py::arg("visible") = true, py::arg("in_captures") = true, py::arg("name") = "",
              py::arg("render_order") = 0, py::arg("cast_shadow") = true,
              py::arg("receive_shadow") = true, py::arg("label") = 0, py::arg("skin") = py::none(),
              py::arg("weights") = py::none(), docs::add_node);
    scene.def("set_positions", &set_positions, py::arg("nodes"), py::arg("positions"),
              docs::set_positions);
    scene.def("set_matrices", &set_matrices, py::arg("nodes"), py::arg("matrices"),
              docs::set_matrices);
    scene.def("remove", &remove_thing, py::arg("thing"), docs::remove);
    scene.def("clear", &Scene::clear,
              "Remove all nodes, lights, cameras, animations and variants.");
    scene.def_property_readonly(
        "nodes",
        [](const Scene& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return py::tuple(py::cast(self.nodes()));
        },
        "tuple of Node: all nodes of the scene, in order of id.");
    scene.def_property_readonly(
        "lights",
        [](const Scene& self) -> py::typing::Tuple<Light, py::ellipsis> {
            return py::tuple(py::cast(self.lights()));
        },
        "tuple of Light: all lights of the scene, in order of add.");
    bind_parts(scene);
    scene.def("__repr__", [](const Scene& self) {
        const std::size_t nodes = self.nodes().size();
        const std::size_t lights = self.lights().size();
        return "Scene(" + std::to_string(nodes) + (nodes == 1 ? " node, " : " nodes, ") +
               std::to_string(lights) + (lights == 1 ? " light)" : " lights)");
    });
    bind_pickling(scene);
}
