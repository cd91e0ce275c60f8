#include "cubecam/render/passes/tonemap.hpp"

#include "cubecam/core/parse_name.hpp"

#include <array>
#include <utility>

namespace cubecam {

Tonemap parse_tonemap(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Tonemap>, 3> known{
        {{"reinhard", Tonemap::reinhard}, {"aces", Tonemap::aces}, {"neutral", Tonemap::neutral}}};
    return parse_name("tonemap", name, known);
}

Encode parse_encode(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Encode>, 1> known{
        {{"srgb", Encode::srgb}}};
    return parse_name("encode", name, known);
}

}  // namespace cubecam
