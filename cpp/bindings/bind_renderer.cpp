#include "arrays.hpp"
#include "asynchronous.hpp"
#include "docs/renderer.hpp"
#include "effect_list.hpp"
#include "formats.hpp"
#include "frame.hpp"
#include "info.hpp"
#include "node_list.hpp"
#include "notices.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "renderer_arguments.hpp"
#include "unlocked.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/render/renderer.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {
namespace {

using bindings::capture_options;
using bindings::CaptureRequest;
using bindings::FormatOrNone;
using bindings::frame_options;
using bindings::FrameRequest;
using bindings::OutputNames;
using bindings::SeenBy;
using bindings::snapshot_of;
using bindings::to_camera;
using DeviceLike = bindings::OneOf<py::str, bindings::WholeNumber, gl::DeviceInfo, py::none>;
using LayeredLike = bindings::OneOf<py::bool_, py::none>;
using ProbesLike = bindings::OneOf<Probe, py::typing::Iterable<Probe>, py::none>;

gl::DeviceChoice to_device(py::handle device) {
    if (device.is_none()) return std::string("auto");
    if (py::isinstance<py::str>(device)) return device.cast<std::string>();
    if (py::isinstance<gl::DeviceInfo>(device)) return device.cast<const gl::DeviceInfo&>().index;
    const std::int64_t index = to_int(device, "device");
    return static_cast<int>(std::clamp<std::int64_t>(index, std::numeric_limits<int>::min(),
                                                     std::numeric_limits<int>::max()));
}

std::optional<bool> to_layered(py::handle value) {
    if (value.is_none()) return std::nullopt;
    if (const auto layered = truth_value(value)) return layered;
    throw TypeError("layered: expected True, False or None, got " + text_of(value));
}

std::shared_ptr<Renderer> make_renderer(const DeviceLike& device, const LayeredLike& layered,
                                        const bindings::WholeNumber& cache_bytes,
                                        bindings::Flag debug, bindings::Flag trust_shaders) {
    const std::int64_t kept_bytes =
        to_int(cache_bytes, "cache_bytes", 0, std::numeric_limits<std::int64_t>::max());
    RendererOptions options{to_device(device), to_layered(layered),
                            static_cast<std::size_t>(kept_bytes), debug, trust_shaders};
    return bindings::with_notices([&] { return std::make_shared<Renderer>(std::move(options)); });
}

FrameRequest frame_request(const Scene& scene, const SeenBy& camera, const bindings::SizeLike& size,
                           const OutputNames& outputs, const FormatOrNone& format,
                           const bindings::WholeNumber& samples, bindings::Real exposure,
                           const std::optional<bindings::Choice<tonemap_names>>& tonemap,
                           const std::optional<bindings::Choice<encode_names>>& encode,
                           const bindings::EffectsLike& effects,
                           const bindings::DepthFormatName& depth_format,
                           bindings::Flag screen_reflections, bindings::Real max_lod_error) {
    auto options = frame_options({size, outputs, format, samples, exposure, tonemap, encode,
                                  depth_format, screen_reflections, max_lod_error});
    auto seen = to_camera(camera);
    return {snapshot_of(scene, bindings::to_effects(effects)), std::move(seen), std::move(options)};
}

CaptureRequest capture_request(
    const Scene& scene, const bindings::ArrayLike& position, const bindings::WholeNumber& size,
    bindings::Real near, bindings::Real far, const bindings::Nodes& exclude,
    const OutputNames& outputs, const FormatOrNone& format, const bindings::WholeNumber& samples,
    const bindings::OrNone<bindings::ArrayLike>& eye, const bindings::DepthFormatName& depth_format,
    const bindings::Choice<depth_order_names>& depth_order,
    const bindings::OrNone<bindings::ArrayLike>& rotation, bindings::Real max_lod_error) {
    CaptureOptions options =
        capture_options(scene, {size, near, far, exclude, outputs, format, samples, eye,
                                depth_format, depth_order, max_lod_error});
    options.position = to_vec3(position, "position");
    if (!rotation.is_none()) {
        options.rotation = unit_rotation(bindings::to_rotation(rotation, "rotation"));
    }
    return {snapshot_of(scene), std::move(options)};
}

/// The two methods of a renderer that draw what `request` makes of their arguments: now, and later.
/// `Later` is the type of the second one's result.
template <auto request, class Later>
struct Methods;

template <class Request, class... Args, Request (*request)(Args...), class Later>
struct Methods<request, Later> {
    static auto now(Renderer& renderer, Args... args) {
        return bindings::draw_now(renderer, request(std::forward<Args>(args)...));
    }
    static Later later(const std::shared_ptr<Renderer>& renderer, Args... args) {
        return bindings::draw_later(renderer, request(std::forward<Args>(args)...));
    }
};

using FutureFrame = bindings::Shown<"cubecam._futures.PictureFuture[cubecam.Frame]">;
using FutureCube = bindings::Shown<"cubecam._futures.PictureFuture[cubecam.CubeMap]">;
using Render = Methods<&frame_request, FutureFrame>;
using Capture = Methods<&capture_request, FutureCube>;

void update_probes(Renderer& renderer, const Scene& scene, const ProbesLike& probes) {
    std::vector<std::shared_ptr<Probe>> wanted;
    if (py::isinstance<Probe>(probes)) {
        wanted.push_back(probes.cast<std::shared_ptr<Probe>>());
    } else if (!probes.is_none()) {
        if (!py::isinstance<py::iterable>(probes)) {
            throw TypeError("probes: expected probes, got " + text_of(probes));
        }
        for (const py::handle probe : py::iter(probes)) {
            if (!py::isinstance<Probe>(probe))
                throw TypeError("probes: expected probes, got " + text_of(probe));
            wanted.push_back(probe.cast<std::shared_ptr<Probe>>());
        }
        if (wanted.empty()) return;
    }
    const auto snapshot = snapshot_of(scene);
    bindings::with_notices([&] {
        renderer.update_probes(*snapshot, wanted);
        return true;
    });
}

}  // namespace

}  // namespace cubecam

