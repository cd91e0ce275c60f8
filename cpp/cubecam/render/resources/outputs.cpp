#include "cubecam/render/resources/outputs.hpp"

#include "cubecam/core/parse_name.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace cubecam {

Outputs parse_outputs(const std::vector<std::string>& names) {
    static constexpr std::array<std::pair<std::string_view, bool Outputs::*>, 8> known{{
        {"color", nullptr},
        {"distance", &Outputs::distance},
        {"z", &Outputs::z},
        {"normal", &Outputs::normal},
        {"position", &Outputs::position},
        {"id", &Outputs::id},
        {"depth", &Outputs::depth},
        {"stencil", &Outputs::stencil},
    }};
    Outputs outputs;
    for (const std::string& name : names) {
        // Colour is always there; naming it is no mistake.
        if (const auto member = parse_name("outputs", name, known)) outputs.*member = true;
    }
    return outputs;
}

}  // namespace cubecam
