// cubecam.Animation and cubecam.AnimationChannel
#include "choice.hpp"
#include "docs/animation.hpp"
#include "objects.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/scene/animation.hpp"
#include "cubecam/scene/node.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using PathName = Choice<animation_path_names>;
using InterpolationName = Choice<interpolation_names>;

std::string_view path_of(const AnimationChannel& channel) {
    return animation_path_names[static_cast<std::size_t>(channel.keys().path)].first;
}

std::string_view interpolation_of(const AnimationChannel& channel) {
    return interpolation_names[static_cast<std::size_t>(channel.keys().interpolation)].first;
}

/// A read-only array of the numbers, of rows of `width` numbers or flat for a width of 0.
py::array_t<double> rows_array(std::span<const double> numbers, std::size_t width) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(numbers.size())};
    if (width > 0) {
        shape = {static_cast<py::ssize_t>(numbers.size() / width), static_cast<py::ssize_t>(width)};
    }
    py::array_t<double> array(shape);
    std::ranges::copy(numbers, array.mutable_data());
    array.attr("flags").attr("writeable") = false;
    return array;
}

std::shared_ptr<AnimationChannel> make_channel(const OrNone<Node>& node, const PathName& path,
                                               const ArrayLike& times, const ArrayLike& values,
                                               const InterpolationName& interpolation) {
    Keys keys;
    keys.path = parse_name("path", path, animation_path_names);
    keys.interpolation = parse_name("interpolation", interpolation, interpolation_names);
    keys.times = to_vector(double_array(times, "times", "(K,)"));
    const auto rows = double_array(values, "values", "(K, n)");
    keys.values = to_vector(rows);
    keys.width = static_cast<std::size_t>(rows.shape(1));
    return std::make_shared<AnimationChannel>(to_shared_or_none<Node>(node, "node", "a Node"),
                                              std::move(keys));
}

AnimationChannels to_channels(py::handle value) {
    if (py::isinstance<AnimationChannel>(value) || py::isinstance<py::str>(value) ||
        !py::isinstance<py::iterable>(value)) {
        refuse(value, "channels", "a sequence of AnimationChannels");
    }
    AnimationChannels channels;
    for (const py::handle item : py::iter(value)) {
        channels.push_back(to_shared<AnimationChannel>(item, "channels", "AnimationChannels"));
    }
    return channels;
}

void bind_channel(py::module_& module) {
    auto channel = declare<AnimationChannel>(module, "AnimationChannel", docs::channel);
    channel.def(py::init([](const OneOf<Node>& node, const PathName& path, const ArrayLike& times,
                            const ArrayLike& values, const InterpolationName& interpolation) {
                    to_shared<Node>(node, "node", "a Node");
                    return make_channel(OrNone<Node>(node), path, times, values, interpolation);
                }),
                py::arg("node"), py::arg("path"), py::arg("times"), py::arg("values"),
                py::kw_only(), py::arg("interpolation") = "linear");
    channel.def_property_readonly(
        "node", [](const AnimationChannel& self) { return or_none(self.node()); },
        "Node or None: the node that moves; None once it no longer exists.");
    channel.def_property_readonly(
        "path", [](const AnimationChannel& self) -> PathName { return path_of(self); },
        "str: \"translation\", \"rotation\", \"scale\" or \"weights\".");
    channel.def_property_readonly(
        "times", [](const AnimationChannel& self) { return rows_array(self.keys().times, 0); },
        "ndarray (K,) float64: seconds, read-only.");
    channel.def_property_readonly(
        "values",
        [](const AnimationChannel& self) {
            return rows_array(self.keys().values, self.keys().width);
        },
        "ndarray (K, n) or (3K, n) float64: as they were given, read-only.");
    channel.def_property_readonly(
        "interpolation",
        [](const AnimationChannel& self) -> InterpolationName { return interpolation_of(self); },
        "str: \"step\", \"linear\" or \"cubic\".");
    channel.def(
        "sample",
        [](const AnimationChannel& self, Real seconds) {
            expect_finite(seconds, "seconds");
            std::vector<double> value(self.keys().width);
            sample(self.keys(), seconds, value);
            return rows_array(value, 0);
        },
        py::arg("seconds"), docs::sample);
    channel.def("__repr__", [](const AnimationChannel& self) {
        const auto node = self.node();
        const auto& times = self.keys().times;
        const std::size_t count = times.size();
        return "AnimationChannel(" + (node ? "node " + std::to_string(node->id()) : "no node") +
               ", '" + std::string(path_of(self)) + "', " + std::to_string(count) +
               (count == 1 ? " key, " : " keys, ") + describe(times.front()) + " to " +
               describe(times.back()) + " s, '" + std::string(interpolation_of(self)) + "')";
    });
    // The node goes into the state, which is pickled later, since its scene may hold the channel.
    channel.def("__reduce__", [](const py::object& self) {
        const py::object call = py::module_::import("operator").attr("methodcaller");
        return py::make_tuple(call("_remake", pickle_format, self.attr("path"), self.attr("times"),
                                   self.attr("values"), self.attr("interpolation")),
                              py::make_tuple(py::type::of<AnimationChannel>()),
                              closed_state(py::make_tuple(self.attr("node"))));
    });
    channel.def_static(
        "_remake",
        [](const WholeNumber& format, const PathName& path, const ArrayLike& times,
           const ArrayLike& values, const InterpolationName& interpolation) {
            check_pickle(format);
            return make_channel(py::none(), path, times, values, interpolation);
        },
        py::arg("format"), py::arg("path"), py::arg("times"), py::arg("values"),
        py::arg("interpolation"), "For unpickling: a channel without a node.");
    def_setstate(channel, "tuple", [](AnimationChannel& self, const py::tuple& state) {
        self.restore_node(to_shared_or_none<Node>(state[0], "node", "a Node"));
    });
}

}  // namespace

}  // namespace cubecam::bindings

void bind_animation(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    bind_channel(module);
    auto animation = declare<Animation>(module, "Animation", docs::animation);
    animation.def(py::init([](const OneOf<py::typing::Iterable<AnimationChannel>>& channels,
                              const Text& name) {
                      return std::make_shared<Animation>(to_channels(channels), name);
                  }),
                  py::arg("channels"), py::kw_only(), py::arg("name") = "");
    animation.def_property_readonly(
        "channels",
        [](const Animation& self) -> py::typing::Tuple<AnimationChannel, py::ellipsis> {
            return py::tuple(py::cast(self.channels()));
        },
        "tuple of AnimationChannel: in the order in which they were given.");
    animation.def_property_readonly("name", &Animation::name, "str: a name for people.");
    animation.def_property_readonly("duration", &Animation::duration,
                                    "float: the time of the last key of all channels, seconds.");
    animation.def("__repr__", [](const Animation& self) {
        const std::size_t count = self.channels().size();
        return "Animation(" +
               (self.name().empty()
                    ? std::string()
                    : "name=" + py::repr(py::str(self.name())).cast<std::string>() + ", ") +
               std::to_string(count) + (count == 1 ? " channel, " : " channels, ") +
               describe(self.duration()) + " s)";
    });
    animation.def("__reduce__", [](const py::object& self) {
        return reduced(self, attributes_of(self, "channels", "name"));
    });
}
