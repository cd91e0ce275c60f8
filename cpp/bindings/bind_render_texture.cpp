// cubecam.RenderTexture
#include "effect_list.hpp"
#include "formats.hpp"
#include "node_list.hpp"
#include "numbers.hpp"
#include "objects.hpp"

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

constexpr const char* render_texture_doc =
    R"doc(A picture that a scene is drawn into and that materials show in the same frame.

It is only a description, and may serve any number of materials in any number of scenes: give it as
the ``map`` of a `BasicMaterial` or `PhongMaterial`. Each renderer holds contents of its own
(``renderer.read_texture(render_texture)``), brings them up to date before what shows them, and draws
them again only if the picture would come out different.

Parameters
----------
scene : Scene
    What it shows; kept alive. It may show other render textures, and mirrors with probes.
camera : Camera
    From where; the shape of the picture is that of `size`.
size : (int, int)
    (width, height), texels.
format : {"rgba8", "rgba16f", "rgba32f", "rgb565"}
    What a texel is kept in. rgba8 and rgb565 clip light above 1.
samples : int
    Samples of each texel, for smooth edges (MSAA); 1 is none.
mipmaps : bool
    Whether lookups are trilinear, for pictures that are seen small. False: bilinear.
wrap : {"clamp", "repeat"}
    What a lookup outside 0..1 gives.
exclude : iterable of Node
    Nodes of `scene` that it does not show, whole subtrees.
name : str
    For people: messages use it.
effects : sequence of ImageEffect
    Passes over the picture, one after the other, in linear float. With an empty scene they make the
    picture alone.
depth_format : str or None
    The depth and stencil buffer, see `Renderer.render`; None paints nodes one over the other.

Raises
------
ValueError
    For a size or samples below 1, or another format or wrap.
TypeError
    For a scene, a camera or excluded things of another type.

Notes
-----
uv (0, 0) is the picture's bottom-left, as with an `Image`. Its alpha counts where the material's
own opacity is below 1; it does not make a surface translucent by itself.

A picture that shows itself, directly, by other render textures or by probes, has no end: drawing
what shows it raises ValueError. A monitor in the room that it shows is left out by `exclude`. What
is left out still casts: a shadow whose caster moves its vertices by the picture must not fall there.

Examples
--------
>>> import cubecam as cc
>>> clock = cc.Scene(background=(0, 0, .2))
>>> hand = clock.add(cc.Mesh.box((.1, 1, .1)), cc.BasicMaterial(color=(1, 1, 0)))
>>> face = cc.RenderTexture(clock, cc.OrthographicCamera(height=2, position=(0, 0, 5)),
...                         size=(64, 64), name="clock")
>>> scene = cc.Scene()
>>> cube = scene.add(cc.Mesh.box(), cc.BasicMaterial(map=face))
>>> camera = cc.PerspectiveCamera(position=(1, 1, 2), target=(0, 0, 0))
>>> with cc.Renderer() as renderer:
...     for degrees in (0, 6, 12):
...         hand.rotation = cc.axis_angle((0, 0, 1), -degrees)
...         frame = renderer.render(scene, camera, size=(64, 48))  # shows the hand as it is now
...     drawn = renderer.stats.textures_updated
...     picture = renderer.read_texture(face)
>>> picture.shape, drawn
((64, 64, 4), 1)
)doc";

using Size = py::typing::Tuple<py::int_, py::int_>;
using SizeLike = OneOf<Size>;
using WholeNumber = OneOf<py::int_>;

std::shared_ptr<Scene> to_shown_scene(py::handle value) {
    return to_shared<Scene>(value, "scene", "a Scene");
}

std::shared_ptr<Camera> to_shown_camera(py::handle value) {
    return to_shared<Camera>(value, "camera", "a Camera");
}

