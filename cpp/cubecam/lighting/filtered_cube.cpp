#include "cubecam/lighting/filtered_cube.hpp"

namespace cubecam {

float level_roughness(int level, int levels) {
    return levels < 2 ? 0.0F : static_cast<float>(level) / static_cast<float>(levels - 1);
}

}  // namespace cubecam
