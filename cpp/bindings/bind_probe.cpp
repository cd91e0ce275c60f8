// cubecam.Probe
#include "bounds.hpp"
#include "docs/probe.hpp"
#include "formats.hpp"
#include "node_list.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/core/parse_name.hpp"
#include "cubecam/scene/node.hpp"
#include "cubecam/scene/probe.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

constexpr NameTable<ProbeUpdate, 3> update_names{{{"on_change", ProbeUpdate::on_change},
                                                  {"once", ProbeUpdate::once},
                                                  {"manual", ProbeUpdate::manual}}};

using ParallaxName = Choice<parallax_names>;
using Fetches = NumberChoice<parallax_fetches>;

using InfluenceShapeName = Choice<influence_shape_names>;

using UpdateLike = OneOf<Choice<update_names>, WholeNumber>;
using UpdateNow = OneOf<Choice<update_names>, int>;

void set_update(ProbeValue& value, py::handle update) {
    constexpr const char* expected = "'on_change', 'once', 'manual' or a number of frames";
    if (py::isinstance<py::str>(update)) {
        const auto name = update.cast<std::string>();
        value.every = 1;
        const std::size_t place = place_of_name(update_names, name);
        if (place == update_names.size()) {
            throw py::value_error(std::string("update: expected ") + expected + ", got '" +
                                  shortened(name) + "'");
        }
        value.update = update_names[place].second;
        return;
    }
    if (!whole_number(update)) refuse(update, "update", expected);
    value.every = static_cast<int>(to_int(update, "update", 1, std::numeric_limits<int>::max()));
    value.update = ProbeUpdate::every_n_frames;
}

py::object update_of(const ProbeValue& value) {
    if (value.update == ProbeUpdate::every_n_frames) return py::int_(value.every);
    const std::string_view name = update_names[static_cast<std::size_t>(value.update)].first;
    return py::str(name.data(), name.size());
}

Parallax to_parallax(const ParallaxName& name) {
    return parse_name("parallax", name, parallax_names);
}

InfluenceShape to_influence_shape(const InfluenceShapeName& name) {
    return parse_name("influence_shape", name, influence_shape_names);
}

std::optional<Bounds> to_box(const OrNone<ArrayLike>& box, const char* name = "box") {
    if (box.is_none()) return std::nullopt;
    return to_bounds(box, name);
}

std::optional<glm::dmat4> to_proxy_matrix(const OrNone<ArrayLike>& matrix) {
    if (matrix.is_none()) return std::nullopt;
    return to_mat4(matrix, "proxy_matrix");
}

std::shared_ptr<Probe>
make_probe(const ArrayLike& position, Int size, Real near, Real far, const FormatName& format,
           Flag mipmaps, Int samples, const UpdateLike& update, const Nodes& exclude,
           const OrNone<Node>& parent, Int faces_per_frame, const DepthFormatName& depth_format,
           Argument<std::optional<bool>> prefilter, const ParallaxName& parallax,
           const OrNone<ArrayLike>& box, const OrNone<ArrayLike>& proxy_matrix, Fetches fetches,
           Int bounces, const OrNone<ArrayLike>& influence,
           const InfluenceShapeName& influence_shape, Real blend_distance) {
    ProbeValue value;
    value.position = to_point(position, "position");
    value.parent = to_shared_or_none<Node>(parent, "parent", "a Node or None");
    value.size = size;
    value.near = near;
    value.far = far;
    value.format = parse_format(format);
    value.mipmaps = mipmaps;
    value.samples = samples;
    set_update(value, update);
    value.faces_per_frame = faces_per_frame;
    value.exclude = to_nodes(exclude, "exclude");
    value.depth_format = to_depth_format(depth_format);
    value.prefilter = value_of(prefilter);
    value.parallax.method = to_parallax(parallax);
    value.parallax.box = to_box(box);
    value.parallax.proxy_matrix = to_proxy_matrix(proxy_matrix);
    value.parallax.fetches = fetches;
    value.bounces = bounces;
    value.influence.box = to_box(influence, "influence");
    value.influence.shape = to_influence_shape(influence_shape);
    value.influence.blend_distance = blend_distance;
    return std::make_shared<Probe>(std::move(value));
}

template <class Field>
void field(Class<Probe>& probe, const char* name, Field ProbeValue::* member, const char* doc) {
    probe.def_property(
        name, [member](const Probe& self) { return self.value().*member; },
        [member](Probe& self, Argument<Field> value) {
            self.edit([&](ProbeValue& next) { next.*member = value_of(value); });
        },
        doc);
}

using DoublesOrNone = OneOf<py::array_t<double>, py::none>;