void bind_renderer(pybind11::module_& m) {
    using namespace cubecam;
    bind_stats(m);
    bind_info(m);
    bind_frame(m);
    bindings::bind_later_call(m);

    auto renderer = bindings::declare<Renderer>(m, "Renderer", docs::renderer);
    const auto def_render = [&](const char* name, auto method, const char* doc) {
        renderer.def(name, method, py::arg("scene"), py::arg("camera"), py::arg("size"),
                     py::kw_only(), py::arg("outputs") = py::tuple(), py::arg("format") = "rgba8",
                     py::arg("samples") = 1, py::arg("exposure") = 0.0,
                     py::arg("tonemap") = py::none(), py::arg("encode") = py::none(),
                     py::arg("effects") = py::tuple(),
                     py::arg("depth_format") = "depth_component32f",
                     py::arg("screen_reflections") = false, py::arg("max_lod_error") = 0.0, doc);
    };
    const auto def_capture = [&](const char* name, auto method, const char* doc) {
        renderer.def(
            name, method, py::arg("scene"), py::arg("position") = py::make_tuple(0.0, 0.0, 0.0),
            py::arg("size") = 256, py::kw_only(), py::arg("near") = 0.05, py::arg("far") = 1000.0,
            py::arg("exclude") = py::tuple(), py::arg("outputs") = py::tuple(),
            py::arg("format") = "rgba32f", py::arg("samples") = 1, py::arg("eye") = py::none(),
            py::arg("depth_format") = "depth_component32f", py::arg("depth_order") = "nearest",
            py::arg("rotation") = py::none(), py::arg("max_lod_error") = 0.0, doc);
    };
    def_render("render", &Render::now, docs::render);
    def_render("render_async", &Render::later, docs::render_async);
    def_capture("capture", &Capture::now, docs::capture);
    def_capture("capture_async", &Capture::later, docs::capture_async);
    renderer
        .def(py::init(&make_renderer), py::kw_only(), py::arg("device") = "auto",
             py::arg("layered") = py::none(), py::arg("cache_bytes") = std::int64_t{256} << 20,
             py::arg("debug") = false, py::arg("trust_shaders") = false)
        .def("update_probes", &update_probes, py::arg("scene"), py::kw_only(),
             py::arg("probes") = py::none(), docs::update_probes)
        .def(
            "read_probe",
            [](Renderer& self, const std::shared_ptr<Probe>& probe) {
                return bindings::with_notices([&] { return self.read_probe(probe); });
            },
            py::arg("probe"), docs::read_probe)
        .def(
            "read_texture",
            [](Renderer& self, const std::shared_ptr<RenderTexture>& render_texture) {
                Frame held =
                    bindings::with_notices([&] { return self.read_texture(render_texture); });
                return bindings::Pixels(PyFrame(std::move(held)).color);
            },
            py::arg("render_texture").none(false), docs::read_texture)
        .def(
            "shadow_map",
            [](Renderer& self, const Scene& scene, const std::shared_ptr<Light>& light) {
                const auto snapshot = snapshot_of(scene);
                ShadowDistances picture =
                    bindings::with_notices([&] { return self.shadow_map(*snapshot, light); });
                return py::array_t<float>(owned_array(
                    std::move(picture.distances), {picture.layers, picture.size, picture.size}));
            },
            py::arg("scene"), py::arg("light"), docs::shadow_map)
        .def(
            "close",
            [](const std::shared_ptr<Renderer>& self) {
                bindings::end_submitted(self, false);
                const bindings::Unlocked unlocked;
                self->close();
            },
            "Free the OpenGL context and its memory. Calls after that raise ContextError; a second "
            "close() does nothing. Calls of :meth:`render_async` and :meth:`capture_async` that "
            "were made before are drawn first; leaving a ``with`` block by an exception cancels "
            "those that have not begun.")
        .def_property_readonly("closed", &Renderer::closed, "bool: whether close() was called.")
        .def_property_readonly(
            "info", &Renderer::info,
            "RendererInfo: the device, driver and limits; readable after close(), too.")
        .def_property_readonly(
            "stats",
            [](const Renderer& self) {
                const bindings::Unlocked unlocked;  // another thread may be drawing
                return self.stats();
            },
            "Stats: what the last call drew.")
        .def("__enter__", [](std::shared_ptr<Renderer> self) { return self; })
        .def("__exit__",
             [](const std::shared_ptr<Renderer>& self, const py::args& error) {
                 bindings::end_submitted(self, !error.empty() && !error[0].is_none());
                 const bindings::Unlocked unlocked;
                 self->close();
             })
        .def("__repr__", [](const Renderer& self) {
            return "<cubecam.Renderer on " + self.info().renderer +
                   (self.closed() ? ", closed>" : ">");
        });
}
