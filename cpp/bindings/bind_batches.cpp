// cubecam._core._CaptureBatch and _RenderBatch: what python/cubecam/batches draws with.
#include "arrays.hpp"
#include "asynchronous.hpp"
#include "effect_list.hpp"
#include "encodings.hpp"
#include "frame.hpp"
#include "notices.hpp"
#include "objects.hpp"
#include "renderer_arguments.hpp"
#include "vectors.hpp"

#include "cubecam/render/renderer.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam::bindings {

namespace {

using OutputKinds = Shown<"list[tuple[str, int, numpy.dtype[numpy.generic]]]">;
using FrameArrays = Shown<"tuple[tuple[int, int], numpy.dtype[numpy.generic] | None, "
                          "list[tuple[str, int, numpy.dtype[numpy.generic]]]]">;
using ArraysOfBatch = py::typing::Tuple<Pixels, py::typing::List<OutputArray>>;
using CameraList = OneOf<py::typing::Iterable<SeenBy>>;

/// A scene at one moment, the places of its captures, and the renderer that draws them.
struct CaptureBatch {
    std::shared_ptr<Renderer> renderer;
    std::shared_ptr<const SceneSnapshot> scene;
    CaptureOptions options;
    std::vector<CapturePlace> places;
    Renderer::BatchShape shape;
};

std::vector<CapturePlace> to_places(py::handle positions, py::handle rotations) {
    const auto points = double_array(positions, "positions", "(P, 3)");
    const auto count = static_cast<std::size_t>(points.shape(0));
    std::vector<CapturePlace> places(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double* at = points.data() + 3 * i;
        places[i].position = {at[0], at[1], at[2]};
    }
    if (rotations.is_none()) return places;
    const auto turns = double_array(rotations, "rotations", "(P, 4)");
    if (turns.shape(0) != points.shape(0)) {
        throw py::value_error("rotations: expected one for each of the " + std::to_string(count) +
                              " positions, got " + std::to_string(turns.shape(0)));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double* q = turns.data() + 4 * i;
        if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) {
            throw py::value_error("rotations: expected quaternions of a length other than 0, got "
                                  "(0, 0, 0, 0) as number " +
                                  std::to_string(i));
        }
        places[i].rotation = unit_rotation(glm::dquat(q[0], q[1], q[2], q[3]));
    }
    return places;
}

std::shared_ptr<CaptureBatch>
make_batch(const std::shared_ptr<Renderer>& renderer, const Scene& scene,
           const ArrayLike& positions, const OrNone<ArrayLike>& rotations, const WholeNumber& size,
           Real near, Real far, const Nodes& exclude, const OutputNames& outputs,
           const FormatOrNone& format, const WholeNumber& samples, const OrNone<ArrayLike>& eye,
           const DepthFormatName& depth_format, const Choice<depth_order_names>& depth_order) {
    auto made = std::make_shared<CaptureBatch>();
    made->renderer = renderer;
    made->places = to_places(positions, rotations);
    made->options = capture_options(scene, {size, near, far, exclude, outputs, format, samples, eye,
                                            depth_format, depth_order});
    made->scene = snapshot_of(scene);
    made->shape = with_notices([&] { return renderer->batch_shape(*made->scene, made->options); });
    return made;
}

/// The memory of an array for a part of a batch. The shape of a cube is `cube`.
std::byte* memory_of(const py::array& array, const char* name, const py::dtype& dtype,
                     const std::vector<py::ssize_t>& cube) {
    const bool fits = array.ndim() == static_cast<py::ssize_t>(cube.size() + 1) &&
                      std::equal(cube.begin(), cube.end(), array.shape() + 1);
    if (!fits || !array.dtype().equal(dtype) || !array.writeable() ||
        (array.flags() & py::array::c_style) == 0) {
        throw py::value_error(std::string(name) +
                              ": expected a writable C-contiguous array of the "
                              "batch's shape and dtype, got " +
                              shape_text(array));
    }
    return static_cast<std::byte*>(const_cast<void*>(array.data()));
}

