#include "cubecam/image/depth_format.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

constexpr std::array<std::pair<DepthFormat, std::string_view>, 6> depth_format_names = {{
    {DepthFormat::depth_component16, "depth_component16"},
    {DepthFormat::depth_component24, "depth_component24"},
    {DepthFormat::depth_component32f, "depth_component32f"},
    {DepthFormat::depth24_stencil8, "depth24_stencil8"},
    {DepthFormat::depth32f_stencil8, "depth32f_stencil8"},
    {DepthFormat::stencil_index8, "stencil_index8"},
}};

}  // namespace

DepthFormat parse_depth_format(std::string_view name) {
    std::string expected;
    for (const auto& [format, known] : depth_format_names) {
        if (name == known) return format;
        expected += "'" + std::string(known) + "', ";
    }
    throw std::invalid_argument("expected depth_format " + expected + "or None, got '" +
                                std::string(name) + "'");
}

std::string_view to_string(DepthFormat format) {
    for (const auto& [known, name] : depth_format_names) {
        if (format == known) return name;
    }
    return "none";
}

}  // namespace cubecam
