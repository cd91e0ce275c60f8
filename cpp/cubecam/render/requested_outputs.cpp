#include "cubecam/render/requested_outputs.hpp"

#include "cubecam/core/parse_name.hpp"
#include "cubecam/render/passes/output_declarations.hpp"

#include <map>
#include <stdexcept>

namespace cubecam {
namespace {

/// The outputs that the scene's materials declare: channels by name.
std::map<std::string, int> outputs_in(const SceneSnapshot& scene) {
    std::map<std::string, int> channels;
    for (const NodeSnapshot& node : scene.nodes) {
        const auto& user = node.material.value.traits().user_code;
        if (!user) continue;
        for (const NamedOutput& output : declared_outputs(*user->fragment)) {
            const auto [held, added] = channels.try_emplace(output.name, output.channels);
            if (held->second == output.channels) continue;
            throw std::invalid_argument(
                "outputs: expected all materials to declare \"" + output.name +
                "\" with one type, got " +
                std::string(glsl_type(held->second, OutputType::float32)) + " and " +
                std::string(glsl_type(output.channels, OutputType::float32)));
        }
    }
    return channels;
}

}  // namespace

Outputs resolve_outputs(const RequestedOutputs& requested, const SceneSnapshot& scene) {
    Outputs outputs = requested.outputs;
    if (requested.others.empty()) return outputs;
    const std::map<std::string, int> declared = outputs_in(scene);
    for (const std::string& name : requested.others) {
        const auto found = declared.find(name);
        if (found != declared.end()) {
            outputs.add(NamedOutput{found->first, found->second});
            continue;
        }
        std::string known = known_outputs();
        for (const auto& [other, channels] : declared) known += ", \"" + other + '"';
        throw std::invalid_argument("outputs: expected " + known +
                                    (declared.empty() ? ", or what the GLSL of a visible node's "
                                                        "material declares"
                                                      : "") +
                                    ", got \"" + shortened(name) + '"');
    }
    return outputs;
}

TargetRequest frame_request(const SceneSnapshot& scene, const FrameOptions& options,
                            std::size_t views) {
    const int count = static_cast<int>(views);
    return {.shape = count == 1 ? TargetShape::flat() : TargetShape::array(count),
            .width = options.width,
            .height = options.height,
            .samples = options.samples,
            .format = options.format,
            .outputs = resolve_outputs(options.outputs, scene),
            .depth_format = options.depth_format,
            .color = options.color};
}

TargetRequest capture_request(const SceneSnapshot& scene, const CaptureOptions& options,
                              const TargetShape& shape) {
    return {.shape = shape,
            .width = options.size,
            .height = options.size,
            .samples = options.samples,
            .format = options.format,
            .outputs = resolve_outputs(options.outputs, scene),
            .depth_format = options.depth_format,
            .depth_order = options.depth_order};
}

}  // namespace cubecam
