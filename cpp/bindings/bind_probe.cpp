// cubecam.Probe
#include "formats.hpp"
#include "node_list.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "vectors.hpp"

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

constexpr const char* probe_doc = R"doc(A cubemap that keeps itself true to the scene.

It is only a description, and may serve any number of nodes: assign it to ``node.environment``, or
to a `BasicMaterial`'s cubemap. Each renderer holds contents of its own
(``renderer.read_probe(probe)``) and draws again only the faces that would come out different. Nodes
that use a probe are left out of it.

Parameters
----------
position : array_like (3,)
    World space; with a parent, from the parent's position.
size : int
    Texels along an edge of a face.
near, far : float
    World units: 0 < near < far.
format : {"rgba16f", "rgba8", "rgba32f", "rgb565"}
    What a texel is kept in. rgba8 and rgb565 clip light above 1.
mipmaps : bool
    Whether lookups are trilinear.
samples : int
    Samples of each texel, for smooth edges (MSAA); 1 is none.
update : {"on_change", "once", "manual"} or int
    "on_change": always true to the scene. "once": drawn when it is first needed. "manual": only
    by ``renderer.update_probes``. n: on every n-th call that needs it.
exclude : iterable of Node
    What it does not see, whole subtrees, beside the nodes that use it.
parent : Node, optional
    It goes where this node goes; its axes stay the world's. The probe does not keep it alive.
faces_per_frame : int
    At most so many faces are drawn in one call, from 1 to 6.
depth_format : str or None
    Its depth and stencil buffer, see `Renderer.render`.

Raises
------
ValueError
    For a number out of its range, near >= far, or another format or update.
TypeError
    For a parent or excluded things that are not nodes.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> ball = scene.add(cc.Mesh.sphere(.5), cc.MirrorMaterial(), position=(0, 1, 0))
>>> ball.environment = cc.Probe(parent=ball, size=128)
>>> ball.environment.update
'on_change'
)doc";

using UpdateLike = OneOf<py::str, py::int_>;

void set_update(ProbeValue& value, py::handle update) {
    constexpr const char* expected = "'on_change', 'once', 'manual' or a number of frames";
    if (py::isinstance<py::str>(update)) {
        const auto name = update.cast<std::string>();
        value.every = 1;
        if (name == "on_change") {
            value.update = ProbeUpdate::on_change;
        } else if (name == "once") {
            value.update = ProbeUpdate::once;
        } else if (name == "manual") {
            value.update = ProbeUpdate::manual;
        } else {
            throw py::value_error(std::string("update: expected ") + expected + ", got '" + name +
                                  "'");
        }
        return;
    }
    if (py::isinstance<py::bool_>(update) || !PyIndex_Check(update.ptr())) {
        refuse(update, "update", expected);
    }
    value.every = static_cast<int>(to_int(update, "update", 1, std::numeric_limits<int>::max()));
    value.update = ProbeUpdate::every_n_frames;
}

py::object update_of(const ProbeValue& value) {
    switch (value.update) {
        case ProbeUpdate::on_change: return py::str("on_change");
        case ProbeUpdate::once: return py::str("once");
        case ProbeUpdate::manual: return py::str("manual");
        case ProbeUpdate::every_n_frames: return py::int_(value.every);
    }
    return py::none();
}

std::shared_ptr<Probe> make_probe(const ArrayLike& position, int size, double near, double far,
                                  const std::string& format, bool mipmaps, int samples,
                                  const UpdateLike& update, const Nodes& exclude,
                                  const OrNone<Node>& parent, int faces_per_frame,
                                  const std::optional<std::string>& depth_format) {
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
    return std::make_shared<Probe>(std::move(value));
}

template <class Field>
void field(Class<Probe>& probe, const char* name, Field ProbeValue::* member, const char* doc) {
    probe.def_property(
        name, [member](const Probe& self) { return self.value().*member; },
        [member](Probe& self, Field value) {
            self.edit([&](ProbeValue& next) { next.*member = value; });
        },
        doc);
}

