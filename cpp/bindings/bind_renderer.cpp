#include "arrays.hpp"
#include "effect_list.hpp"
#include "formats.hpp"
#include "frame.hpp"
#include "info.hpp"
#include "numbers.hpp"
#include "objects.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/render/renderer.hpp"

#include <pybind11/stl.h>

#include <algorithm>
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

RequestedOutputs to_outputs(py::handle value) {
    if (py::isinstance<py::str>(value)) return parse_outputs({value.cast<std::string>()});
    std::vector<std::string> names;
    if (!py::isinstance<py::iterable>(value)) {
        throw TypeError("outputs: expected a sequence of names, got " + text_of(value));
    }
    for (const py::handle name : py::iter(value)) {
        if (!py::isinstance<py::str>(name))
            throw TypeError("outputs: expected names, got " + text_of(name));
        names.push_back(name.cast<std::string>());
    }
    return parse_outputs(names);
}

std::vector<std::int32_t> to_ids(const Scene& scene, py::handle exclude) {
    std::vector<std::int32_t> ids;
    if (py::isinstance<Node>(exclude) || !py::isinstance<py::iterable>(exclude)) {
        throw TypeError("exclude: expected a sequence of nodes, got " + text_of(exclude));
    }
    for (const py::handle item : py::iter(exclude)) {
        if (!py::isinstance<Node>(item))
            throw TypeError("exclude: expected nodes, got " + text_of(item));
        const auto node = item.cast<std::shared_ptr<Node>>();
        if (!scene.contains(*node)) {
            throw std::invalid_argument("exclude: expected nodes of this scene, got " +
                                        text_of(item));
        }
        ids.push_back(node->id());
    }
    return ids;
}

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
    if (!py::isinstance<py::bool_>(value))
        throw TypeError("layered: expected True, False or None, got " + text_of(value));
    return value.cast<bool>();
}

std::shared_ptr<Renderer> make_renderer(py::handle device, py::handle layered,
                                        std::int64_t cache_bytes, bool debug) {
    if (cache_bytes < 0) {
        throw std::invalid_argument("cache_bytes: expected 0 or more, got " +
                                    std::to_string(cache_bytes));
    }
    RendererOptions options{to_device(device), to_layered(layered),
                            static_cast<std::size_t>(cache_bytes), debug};
    const py::gil_scoped_release release;
    return std::make_shared<Renderer>(std::move(options));
}

using SeenBy = bindings::OneOf<Camera, StereoCamera>;

std::variant<CameraValue, StereoValue> to_camera(const SeenBy& camera) {
    if (py::isinstance<StereoCamera>(camera)) {
        return camera.cast<std::shared_ptr<StereoCamera>>()->value();
    }
    return bindings::to_shared<Camera>(camera, "camera", "a Camera or a StereoCamera")->value();
}

PyFrame render(Renderer& renderer, const Scene& scene, const SeenBy& camera, py::handle size,
               py::handle outputs, const std::optional<std::string>& format, py::handle samples,
               const std::optional<std::string>& tonemap, const std::optional<std::string>& encode,
               py::handle effects, const std::optional<std::string>& depth_format) {
    FrameOptions options;
    std::tie(options.width, options.height) = to_size(size);
    options.outputs = to_outputs(outputs);
    options.color = format.has_value();
    if (format) options.format = parse_format(*format);
    options.samples = to_int(samples, "samples");
    if (tonemap) options.tonemap = parse_tonemap(*tonemap);
    if (encode) options.encode = parse_encode(*encode);
    options.depth_format = bindings::to_depth_format(depth_format);
    const auto seen = to_camera(camera);
    Frame frame;
    const auto snapshot = scene.snapshot(bindings::to_effects(effects));
    {
        const py::gil_scoped_release release;
        frame = std::visit(
            [&](const auto& value) { return renderer.render(*snapshot, value, options); }, seen);
    }
    return PyFrame(std::move(frame));
}

