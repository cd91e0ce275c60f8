/// Names of formats, from Python and back; None stands for no buffer.
#pragma once

#include "choice.hpp"

#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/format.hpp"

#include <optional>

namespace cubecam::bindings {

using FormatName = Choice<format_names>;
using DepthFormatName = std::optional<Choice<depth_format_names>>;

inline DepthFormat to_depth_format(const DepthFormatName& name) {
    return name ? parse_depth_format(*name) : DepthFormat::none;
}

inline DepthFormatName from_depth_format(DepthFormat format) {
    if (format == DepthFormat::none) return std::nullopt;
    return to_string(format);
}

}  // namespace cubecam::bindings
