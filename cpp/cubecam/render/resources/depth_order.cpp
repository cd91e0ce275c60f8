#include "cubecam/render/resources/depth_order.hpp"

#include "cubecam/core/parse_name.hpp"

namespace cubecam {

DepthOrder parse_depth_order(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, DepthOrder>, 2> known{
        {{"nearest", DepthOrder::nearest}, {"farthest", DepthOrder::farthest}}};
    return parse_name("depth_order", name, known);
}

}  // namespace cubecam