/// Arrays of undefined numbers for so many captures: the faces, then the outputs. Their memory is
/// that of earlier results of the renderer, if these are no longer used.
ArraysOfBatch allocate(const CaptureBatch& batch, Int count) {
    const auto cubes = static_cast<std::size_t>(*count);
    const auto n = static_cast<std::size_t>(batch.options.size);
    const auto make = [&](std::size_t texel, const py::dtype& dtype, int channels) {
        std::vector<py::ssize_t> shape{*count, face_count, batch.options.size, batch.options.size};
        if (channels > 1) shape.push_back(channels);
        return owned_pixels(batch.renderer->result_memory(cubes * face_count * n * n * texel),
                            dtype, std::move(shape));
    };
    const Format format = batch.options.format;
    py::list outputs;
    for (const OutputKind& kind : batch.shape.outputs) {
        outputs.append(make(kind.bytes(), numpy_dtype(kind.type), kind.channels));
    }
    return py::make_tuple(make(color_bytes(format), numpy_dtype(dtype_of(format)), 4), outputs);
}

/// Draws the captures from number `first` on, as many as the arrays have room for.
void draw(CaptureBatch& batch, std::size_t first, const Pixels& faces_given,
          const py::typing::List<OutputArray>& outputs) {
    const auto faces = py::reinterpret_borrow<py::array>(faces_given);
    const auto count = static_cast<std::size_t>(faces.shape(0));
    const auto n = static_cast<py::ssize_t>(batch.options.size);
    if (first + count > batch.places.size() || outputs.size() != batch.shape.outputs.size()) {
        throw py::index_error("expected a part of the batch");
    }
    LayerMemory to;
    to.color = memory_of(faces, "faces", numpy_dtype(dtype_of(batch.options.format)),
                         {face_count, n, n, 4});
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const OutputKind& kind = batch.shape.outputs[i];
        std::vector<py::ssize_t> cube{face_count, n, n};
        if (kind.channels > 1) cube.push_back(kind.channels);
        const auto array = outputs[i].cast<py::array>();
        if (array.shape(0) != faces.shape(0)) throw py::index_error("expected equal lengths");
        to.outputs.push_back(memory_of(array, kind.name.c_str(), numpy_dtype(kind.type), cube));
    }
    with_notices([&] {
        batch.renderer->capture_batch(*batch.scene, batch.options,
                                      std::span(batch.places).subspan(first, count),
                                      batch.shape.clear, to);
        return true;
    });
}

/// A scene at one moment, and cameras that see it.
struct RenderBatch {
    std::shared_ptr<Renderer> renderer;
    std::shared_ptr<const SceneSnapshot> scene;
    FrameOptions options;
    std::vector<std::variant<CameraValue, StereoValue>> cameras;
};

std::shared_ptr<RenderBatch>
make_renders(const std::shared_ptr<Renderer>& renderer, const Scene& scene,
             const CameraList& cameras, const SizeLike& size, const OutputNames& outputs,
             const FormatOrNone& format, const WholeNumber& samples, Real exposure,
             const std::optional<Choice<tonemap_names>>& tonemap,
             const std::optional<Choice<encode_names>>& encode, const EffectsLike& effects,
             const DepthFormatName& depth_format, Flag screen_reflections) {
    auto made = std::make_shared<RenderBatch>();
    made->renderer = renderer;
    made->options = frame_options({size, outputs, format, samples, exposure, tonemap, encode,
                                   depth_format, screen_reflections});
    for (const py::handle camera : py::iter(cameras)) {
        made->cameras.push_back(to_camera(py::reinterpret_borrow<SeenBy>(camera)));
    }
    made->scene = snapshot_of(scene, to_effects(effects));
    return made;
}

/// Checks what can be said of all frames before one is drawn, and gives what they will hold.
FrameShape shape_of(const RenderBatch& batch) {
    for (const auto& camera : batch.cameras) {
        (void)FrameRequest{batch.scene, camera, batch.options}.check(batch.renderer->info());
    }
    return frame_shape(*batch.scene, batch.options);
}

py::list described(const std::vector<OutputKind>& outputs) {
    py::list list;
    for (const OutputKind& kind : outputs) {
        list.append(py::make_tuple(kind.name, kind.channels, numpy_dtype(kind.type)));
    }
    return list;
}

