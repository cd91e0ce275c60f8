/// Names of formats, from Python and back; None stands for no buffer.
#pragma once

#include "cubecam/image/depth_format.hpp"

#include <optional>
#include <string>

namespace cubecam::bindings {

inline DepthFormat to_depth_format(const std::optional<std::string>& name) {
    return name ? parse_depth_format(*name) : DepthFormat::none;
}

inline std::optional<std::string> from_depth_format(DepthFormat format) {
    if (format == DepthFormat::none) return std::nullopt;
    return std::string(to_string(format));
}

}  // namespace cubecam::bindings