void bind_parallax(Class<Probe>& probe) {
    probe.def_property(
        "parallax",
        [](const Probe& self) -> ParallaxName { return to_string(self.value().parallax.method); },
        [](Probe& self, const ParallaxName& value) {
            const Parallax method = to_parallax(value);
            self.edit([&](ProbeValue& next) { next.parallax.method = method; });
        },
        "str: \"none\", \"box\", \"sphere\", \"distance\" or \"layers\".");
    probe.def_property(
        "box",
        [](const Probe& self) -> DoublesOrNone {
            const auto box = self.value().parallax.box;
            return box ? py::object(bounds_array(*box)) : py::none();
        },
        [](Probe& self, const OrNone<ArrayLike>& value) {
            const auto box = to_box(value);
            self.edit([&](ProbeValue& next) { next.parallax.box = box; });
        },
        "ndarray (2, 3) float64 or None: the low and the high corner of the proxy, in the world or "
        "in the space of `proxy_matrix`; read-only.");
    probe.def_property(
        "proxy_matrix",
        [](const Probe& self) -> DoublesOrNone {
            const auto matrix = self.value().parallax.proxy_matrix;
            return matrix ? py::object(matrix_array(*matrix)) : py::none();
        },
        [](Probe& self, const OrNone<ArrayLike>& value) {
            const auto matrix = to_proxy_matrix(value);
            self.edit([&](ProbeValue& next) { next.parallax.proxy_matrix = matrix; });
        },
        "ndarray (4, 4) float64 or None: from the space of `box` to the world; read-only.");
    probe.def_property(
        "fetches", [](const Probe& self) -> Fetches { return self.value().parallax.fetches; },
        [](Probe& self, Fetches value) {
            self.edit([&](ProbeValue& next) { next.parallax.fetches = value; });
        },
        "int: 6, 14 or 35 lookups of distance for a ray, at most.");
}

void bind_influence(Class<Probe>& probe) {
    probe.def_property(
        "influence",
        [](const Probe& self) -> DoublesOrNone {
            const auto box = self.value().influence.box;
            return box ? py::object(bounds_array(*box)) : py::none();
        },
        [](Probe& self, const OrNone<ArrayLike>& value) {
            const auto box = to_box(value, "influence");
            self.edit([&](ProbeValue& next) { next.influence.box = box; });
        },
        "ndarray (2, 3) float64 or None: where the probe counts fully in a `ProbeBlend`, the low "
        "and the high corner, in the world or in the space of `proxy_matrix`; None: everywhere; "
        "read-only.");
    probe.def_property(
        "influence_shape",
        [](const Probe& self) -> InfluenceShapeName {
            return to_string(self.value().influence.shape);
        },
        [](Probe& self, const InfluenceShapeName& value) {
            const InfluenceShape shape = to_influence_shape(value);
            self.edit([&](ProbeValue& next) { next.influence.shape = shape; });
        },
        "str: \"box\", or \"sphere\": the ellipsoid that `influence` encloses.");
    probe.def_property(
        "blend_distance", [](const Probe& self) { return self.value().influence.blend_distance; },
        [](Probe& self, Real value) {
            self.edit([&](ProbeValue& next) { next.influence.blend_distance = value; });
        },
        "float: how far outside of `influence` the probe ceases to count, world units.");
}

void bind_links(Class<Probe>& probe) {
    probe.def_property(
        "parent", [](const Probe& self) { return or_none(self.value().parent.lock()); },
        [](Probe& self, const OrNone<Node>& value) {
            const auto parent = to_shared_or_none<Node>(value, "parent", "a Node or None");
            self.edit([&](ProbeValue& next) { next.parent = parent; });
        },
        "Node or None: the node that the probe moves with.");
    probe.def_property(
        "exclude",
        [](const Probe& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return from_nodes(self.value().exclude);
        },
        [](Probe& self, const Nodes& value) {
            const auto nodes = to_nodes(value, "exclude");
            self.edit([&](ProbeValue& next) { next.exclude = nodes; });
        },
        "tuple of Node: nodes that the probe leaves out with all nodes below them, besides the "
        "nodes that use it.");
}

}  // namespace

}  // namespace cubecam::bindings