/// Whether a probe of the scene, or of those that its render textures show, is as `is` says.
template <class Is>
bool any_probe(const SceneSnapshot& scene, Is is) {
    for (std::size_t number = 0; number <= scene.others.size(); ++number) {
        const auto& probes = scene.scene(number).probes;
        if (std::any_of(probes.begin(), probes.end(),
                        [&](const ProbeSnapshot& probe) { return is(probe.value); })) {
            return true;
        }
    }
    return false;
}

/// Whether a probe of the scene may show what the scene was when it was drawn before.
bool keeps_pictures(const CaptureBatch& batch) {
    return any_probe(*batch.scene, [](const ProbeValue& probe) {
        return probe.update != ProbeUpdate::on_change || probe.faces_per_frame < face_count;
    });
}

PyFrame render(RenderBatch& batch, std::size_t number) {
    return draw_now(*batch.renderer,
                    FrameRequest{batch.scene, batch.cameras.at(number), batch.options});
}

}  // namespace

}  // namespace cubecam::bindings

void bind_batches(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    auto batch = declare<CaptureBatch>(module, "_CaptureBatch",
                                       "A scene at one moment, and the places of its captures.");
    batch
        .def(py::init(&make_batch), py::arg("renderer"), py::arg("scene"), py::arg("positions"),
             py::arg("rotations"), py::arg("size"), py::kw_only(), py::arg("near"), py::arg("far"),
             py::arg("exclude"), py::arg("outputs"), py::arg("format"), py::arg("samples"),
             py::arg("eye"), py::arg("depth_format"), py::arg("depth_order"))
        .def("__len__", [](const CaptureBatch& self) { return self.places.size(); })
        .def_property_readonly("most_cubes",
                               [](const CaptureBatch& self) { return self.shape.most_cubes; })
        .def_property_readonly(
            "encoding",
            [](const CaptureBatch& self) -> EncodingNow { return to_string(self.shape.encoding); })
        .def_property_readonly("size", [](const CaptureBatch& self) { return self.options.size; })
        .def_property_readonly("dtype",
                               [](const CaptureBatch& self) -> PixelDType {
                                   return numpy_dtype(dtype_of(self.options.format));
                               })
        .def_property_readonly(
            "outputs",
            [](const CaptureBatch& self) -> OutputKinds { return described(self.shape.outputs); })
        .def_property_readonly(
            "revision", [](const CaptureBatch& self) { return self.scene->revision; },
            "int: of the scene; equal ones show the same.")
        .def_property_readonly("keeps_pictures", &keeps_pictures,
                               "bool: whether its pictures depend on what was drawn of the scene "
                               "before.")
        .def("allocate", &allocate, py::arg("count"))
        .def("draw", &draw, py::arg("first"), py::arg("faces"), py::arg("outputs"));
    declare<RenderBatch>(module, "_RenderBatch", "A scene at one moment, and cameras.")
        .def(py::init(&make_renders), py::arg("renderer"), py::arg("scene"), py::arg("cameras"),
             py::arg("size"), py::kw_only(), py::arg("outputs"), py::arg("format"),
             py::arg("samples"), py::arg("exposure"), py::arg("tonemap"), py::arg("encode"),
             py::arg("effects"), py::arg("depth_format"), py::arg("screen_reflections"))
        .def("__len__", [](const RenderBatch& self) { return self.cameras.size(); })
        .def_property_readonly(
            "revision", [](const RenderBatch& self) { return self.scene->revision; },
            "int: of the scene with the effects; equal ones show the same.")
        .def_property_readonly("encoding",
                               [](const RenderBatch& self) -> EncodingNow {
                                   return to_string(
                                       frame_shape(*self.scene, self.options).encoding);
                               })
        .def(
            "shape",
            [](const RenderBatch& self) -> FrameArrays {
                const FrameShape shape = shape_of(self);
                const FrameOptions& options = self.options;
                return py::make_tuple(
                    py::make_tuple(options.width, options.height),
                    options.color ? py::object(numpy_dtype(dtype_of(options.format))) : py::none(),
                    described(shape.outputs));
            },
            "The size, the dtype of colours or None, and the outputs of all frames; checks what "
            "can be known before one is drawn.")
        .def("draw", &render, py::arg("number"));
}
