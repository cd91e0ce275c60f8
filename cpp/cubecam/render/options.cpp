#include "cubecam/render/options.hpp"

#include <array>
#include <stdexcept>
#include <utility>

namespace cubecam {
namespace {

template <class Value, std::size_t N>
Value parse(std::string_view what, std::string_view name,
            const std::array<std::pair<std::string_view, Value>, N>& known) {
    std::string expected;
    for (const auto& [text, value] : known) {
        if (text == name) return value;
        expected += (expected.empty() ? "\"" : ", \"") + std::string(text) + "\"";
    }
    throw std::invalid_argument(std::string(what) + ": expected " + expected + ", got \"" +
                                std::string(name) + "\"");
}

}  // namespace

Outputs parse_outputs(const std::vector<std::string>& names) {
    static constexpr std::array<std::pair<std::string_view, bool Outputs::*>, 6> known{{
        {"color", nullptr},
        {"distance", &Outputs::distance},
        {"z", &Outputs::z},
        {"normal", &Outputs::normal},
        {"position", &Outputs::position},
        {"id", &Outputs::id},
    }};
    Outputs outputs;
    for (const std::string& name : names) {
        // Colour is always there; naming it is no mistake.
        if (const auto member = parse("outputs", name, known)) outputs.*member = true;
    }
    return outputs;
}

Tonemap parse_tonemap(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Tonemap>, 3> known{
        {{"reinhard", Tonemap::reinhard}, {"aces", Tonemap::aces}, {"neutral", Tonemap::neutral}}};
    return parse("tonemap", name, known);
}

Encode parse_encode(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Encode>, 1> known{
        {{"srgb", Encode::srgb}}};
    return parse("encode", name, known);
}

}  // namespace cubecam
