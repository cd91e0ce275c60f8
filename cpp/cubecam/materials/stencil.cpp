#include "cubecam/materials/stencil.hpp"

#include "cubecam/core/parse_name.hpp"

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

std::size_t index_of_word(const std::array<std::string_view, 8>& words, std::string_view word,
                          std::string_view name) {
    const std::size_t place = place_of_name(words, word);
    if (place < words.size()) return place;
    throw std::invalid_argument(std::string(name) + ": expected " + quoted_names(words) +
                                ", got '" + shortened(word) + "'");
}

}  // namespace

StencilFunc parse_stencil_func(std::string_view word, std::string_view name) {
    return static_cast<StencilFunc>(index_of_word(stencil_func_names, word, name));
}

StencilOp parse_stencil_op(std::string_view word, std::string_view name) {
    return static_cast<StencilOp>(index_of_word(stencil_op_names, word, name));
}

std::string_view to_string(StencilFunc func) {
    return stencil_func_names[static_cast<std::size_t>(func)];
}

std::string_view to_string(StencilOp op) { return stencil_op_names[static_cast<std::size_t>(op)]; }

}  // namespace cubecam