void bind_probe(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto probe = declared<Probe>();
    probe.attr("__doc__") = docs::probe;
    probe.def(py::init(&make_probe), py::arg("position") = py::make_tuple(0, 0, 0), py::kw_only(),
              py::arg("size") = 256, py::arg("near") = 0.05, py::arg("far") = 1000.0,
              py::arg("format") = "rgba16f", py::arg("mipmaps") = false, py::arg("samples") = 1,
              py::arg("update") = "on_change", py::arg("exclude") = py::tuple(),
              py::arg("parent") = py::none(), py::arg("faces_per_frame") = 6,
              py::arg("depth_format") = "depth_component32f", py::arg("prefilter") = py::none(),
              py::arg("parallax") = "none", py::arg("box") = py::none(),
              py::arg("proxy_matrix") = py::none(), py::arg("fetches") = 14, py::arg("bounces") = 1,
              py::arg("influence") = py::none(), py::arg("influence_shape") = "box",
              py::arg("blend_distance") = 1.0);

    probe.def_property(
        "position", [](const Probe& self) { return point_array(self.value().position); },
        [](Probe& self, const ArrayLike& value) {
            const glm::dvec3 position = to_point(value, "position");
            self.edit([&](ProbeValue& next) { next.position = position; });
        },
        "ndarray (3,) float64: world space, or relative to the parent's position; read-only.");
    field(probe, "size", &ProbeValue::size, "int: texels along an edge of a face.");
    field(probe, "near", &ProbeValue::near, "float: the near clip distance, world units.");
    field(probe, "far", &ProbeValue::far, "float: the far clip distance, world units.");
    probe.def_property(
        "format", [](const Probe& self) -> FormatName { return to_string(self.value().format); },
        [](Probe& self, const FormatName& value) {
            const Format format = parse_format(value);
            self.edit([&](ProbeValue& next) { next.format = format; });
        },
        "str: \"rgba8\", \"rgba16f\", \"rgba32f\" or \"rgb565\".");
    probe.def_property(
        "depth_format",
        [](const Probe& self) { return from_depth_format(self.value().depth_format); },
        [](Probe& self, const DepthFormatName& value) {
            const DepthFormat format = to_depth_format(value);
            self.edit([&](ProbeValue& next) { next.depth_format = format; });
        },
        "str or None: the format of the depth and stencil buffer, see `Renderer.render`.");
    field(probe, "mipmaps", &ProbeValue::mipmaps, "bool: whether lookups are trilinear.");
    field(probe, "samples", &ProbeValue::samples, "int: samples of each texel (MSAA); 1 is none.");
    probe.def_property(
        "update", [](const Probe& self) -> UpdateNow { return update_of(self.value()); },
        [](Probe& self, const UpdateLike& value) {
            ProbeValue given;
            set_update(given, value);
            self.edit([&](ProbeValue& next) {
                next.update = given.update;
                next.every = given.every;
            });
        },
        "str or int: \"on_change\", \"once\", \"manual\", or n: every n-th call.");
    field(probe, "faces_per_frame", &ProbeValue::faces_per_frame,
          "int: the greatest number of faces that one call draws, from 1 to 6.");
    field(
        probe, "prefilter", &ProbeValue::prefilter,
        "bool or None: whether the probe is filtered by roughness; None: if a drawn surface needs "
        "it.");
    field(probe, "bounces", &ProbeValue::bounces,
          "int: how many mirrors of a circle of probes that see each other a path meets, from 1 to "
          "16.");
    bind_parallax(probe);
    bind_influence(probe);
    bind_links(probe);

    probe.def("__repr__", [](const Probe& self) {
        const ProbeValue value = self.value();
        const auto parent = value.parent.lock();
        return "Probe(position=" + tuple_text(value.position) +
               (parent ? ", parent=node " + std::to_string(parent->id()) : std::string()) +
               ", size=" + std::to_string(value.size) + ", format='" +
               std::string(to_string(value.format)) + "'" +
               ", update=" + py::repr(update_of(value)).cast<std::string>() +
               (value.parallax.method == Parallax::none
                    ? std::string()
                    : ", parallax='" + std::string(to_string(value.parallax.method)) + "'") +
               (value.bounces == 1 ? "" : ", bounces=" + std::to_string(value.bounces)) + ")";
    });
    // Nodes go into the state, which is pickled later, since a node may use the probe itself.
    probe.def("__reduce__", [](const py::object& self) {
        return reduced(self,
                       attributes_of(self, "position", "size", "near", "far", "format", "mipmaps",
                                     "samples", "update", "faces_per_frame", "depth_format",
                                     "prefilter", "parallax", "box", "proxy_matrix", "fetches",
                                     "bounces", "influence", "influence_shape", "blend_distance"),
                       py::make_tuple(self.attr("parent"), self.attr("exclude")));
    });
    def_setstate(probe, "tuple", [](const py::object& self, const py::tuple& state) {
        self.attr("parent") = state[0];
        self.attr("exclude") = state[1];
    });
}
