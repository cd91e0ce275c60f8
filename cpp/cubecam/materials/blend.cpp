#include "cubecam/materials/blend.hpp"

#include "cubecam/core/parse_name.hpp"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

std::size_t index_of_name(std::span<const std::string_view> names, std::string_view name,
                          const std::string& before, std::string_view after) {
    std::string expected = before;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) return i;
        expected.append(i == 0 ? "'" : ", '").append(names[i]).append("'");
    }
    throw std::invalid_argument(
        expected.append(after).append(", got '").append(shortened(name)).append("'"));
}

}  // namespace

Blend parse_blend(std::string_view name) {
    return static_cast<Blend>(
        index_of_name(blend_names, name, "expected blend ", ", a Blend or None"));
}

BlendFactor parse_blend_factor(std::string_view word, std::string_view name) {
    return static_cast<BlendFactor>(
        index_of_name(blend_factor_names, word, std::string(name) + ": expected ", ""));
}

BlendEquation parse_blend_equation(std::string_view word) {
    return static_cast<BlendEquation>(
        index_of_name(blend_equation_names, word, "equation: expected ", ""));
}

std::string_view to_string(Blend blend) { return blend_names[static_cast<std::size_t>(blend)]; }

std::string_view to_string(BlendFactor factor) {
    return blend_factor_names[static_cast<std::size_t>(factor)];
}

std::string_view to_string(BlendEquation equation) {
    return blend_equation_names[static_cast<std::size_t>(equation)];
}

}  // namespace cubecam
