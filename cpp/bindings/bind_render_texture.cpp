// cubecam.RenderTexture
#include "docs/render_texture.hpp"
#include "effect_list.hpp"
#include "formats.hpp"
#include "node_list.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/cycle_collector.hpp"
#include "cubecam/scene/image_effect.hpp"
#include "cubecam/scene/render_texture.hpp"
#include "cubecam/scene/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using WrapName = Choice<wrap_names>;

std::shared_ptr<Scene> to_shown_scene(py::handle value) {
    return to_shared<Scene>(value, "scene", "a Scene");
}

std::shared_ptr<Camera> to_shown_camera(py::handle value) {
    return to_shared<Camera>(value, "camera", "a Camera");
}

/// Adds a new texture to the list of textures. When the list is twice as long as it was after the
/// last cleaning, textures that only cycles of references keep alive are freed.
void watch(const std::shared_ptr<RenderTexture>& texture) {
    static std::vector<std::weak_ptr<RenderTexture>> watched;  // under Python's lock
    static std::size_t enough = 16;
    const auto drop_dead = [] {
        std::erase_if(watched, [](const auto& weak) { return weak.expired(); });
    };
    if (watched.size() >= enough) {
        drop_dead();
        collect_cycles(watched);
        drop_dead();
        enough = std::max<std::size_t>(16, 2 * watched.size());
    }
    watched.push_back(texture);
}

std::shared_ptr<RenderTexture>
make_render_texture(const OneOf<Scene>& scene, const OneOf<Camera>& camera, const SizeLike& size,
                    const FormatName& format, const WholeNumber& samples, Flag mipmaps,
                    const WrapName& wrap, const Nodes& exclude, const Text& name,
                    const EffectsLike& effects, const DepthFormatName& depth_format) {
    RenderTextureValue value;
    value.scene = to_shown_scene(scene);
    value.camera = to_shown_camera(camera);
    std::tie(value.width, value.height) = to_size(size);
    value.format = parse_format(format);
    value.samples = to_int(samples, "samples");
    value.mipmaps = mipmaps;
    value.wrap = parse_wrap(wrap);
    value.exclude = to_nodes(exclude, "exclude");
    value.name = name;
    value.effects = to_effects(effects);
    value.depth_format = to_depth_format(depth_format);
    auto made = std::make_shared<RenderTexture>(std::move(value));
    watch(made);
    return made;
}

void bind_texture_picture(Class<RenderTexture>& made) {
    using T = RenderTexture;
    made.def_property(
        "size",
        [](const T& self) -> Size {
            const RenderTextureValue value = self.value();
            return py::make_tuple(value.width, value.height);
        },
        [](T& self, const SizeLike& value) {
            const auto size = to_size(value);
            self.edit([&](RenderTextureValue& next) { std::tie(next.width, next.height) = size; });
        },
        "tuple of int: (width, height), texels.");
    made.def_property(
        "format", [](const T& self) -> FormatName { return to_string(self.value().format); },
        [](T& self, const FormatName& value) {
            const Format format = parse_format(value);
            self.edit([&](RenderTextureValue& next) { next.format = format; });
        },
        "str: \"rgba8\", \"rgba16f\", \"rgba32f\" or \"rgb565\".");
    made.def_property(
        "depth_format", [](const T& self) { return from_depth_format(self.value().depth_format); },
        [](T& self, const DepthFormatName& value) {
            const DepthFormat format = to_depth_format(value);
            self.edit([&](RenderTextureValue& next) { next.depth_format = format; });
        },
        "str or None: the format of the depth and stencil buffer, see `Renderer.render`.");
    made.def_property(
        "samples", [](const T& self) { return self.value().samples; },
        [](T& self, const WholeNumber& value) {
            const std::int64_t samples = to_int(value, "samples");
            self.edit([&](RenderTextureValue& next) { next.samples = samples; });
        },
        "int: samples of each texel (MSAA); 1 is none.");
    made.def_property(
        "mipmaps", [](const T& self) { return self.value().mipmaps; },
        [](T& self, Flag value) {
            self.edit([&](RenderTextureValue& next) { next.mipmaps = value; });
        },
        "bool: whether lookups are trilinear.");
    made.def_property(
        "wrap", [](const T& self) -> WrapName { return to_string(self.value().wrap); },
        [](T& self, const WrapName& value) {
            const Wrap wrap = parse_wrap(value);
            self.edit([&](RenderTextureValue& next) { next.wrap = wrap; });
        },
        "str: \"repeat\", \"clamp\" or \"mirror\".");
}

