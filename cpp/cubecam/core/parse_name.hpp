#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace cubecam {

/// Returns the value that `name` stands for. `what` is the argument that has this name as its
/// value.
/// @throws std::invalid_argument that lists the known names.
template <class Value, std::size_t N>
Value parse_name(std::string_view what, std::string_view name,
                 const std::array<std::pair<std::string_view, Value>, N>& known) {
    std::string expected;
    for (const auto& [text, value] : known) {
        if (text == name) return value;
        expected += (expected.empty() ? "\"" : ", \"") + std::string(text) + "\"";
    }
    throw std::invalid_argument(std::string(what) + ": expected " + expected + ", got \"" +
                                std::string(name) + "\"");
}

}  // namespace cubecam
