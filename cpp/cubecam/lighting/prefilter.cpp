#include "cubecam/lighting/prefilter.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cubecam {

namespace {

/// The texels with `channels` channels, as pixels.
PixelBuffer to_pixels(const FilteredLevel& level, int channels, DType dtype) {
    const auto stride = static_cast<std::size_t>(channels);
    std::vector<float> values;
    values.reserve(level.texels.size() * stride);
    for (const glm::vec4& texel : level.texels) {
        for (int c = 0; c < channels; ++c) values.push_back(texel[c]);
    }
    PixelBuffer pixels(values.size() * dtype_size(dtype));
    floats_to_pixels(dtype, values.data(), values.size(), pixels.data());
    return pixels;
}

}  // namespace

std::shared_ptr<CubeMap> prefilter(const CubeMapData& cube, int levels,
                                   const FilteredCube::Progress& progress) {
    if (levels < 2) {
        throw std::invalid_argument("levels: expected at least 2, got " + std::to_string(levels));
    }
    FilteredCube filtered({.size = cube.size, .levels = levels, .irradiance_size = 0});
    if (!filtered.update(cube, {}, progress)) return nullptr;
    auto made = std::make_shared<CubeLevels>();
    for (const FilteredLevel& level : filtered.levels()) {
        made->push_back(
            {level.size, level.roughness,
             std::make_shared<PixelBuffer>(to_pixels(level, cube.channels, cube.dtype))});
    }
    return std::make_shared<CubeMap>(cube.size, cube.channels, cube.dtype,
                                     std::make_shared<PixelBuffer>(*cube.pixels), cube.mipmaps,
                                     OutputList(), cube.encoding, std::move(made));
}

std::shared_ptr<CubeMap> irradiance(const CubeMapData& cube, int size,
                                    const FilteredCube::Progress& progress) {
    FilteredCube filtered({.size = cube.size, .levels = 1, .irradiance_size = size});
    if (!filtered.update(cube, {}, progress)) return nullptr;
    return std::make_shared<CubeMap>(size, cube.channels, cube.dtype,
                                     to_pixels(filtered.irradiance(), cube.channels, cube.dtype),
                                     cube.mipmaps, OutputList(), cube.encoding);
}

}  // namespace cubecam
