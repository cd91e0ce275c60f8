#include "renderer_arguments.hpp"

#include "arrays.hpp"
#include "numbers.hpp"
#include "unlocked.hpp"

#include "cubecam/core/error.hpp"

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace cubecam::bindings {

namespace {

RequestedOutputs to_outputs(py::handle value) {
    if (py::isinstance<py::str>(value)) return parse_outputs({value.cast<std::string>()});
    std::vector<std::string> names;
    if (!py::isinstance<py::iterable>(value)) {
        throw TypeError("outputs: expected a sequence of names, got " + text_of(value));
    }
    for (const py::handle name : py::iter(value)) {
        if (!py::isinstance<py::str>(name))
            throw TypeError("outputs: expected names as str, got " + text_of(name));
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

}  // namespace

std::shared_ptr<const SceneSnapshot> snapshot_of(const Scene& scene,
                                                 const Scene::Effects& effects) {
    return scene.snapshot(effects, [](const std::function<void()>& work) {
        const Unlocked unlocked;
        work();
    });
}

std::variant<CameraValue, StereoValue> to_camera(const SeenBy& camera) {
    if (py::isinstance<StereoCamera>(camera)) {
        return camera.cast<std::shared_ptr<StereoCamera>>()->value();
    }
    return to_shared<Camera>(camera, "camera", "a Camera or a StereoCamera")->world_value();
}

FrameOptions frame_options(const FrameArguments& given) {
    FrameOptions options;
    std::tie(options.width, options.height) = to_size(given.size);
    options.outputs = to_outputs(given.outputs);
    options.color = given.format.has_value();
    if (given.format) options.format = parse_format(*given.format);
    options.samples = to_int(given.samples, "samples");
    options.exposure = given.exposure;
    if (given.tonemap) options.tonemap = parse_tonemap(*given.tonemap);
    if (given.encode) options.encode = parse_encode(*given.encode);
    options.depth_format = to_depth_format(given.depth_format);
    options.screen_reflections = given.screen_reflections;
    options.max_lod_error = given.max_lod_error;
    return options;
}

CaptureOptions capture_options(const Scene& scene, const CaptureArguments& given) {
    CaptureOptions options;
    options.size = to_int(given.size, "size");
    options.near = given.near;
    options.far = given.far;
    options.exclude = to_ids(scene, given.exclude);
    options.outputs = to_outputs(given.outputs);
    if (!given.format) {
        throw std::invalid_argument("format: expected a name, since a cubemap has faces, got None; "
                                    "`rgba8` is the smallest");
    }
    options.format = parse_format(*given.format);
    options.samples = to_int(given.samples, "samples");
    options.depth_format = to_depth_format(given.depth_format);
    options.depth_order = parse_depth_order(given.depth_order);
    options.max_lod_error = given.max_lod_error;
    if (!given.eye.is_none()) options.eye = to_vec3(given.eye, "eye");
    return options;
}

}  // namespace cubecam::bindings
