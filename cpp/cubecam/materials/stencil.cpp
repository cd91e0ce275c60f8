#include "cubecam/materials/stencil.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

// The names are in the order of the enums.
constexpr std::array<std::string_view, 8> func_names = {"never",   "less",     "equal",  "lequal",
                                                        "greater", "notequal", "gequal", "always"};
constexpr std::array<std::string_view, 8> op_names = {"keep",      "zero", "replace",   "incr",
                                                      "incr_wrap", "decr", "decr_wrap", "invert"};

std::size_t index_of_word(const std::array<std::string_view, 8>& words, std::string_view word,
                          std::string_view name) {
    std::string expected;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == word) return i;
        expected += (i == 0 ? "'" : i + 1 == words.size() ? " or '" : ", '");
        expected += std::string(words[i]) + "'";
    }
    throw std::invalid_argument(std::string(name) + ": expected " + expected + ", got '" +
                                std::string(word) + "'");
}

}  // namespace

StencilFunc parse_stencil_func(std::string_view word, std::string_view name) {
    return static_cast<StencilFunc>(index_of_word(func_names, word, name));
}

StencilOp parse_stencil_op(std::string_view word, std::string_view name) {
    return static_cast<StencilOp>(index_of_word(op_names, word, name));
}

std::string_view to_string(StencilFunc func) { return func_names[static_cast<std::size_t>(func)]; }

std::string_view to_string(StencilOp op) { return op_names[static_cast<std::size_t>(op)]; }

}  // namespace cubecam
