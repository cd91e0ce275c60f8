#include "cubecam/render/resources/depth_order.hpp"

namespace cubecam {

DepthOrder parse_depth_order(std::string_view name) {
    return parse_name("depth_order", name, depth_order_names);
}

}  // namespace cubecam