void bind_texture_links(Class<RenderTexture>& made) {
    using T = RenderTexture;
    made.def_property(
        "scene", [](const T& self) { return self.value().scene; },
        [](T& self, const OneOf<Scene>& value) {
            const auto scene = to_shown_scene(value);
            self.edit([&](RenderTextureValue& next) { next.scene = scene; });
        },
        "Scene: the scene that is drawn.");
    made.def_property(
        "camera", [](const T& self) { return self.value().camera; },
        [](T& self, const OneOf<Camera>& value) {
            const auto camera = to_shown_camera(value);
            self.edit([&](RenderTextureValue& next) { next.camera = camera; });
        },
        "Camera: the camera that the scene is drawn by.");
    made.def_property(
        "exclude",
        [](const T& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return from_nodes(self.value().exclude);
        },
        [](T& self, const Nodes& value) {
            const WeakNodes nodes = to_nodes(value, "exclude");
            self.edit([&](RenderTextureValue& next) { next.exclude = nodes; });
        },
        "tuple of Node: nodes of `scene` that the texture leaves out, with all nodes below them.");
    made.def_property(
        "effects",
        [](const T& self) -> py::typing::Tuple<ImageEffect, py::ellipsis> {
            return py::tuple(py::cast(self.value().effects));
        },
        [](T& self, const EffectsLike& value) {
            const auto effects = to_effects(value);
            self.edit([&](RenderTextureValue& next) { next.effects = effects; });
        },
        "tuple of ImageEffect: passes over the picture, one after the other.");
    made.def_property(
        "name", [](const T& self) { return self.value().name; },
        [](T& self, const Text& value) {
            self.edit([&](RenderTextureValue& next) { next.name = value; });
        },
        "str: a name for people; need not be unique.");
}

std::string represent(const RenderTexture& self) {
    const RenderTextureValue value = self.value();
    return "RenderTexture(" +
           (value.name.empty() ? std::string() : text_of(py::str(value.name)) + ", ") +
           std::to_string(value.width) + " x " + std::to_string(value.height) + ", " +
           std::string(to_string(value.format)) + ")";
}

/// The scene goes into the state, which is pickled later, since its nodes may show the texture.
/// Until unpickling sets the state, an empty scene and a new camera stand in.
py::tuple reduce(const py::object& self) {
    py::dict arguments =
        attributes_of(self, "size", "format", "samples", "mipmaps", "wrap", "name");
    arguments["scene"] = py::type::of<Scene>()();
    arguments["camera"] = py::type::of<PerspectiveCamera>()();
    return reduced(self, arguments,
                   py::make_tuple(self.attr("scene"), self.attr("camera"), self.attr("exclude"),
                                  self.attr("effects"), self.attr("depth_format")));
}

}  // namespace

}  // namespace cubecam::bindings

void bind_render_texture(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto made = declared<RenderTexture>();
    made.attr("__doc__") = docs::render_texture;
    made.def(py::init(&make_render_texture), py::arg("scene"), py::arg("camera"), py::kw_only(),
             py::arg("size") = py::make_tuple(512, 512), py::arg("format") = "rgba8",
             py::arg("samples") = 1, py::arg("mipmaps") = false, py::arg("wrap") = "clamp",
             py::arg("exclude") = py::tuple(), py::arg("name") = "",
             py::arg("effects") = py::tuple(), py::arg("depth_format") = "depth_component32f");
    bind_texture_links(made);
    bind_texture_picture(made);
    made.def("__repr__", &represent);
    made.def("__reduce__", &reduce);
    def_setstate(made, "tuple", [](const py::object& self, const py::tuple& state) {
        self.attr("scene") = state[0];
        self.attr("camera") = state[1];
        self.attr("exclude") = state[2];
        self.attr("effects") = state[3];
        self.attr("depth_format") = state[4];
    });
}
