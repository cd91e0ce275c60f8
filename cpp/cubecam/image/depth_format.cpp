#include "cubecam/image/depth_format.hpp"

#include "cubecam/core/parse_name.hpp"

#include <stdexcept>
#include <string>

namespace cubecam {

DepthFormat parse_depth_format(std::string_view name) {
    std::string expected;
    for (const auto& [known, format] : depth_format_names) {
        if (name == known) return format;
        expected += "'" + std::string(known) + "', ";
    }
    throw std::invalid_argument("expected depth_format " + expected + "or None, got '" +
                                shortened(name) + "'");
}

std::string_view to_string(DepthFormat format) {
    for (const auto& [name, known] : depth_format_names) {
        if (format == known) return name;
    }
    return "none";
}

}  // namespace cubecam