/// Notes a new texture. Now and then, when there are twice as many as were left the last time,
/// those are freed that only they themselves keep alive.
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
                    const std::string& format, const WholeNumber& samples, bool mipmaps,
                    const std::string& wrap, const Nodes& exclude, std::string name,
                    const EffectsLike& effects, const std::optional<std::string>& depth_format) {
    RenderTextureValue value;
    value.scene = to_shown_scene(scene);
    value.camera = to_shown_camera(camera);
    std::tie(value.width, value.height) = to_size(size);
    value.format = parse_format(format);
    value.samples = to_int(samples, "samples");
    value.mipmaps = mipmaps;
    value.wrap = parse_wrap(wrap);
    value.exclude = to_nodes(exclude, "exclude");
    value.name = std::move(name);
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
        "format", [](const T& self) { return std::string(to_string(self.value().format)); },
        [](T& self, const std::string& value) {
            const Format format = parse_format(value);
            self.edit([&](RenderTextureValue& next) { next.format = format; });
        },
        "str: \"rgba8\", \"rgba16f\", \"rgba32f\" or \"rgb565\".");
    made.def_property(
        "depth_format", [](const T& self) { return from_depth_format(self.value().depth_format); },
        [](T& self, const std::optional<std::string>& value) {
            const DepthFormat format = to_depth_format(value);
            self.edit([&](RenderTextureValue& next) { next.depth_format = format; });
        },
        "str or None: the depth and stencil buffer, see `Renderer.render`.");
    made.def_property(
        "samples", [](const T& self) { return self.value().samples; },
        [](T& self, const WholeNumber& value) {
            const std::int64_t samples = to_int(value, "samples");
            self.edit([&](RenderTextureValue& next) { next.samples = samples; });
        },
        "int: samples of each texel (MSAA); 1 is none.");
    made.def_property(
        "mipmaps", [](const T& self) { return self.value().mipmaps; },
        [](T& self, bool value) {
            self.edit([&](RenderTextureValue& next) { next.mipmaps = value; });
        },
        "bool: whether lookups are trilinear.");
    made.def_property(
        "wrap", [](const T& self) { return std::string(to_string(self.value().wrap)); },
        [](T& self, const std::string& value) {
            const Wrap wrap = parse_wrap(value);
            self.edit([&](RenderTextureValue& next) { next.wrap = wrap; });
        },
        "str: \"repeat\" or \"clamp\".");
}

void bind_texture_links(Class<RenderTexture>& made) {
    using T = RenderTexture;
    made.def_property(
        "scene", [](const T& self) { return self.value().scene; },
        [](T& self, const OneOf<Scene>& value) {
            const auto scene = to_shown_scene(value);
            self.edit([&](RenderTextureValue& next) { next.scene = scene; });
        },
        "Scene: what it shows.");
    made.def_property(
        "camera", [](const T& self) { return self.value().camera; },
        [](T& self, const OneOf<Camera>& value) {
            const auto camera = to_shown_camera(value);
            self.edit([&](RenderTextureValue& next) { next.camera = camera; });
        },
        "Camera: from where it is seen.");
    made.def_property(
        "exclude",
        [](const T& self) -> py::typing::Tuple<Node, py::ellipsis> {
            return from_nodes(self.value().exclude);
        },
        [](T& self, const Nodes& value) {
            const WeakNodes nodes = to_nodes(value, "exclude");
            self.edit([&](RenderTextureValue& next) { next.exclude = nodes; });
        },
        "tuple of Node: nodes of `scene` that it does not show, whole subtrees.");
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
        [](T& self, const std::string& value) {
            self.edit([&](RenderTextureValue& next) { next.name = value; });
        },
        "str: for people; need not be unique.");
}

std::string represent_render_texture(const RenderTexture& self) {
    const RenderTextureValue value = self.value();
    return "RenderTexture(" +
           (value.name.empty() ? std::string() : text_of(py::str(value.name)) + ", ") +
           std::to_string(value.width) + " x " + std::to_string(value.height) + ", " +
           std::string(to_string(value.format)) + ")";
}

/// The scene goes into the state: its nodes may show the texture. What stands for it, and for the
/// camera, until then is empty.
py::tuple reduce_render_texture(const py::object& self) {
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
    made.attr("__doc__") = render_texture_doc;
    made.def(py::init(&make_render_texture), py::arg("scene"), py::arg("camera"), py::kw_only(),
             py::arg("size") = py::make_tuple(512, 512), py::arg("format") = "rgba8",
             py::arg("samples") = 1, py::arg("mipmaps") = false, py::arg("wrap") = "clamp",
             py::arg("exclude") = py::tuple(), py::arg("name") = "",
             py::arg("effects") = py::tuple(), py::arg("depth_format") = "depth_component32f");
    bind_texture_links(made);
    bind_texture_picture(made);
    made.def("__repr__", &represent_render_texture);
    made.def("__reduce__", &reduce_render_texture);
    def_setstate(made, "tuple", [](const py::object& self, const py::tuple& state) {
        self.attr("scene") = state[0];
        self.attr("camera") = state[1];
        self.attr("exclude") = state[2];
        self.attr("effects") = state[3];
        self.attr("depth_format") = state[4];
    });
}
