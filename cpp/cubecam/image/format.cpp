#include "cubecam/image/format.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

constexpr std::array<std::pair<Format, std::string_view>, 4> format_names = {{
    {Format::rgba8, "rgba8"},
    {Format::rgba16f, "rgba16f"},
    {Format::rgba32f, "rgba32f"},
    {Format::rgb565, "rgb565"},
}};

}  // namespace

Format parse_format(std::string_view name) {
    for (const auto& [format, known] : format_names) {
        if (name == known) return format;
    }
    throw std::invalid_argument("expected format 'rgba8', 'rgba16f', 'rgba32f' or 'rgb565', got '" +
                                std::string(name) + "'");
}

std::string_view to_string(Format format) {
    return format_names[static_cast<std::size_t>(format)].second;
}

}  // namespace cubecam