std::shared_ptr<CubeMap> capture(Renderer& renderer, const Scene& scene, py::handle position,
                                 py::handle size, double near, double far, py::handle exclude,
                                 py::handle outputs, const std::optional<std::string>& format,
                                 py::handle samples, py::handle eye,
                                 const std::optional<std::string>& depth_format,
                                 const std::string& depth_order) {
    CaptureOptions options;
    options.position = to_vec3(position, "position");
    options.size = to_int(size, "size");
    options.near = near;
    options.far = far;
    options.exclude = to_ids(scene, exclude);
    options.outputs = to_outputs(outputs);
    if (!format) {
        throw std::invalid_argument(
            "format: expected one, since a cubemap has faces, got None; `rgba8` is the smallest");
    }
    options.format = parse_format(*format);
    options.samples = to_int(samples, "samples");
    options.depth_format = bindings::to_depth_format(depth_format);
    options.depth_order = parse_depth_order(depth_order);
    if (!eye.is_none()) options.eye = to_vec3(eye, "eye");
    const auto snapshot = scene.snapshot();
    const py::gil_scoped_release release;
    return renderer.capture(*snapshot, options);
}

void update_probes(Renderer& renderer, const Scene& scene, py::handle probes) {
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
    const auto snapshot = scene.snapshot();
    const py::gil_scoped_release release;
    renderer.update_probes(*snapshot, wanted);
}

}  // namespace

}  // namespace cubecam