void bind_links(Class<Probe>& probe) {
    probe.def_property(
        "parent", [](const Probe& self) { return or_none(self.value().parent.lock()); },
        [](Probe& self, const OrNone<Node>& value) {
            const auto parent = to_shared_or_none<Node>(value, "parent", "a Node or None");
            self.edit([&](ProbeValue& next) { next.parent = parent; });
        },
        "Node or None: the node that it follows.");
    probe.def_property(
        "exclude",
        [](const Probe& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return from_nodes(self.value().exclude);
        },
        [](Probe& self, const Nodes& value) {
            const auto nodes = to_nodes(value, "exclude");
            self.edit([&](ProbeValue& next) { next.exclude = nodes; });
        },
        "tuple of Node: what it does not see, whole subtrees, beside the nodes that use it.");
}

}  // namespace

}  // namespace cubecam::bindings

void bind_probe(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto probe = declared<Probe>();
    probe.attr("__doc__") = probe_doc;
    probe.def(py::init(&make_probe), py::arg("position") = py::make_tuple(0, 0, 0), py::kw_only(),
              py::arg("size") = 256, py::arg("near") = 0.05, py::arg("far") = 1000.0,
              py::arg("format") = "rgba16f", py::arg("mipmaps") = false, py::arg("samples") = 1,
              py::arg("update") = "on_change", py::arg("exclude") = py::tuple(),
              py::arg("parent") = py::none(), py::arg("faces_per_frame") = 6,
              py::arg("depth_format") = "depth_component32f");

    probe.def_property(
        "position", [](const Probe& self) { return point_array(self.value().position); },
        [](Probe& self, const ArrayLike& value) {
            const glm::dvec3 position = to_point(value, "position");
            self.edit([&](ProbeValue& next) { next.position = position; });
        },
        "ndarray (3,) float64: world space, or from the parent's position; read-only.");
    field(probe, "size", &ProbeValue::size, "int: texels along an edge of a face.");
    field(probe, "near", &ProbeValue::near, "float: nothing nearer is seen; world units.");
    field(probe, "far", &ProbeValue::far, "float: nothing farther is seen; world units.");
    probe.def_property(
        "format", [](const Probe& self) { return std::string(to_string(self.value().format)); },
        [](Probe& self, const std::string& value) {
            const Format format = parse_format(value);
            self.edit([&](ProbeValue& next) { next.format = format; });
        },
        "str: \"rgba8\", \"rgba16f\", \"rgba32f\" or \"rgb565\".");
    probe.def_property(
        "depth_format",
        [](const Probe& self) { return from_depth_format(self.value().depth_format); },
        [](Probe& self, const std::optional<std::string>& value) {
            const DepthFormat format = to_depth_format(value);
            self.edit([&](ProbeValue& next) { next.depth_format = format; });
        },
        "str or None: its depth and stencil buffer, see `Renderer.render`.");
    field(probe, "mipmaps", &ProbeValue::mipmaps, "bool: whether lookups are trilinear.");
    field(probe, "samples", &ProbeValue::samples, "int: samples of each texel (MSAA); 1 is none.");
    probe.def_property(
        "update", [](const Probe& self) -> UpdateLike { return update_of(self.value()); },
        [](Probe& self, const UpdateLike& value) {
            ProbeValue given;
            set_update(given, value);
            self.edit([&](ProbeValue& next) {
                next.update = given.update;
                next.every = given.every;
            });
        },
        "str or int: \"on_change\", \"once\", \"manual\", or every how many calls.");
    field(probe, "faces_per_frame", &ProbeValue::faces_per_frame,
          "int: at most so many faces are drawn in one call.");
    bind_links(probe);

    probe.def("__repr__", [](const Probe& self) {
        const ProbeValue value = self.value();
        const auto parent = value.parent.lock();
        return "Probe(position=" + tuple_text(value.position) +
               (parent ? ", parent=node " + std::to_string(parent->id()) : std::string()) +
               ", size=" + std::to_string(value.size) + ", format='" +
               std::string(to_string(value.format)) + "'" +
               ", update=" + py::repr(update_of(value)).cast<std::string>() + ")";
    });
    // Nodes go into the state: they may use the probe themselves.
    probe.def("__reduce__", [](const py::object& self) {
        return reduced(self,
                       attributes_of(self, "position", "size", "near", "far", "format", "mipmaps",
                                     "samples", "update", "faces_per_frame", "depth_format"),
                       py::make_tuple(self.attr("parent"), self.attr("exclude")));
    });
    def_setstate(probe, "tuple", [](const py::object& self, const py::tuple& state) {
        self.attr("parent") = state[0];
        self.attr("exclude") = state[1];
    });
}
