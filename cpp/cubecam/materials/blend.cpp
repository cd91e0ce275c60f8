#include "cubecam/materials/blend.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

/// In the order of Blend.
constexpr std::array<std::string_view, 6> blend_names = {"opaque",   "alpha",    "alpha_keep",
                                                         "additive", "multiply", "premultiplied"};

}  // namespace

Blend parse_blend(std::string_view name) {
    std::string expected;
    for (std::size_t i = 0; i < blend_names.size(); ++i) {
        if (name == blend_names[i]) return static_cast<Blend>(i);
        expected.append(expected.empty() ? "'" : ", '").append(blend_names[i]).append("'");
    }
    throw std::invalid_argument("expected blend " + expected + " or None, got '" +
                                std::string(name) + "'");
}

std::string_view to_string(Blend blend) { return blend_names[static_cast<std::size_t>(blend)]; }

}  // namespace cubecam