void bind_renderer(pybind11::module_& m) {
    using namespace cubecam;
    bind_stats(m);
    bind_info(m);
    bind_frame(m);

    auto renderer = bindings::declare<Renderer>(
        m, "Renderer",
        R"(Draws scenes without a screen: frames, cubemaps and the probes that mirrors need.

A renderer owns an OpenGL 4.5 context on EGL: a GPU if there is one, else Mesa's software rasteriser. Any thread may
use it; calls on one renderer follow each other, several renderers work in parallel. Use it in a ``with`` block, or
call :meth:`close`.

Parameters
----------
device : str, int, Device or None
    "auto" (the environment variable CUBECAM_DEVICE if set, else a GPU, else software), "gpu", "software", an index
    into :func:`devices`, one of them, part of a device's name, or a UUID. None means "auto".
layered : bool or None
    Draw all views of a mesh in one call (True), one view after another (False), or as is faster here (None). Both give
    the same bytes on llvmpipe.
cache_bytes : int
    GPU memory kept for targets of frames and captures, so that an unchanged picture is not drawn again. At most as
    much main memory is kept of results that were let go, for the next ones of their size; what eight calls found no
    use for is freed, and all of it by :meth:`close`. Default 256 MiB; ``stats.pictures_not_kept`` tells whether a
    picture is larger than that.
debug : bool
    Ask for a debug context, whose errors tell more.

Raises
------
ContextError
    No context can be had. The message tells each device that was tried, why it failed, and what to install.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene(background=(0.1, 0.2, 0.3))
>>> ball = scene.add(cc.Mesh.sphere(0.5), cc.BasicMaterial(color=(1, 1, 0)))
>>> camera = cc.PerspectiveCamera(fov=60, position=(0, 0, 3), target=(0, 0, 0))
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(scene, camera, size=(64, 48), outputs=("distance",))
...     cube = renderer.capture(scene, position=(0, 0, 2), size=32)
>>> frame.color.shape, round(float(frame.distance.min()), 1)
((48, 64, 4), 2.5)
>>> cube.faces.shape
(6, 32, 32, 4)
)");
    renderer
        .def(py::init(&make_renderer), py::kw_only(), py::arg("device") = "auto",
             py::arg("layered") = py::none(), py::arg("cache_bytes") = std::int64_t{256} << 20,
             py::arg("debug") = false)
        .def("render", &render, py::arg("scene"), py::arg("camera"), py::arg("size"), py::kw_only(),
             py::arg("outputs") = py::tuple(), py::arg("format") = "rgba8", py::arg("samples") = 1,
             py::arg("tonemap") = py::none(), py::arg("encode") = py::none(),
             py::arg("effects") = py::tuple(), py::arg("depth_format") = "depth_component32f",
             R"(Draw a picture, with every probe its mirrors need brought up to date first.

A picture that would come out as the last one of this size and format did is not drawn again.

Parameters
----------
scene : Scene
camera : Camera or StereoCamera
size : (int, int)
    (width, height), pixels.
outputs : sequence of str
    Besides colour: any of "distance", "z", "normal", "position", "id", of the outputs that the GLSL of a
    :class:`ShaderMaterial` of a visible node declares, and of "depth" and "stencil", what those
    buffers hold in the end.
format : str or None
    "rgba8" (uint8, clamped to 0..1), "rgba16f" (float16), "rgba32f" (float32) or "rgb565" (5, 6 and 5 bits, read as
    uint8 of 255; alpha 255). None: no colour buffer, only the outputs are drawn.
samples : int
    Multisampling of colour: 1 for none, at most ``info.limits.max_samples``. The outputs are those of samples=1.
tonemap : str or None
    "reinhard" (Reinhard et al. 2002), "aces" (Narkowicz's fit, 2015) or "neutral" (Khronos PBR Neutral, 2024),
    after resolving. None: values stay as they are.
encode : str or None
    "srgb" (IEC 61966-2-1) or None: linear.
effects : sequence of ImageEffect
    Passes over the colour, one after the other, after resolving and before the tone curve.
depth_format : str or None
    The depth and stencil buffer, by OpenGL's names: "depth_component32f", "depth_component24", "depth_component16",
    "depth24_stencil8", "depth32f_stencil8", "stencil_index8" (no depth) or None (neither). Without depth nothing is
    hidden: nodes are painted one over the other, in order of ``render_order``, then id, and there are no outputs but
    "stencil".

Returns
-------
Frame
    Arrays of shape (height, width, ...), row 0 on top.

Raises
------
ValueError
    For an unknown name, a size or sample count beyond the driver's limits, formats that the driver cannot draw into,
    outputs that ``depth_format`` does not allow, tone mapping or effects of no colour, or an impossible camera.
ContextError
    After :meth:`close`, or in a forked process.

Examples
--------
>>> import cubecam as cc
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(cc.Scene(background=(2, 0, 0)), cc.PerspectiveCamera(), size=(1, 1), format="rgba16f")
>>> frame.color.tolist()
[[[2.0, 0.0, 0.0, 1.0]]]
)")
        .def("capture", &capture, py::arg("scene"),
             py::arg("position") = py::make_tuple(0.0, 0.0, 0.0), py::arg("size") = 256,
             py::kw_only(), py::arg("near") = 0.05, py::arg("far") = 1000.0,
             py::arg("exclude") = py::tuple(), py::arg("outputs") = py::tuple(),
             py::arg("format") = "rgba32f", py::arg("samples") = 1, py::arg("eye") = py::none(),
             py::arg("depth_format") = "depth_component32f", py::arg("depth_order") = "nearest",
             R"(Draw what surrounds a point into a cubemap.

Parameters
----------
scene : Scene
position : array_like (3,)
    World position. The six views look along the world's axes, 90 degrees each.
size : int
    Pixels along an edge of a face.
near, far : float
    Clip distances along each face's axis, world units, 0 < near < far.
exclude : sequence of Node
    Left out, with all below them.
outputs : sequence of str
    Besides ``faces``: any of "distance", "z", "normal", "position", "id", "depth", "stencil", and of the outputs that
    the GLSL of a :class:`ShaderMaterial` of a visible node declares.
format : str
    "rgba32f" (float32), "rgba16f" (float16), "rgba8" (uint8, clamped) or "rgb565" (uint8).
samples : int
    Multisampling of colour, see :meth:`render`.
eye : array_like (3,) or None
    From where highlights and mirrors are seen; None: from ``position``.
depth_format : str or None
    The depth and stencil buffer, see :meth:`render`.
depth_order : str
    "nearest", or "farthest": colour and outputs are those of the farthest opaque surface along each ray between
    ``near`` and ``far``, the background where there is none. Single-sided materials show their front faces alone, so
    the far side of a body counts with ``double_sided=True``. Of translucent nodes shows what is farther still. It
    wants a depth buffer.

Returns
-------
CubeMap
    ``faces`` (6, size, size, 4) in the order +X -X +Y -Y +Z -Z, laid out as OpenGL does (section 8.13 of the 4.6
    specification): ``texture(cube, world_direction)`` needs no flip.

Raises
------
ValueError, TypeError, ContextError
    As :meth:`render`; also for nodes of another scene.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> floor = scene.add(cc.Mesh.plane(10, 10), cc.BasicMaterial(color=(1, 0, 0)), position=(0, -1, 0))
>>> with cc.Renderer() as renderer:
...     cube = renderer.capture(scene, size=16, outputs=("distance", "id"))
>>> cube.sample((0, -1, 0)).tolist(), int(cube.id[3, 8, 8])
([1.0, 0.0, 0.0, 1.0], 1)
)")
        .def("update_probes", &update_probes, py::arg("scene"), py::kw_only(),
             py::arg("probes") = py::none(),
             R"(Draw probes now, whatever their ``update`` says.

Parameters
----------
scene : Scene
probes : Probe, sequence of Probe, or None
    None: all that visible nodes of the scene use.

Raises
------
ValueError
    For a probe that no visible node uses.
ContextError
    After :meth:`close`, or in a forked process.
)")
        .def(
            "read_probe",
            [](Renderer& self, const std::shared_ptr<Probe>& probe) {
                const py::gil_scoped_release release;
                return self.read_probe(probe);
            },
            py::arg("probe"),
            R"(What a probe holds now, in the probe's format.

Parameters
----------
probe : Probe
    One that a picture of this renderer has shown, or that :meth:`update_probes` has drawn.

Returns
-------
CubeMap
    A copy; uint8, float16 or float32, faces (6, size, size, 4).

Raises
------
ValueError
    If this renderer has not drawn it yet.
ContextError
    After :meth:`close`, or in a forked process.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene(background="teal")
>>> ball = scene.add(cc.Mesh.sphere(0.5), cc.MirrorMaterial())
>>> ball.environment = cc.Probe(size=8)
>>> with cc.Renderer() as renderer:
...     renderer.update_probes(scene)
...     held = renderer.read_probe(ball.environment)
>>> held.faces.shape, held.dtype.name
((6, 8, 8, 4), 'float16')
)")
        .def(
            "read_texture",
            [](Renderer& self, const std::shared_ptr<RenderTexture>& render_texture) {
                Frame held;
                {
                    const py::gil_scoped_release release;
                    held = self.read_texture(render_texture);
                }
                return py::array(PyFrame(std::move(held)).color);
            },
            py::arg("render_texture").none(false),
            R"(What a render texture holds now, in its format.

Parameters
----------
render_texture : RenderTexture
    One that a picture of this renderer has shown.

Returns
-------
ndarray (H, W, 4)
    uint8, float16 or float32, row 0 on top; the caller's own.

Raises
------
ValueError
    If this renderer has not drawn it yet.
)")
        .def(
            "shadow_map",
            [](Renderer& self, const Scene& scene, const std::shared_ptr<Light>& light) {
                const auto snapshot = scene.snapshot();
                ShadowDistances picture;
                {
                    const py::gil_scoped_release release;
                    picture = self.shadow_map(*snapshot, light);
                }
                return owned_array(std::move(picture.distances),
                                   {picture.layers, picture.size, picture.size});
            },
            py::arg("scene"), py::arg("light"),
            R"(What a light sees of what casts shadows, to look at. It is drawn if it is not up to date.

Parameters
----------
scene : Scene
light : Light
    One of the scene's, with a shadow.

Returns
-------
ndarray (L, size, size) float32
    Distances in world units along the axis of each view, +inf where nothing casts. A spot light has one view, from the
    light along its direction. A point light has six, +X -X +Y -Y +Z -Z, laid out as the faces of a capture; they, and
    a spot light's, are a little wider than 90 degrees or the cone: the filter reaches into ``ceil(radius) + 2``
    texels more on each side. A directional light has one view of parallel rays, and distances count from the plane at
    which the bounds of all that casts begin; its outermost texels stay empty. Row 0 of a single view is on top: +Y is
    up there, -Z for light from straight above or below.

Raises
------
ValueError
    For a light that is not in the scene or has no shadow, or a size beyond the driver's limits.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> sun = scene.add(cc.DirectionalLight(direction=(0, -1, 0), shadow=cc.Shadow(size=32)))
>>> box = scene.add(cc.Mesh.box(1), position=(0, 3, 0))
>>> floor = scene.add(cc.Mesh.plane(4, 4))
>>> with cc.Renderer() as renderer:
...     depth = renderer.shadow_map(scene, sun)
>>> depth.shape, depth[0, 16, 16].round(3).item(), depth[0, 16, 4].round(3).item()
((1, 32, 32), 0.0, 3.5)
)")
        .def("close", &Renderer::close, py::call_guard<py::gil_scoped_release>(),
             "Free the context and all it holds. Calls after that raise ContextError; closing "
             "twice does nothing.")
        .def_property_readonly("closed", &Renderer::closed, "bool")
        .def_property_readonly("info", &Renderer::info, py::return_value_policy::copy,
                               "RendererInfo: what was chosen; it stays after close().")
        .def_property_readonly("stats", &Renderer::stats, "Stats: of the last call.")
        .def("__enter__", [](std::shared_ptr<Renderer> self) { return self; })
        .def("__exit__",
             [](Renderer& self, const py::args&) {
                 const py::gil_scoped_release release;
                 self.close();
             })
        .def("__repr__", [](const Renderer& self) {
            return "<cubecam.Renderer on " + self.info().renderer +
                   (self.closed() ? ", closed>" : ">");
        });
}
