#include "cubecam/render/options.hpp"

#include <array>
#include <stdexcept>
#include <utility>

namespace cubecam {
namespace {

template <class Value, std::size_t N>
Value parse(std::string_view what, std::string_view name,
            const std::array<std::pair<std::string_view, Value>, N>& known) {
    std::string expected;
    for (const auto& [text, value] : known) {
        if (text == name) return value;
        expected += (expected.empty() ? "\"" : ", \"") + std::string(text) + "\"";
    }
    throw std::invalid_argument(std::string(what) + ": expected " + expected + ", got \"" +
                                std::string(name) + "\"");
}

void check_outputs_of(const Outputs& outputs, DepthFormat depth_format) {
    const auto refuse = [&](const char* expected) {
        throw std::invalid_argument("outputs: expected " + std::string(expected) +
                                    ", got depth_format " + std::string(to_string(depth_format)));
    };
    if (outputs.stencil && !has_stencil(depth_format)) {
        refuse("\"stencil\" only with a depth_format that has one, depth24_stencil8, "
               "depth32f_stencil8 or stencil_index8");
    }
    // Nothing says which node is the nearest.
    if ((outputs.shaded() || outputs.depth) && !has_depth(depth_format)) {
        refuse(has_stencil(depth_format) ? "\"stencil\" at most without a depth buffer"
                                         : "none without a depth buffer");
    }
}

}  // namespace

void check_buffers(const FrameOptions& options) {
    check_outputs_of(options.outputs, options.depth_format);
    if (options.color) return;
    if (options.tonemap != Tonemap::none || options.encode != Encode::none) {
        throw std::invalid_argument("tonemap, encode: expected None without a colour, got format "
                                    "None");
    }
    if (options.depth_format == DepthFormat::none) {
        throw std::invalid_argument("format, depth_format: expected at least one, got None twice");
    }
}

void check_buffers(const CaptureOptions& options) {
    check_outputs_of(options.outputs, options.depth_format);
}

Outputs parse_outputs(const std::vector<std::string>& names) {
    static constexpr std::array<std::pair<std::string_view, bool Outputs::*>, 8> known{{
        {"color", nullptr},
        {"distance", &Outputs::distance},
        {"z", &Outputs::z},
        {"normal", &Outputs::normal},
        {"position", &Outputs::position},
        {"id", &Outputs::id},
        {"depth", &Outputs::depth},
        {"stencil", &Outputs::stencil},
    }};
    Outputs outputs;
    for (const std::string& name : names) {
        // Colour is always there; naming it is no mistake.
        if (const auto member = parse("outputs", name, known)) outputs.*member = true;
    }
    return outputs;
}

Tonemap parse_tonemap(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Tonemap>, 3> known{
        {{"reinhard", Tonemap::reinhard}, {"aces", Tonemap::aces}, {"neutral", Tonemap::neutral}}};
    return parse("tonemap", name, known);
}

Encode parse_encode(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Encode>, 1> known{
        {{"srgb", Encode::srgb}}};
    return parse("encode", name, known);
}

}  // namespace cubecam
