#pragma once

#include "cubecam/core/parse_name.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace cubecam {

/// What the numbers of a picture's colours mean: proportional to light, or encoded with the
/// transfer function of IEC 61966-2-1, as 8-bit files are. Alpha is linear in both.
enum class Encoding : std::uint8_t { linear, srgb };

inline constexpr std::array<std::pair<std::string_view, Encoding>, 2> encoding_names{
    {{"linear", Encoding::linear}, {"srgb", Encoding::srgb}}};

/// @throws std::invalid_argument for any other name.
inline Encoding parse_encoding(std::string_view name) {
    return parse_name("encoding", name, encoding_names);
}

inline std::string_view to_string(Encoding encoding) {
    return encoding_names[static_cast<std::size_t>(encoding)].first;
}

/// Whether a colour consists of zeros and ones, which are the same numbers in both encodings.
inline bool zeros_and_ones(const glm::vec4& color) {
    const auto exact = [](float value) { return value == 0.0F || value == 1.0F; };
    return exact(color.r) && exact(color.g) && exact(color.b);
}

}  // namespace cubecam
