#pragma once

#include "cubecam/image/pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam {

/// The type of one number of an output.
enum class OutputType : std::uint8_t { float32, int32, uint8 };

constexpr std::size_t output_type_size(OutputType type) {
    return type == OutputType::uint8 ? 1 : 4;
}

constexpr const char* output_type_name(OutputType type) {
    return type == OutputType::float32 ? "float32" : type == OutputType::int32 ? "int32" : "uint8";
}

/// One output of a picture besides its colour, with the name that requested it. The values are in
/// the order of the picture's pixels, with `channels` numbers for each pixel.
struct OutputValues {
    std::string name;
    int channels = 1;
    OutputType type = OutputType::float32;
    std::shared_ptr<PixelBuffer> values;  ///< a cubemap shares it and never writes to it

    std::size_t texel_size() const {
        return static_cast<std::size_t>(channels) * output_type_size(type);
    }
};

using OutputList = std::vector<OutputValues>;

/// Returns the output of this name, or null if the list has none.
inline const OutputValues* find_output(const OutputList& outputs, std::string_view name) {
    for (const OutputValues& output : outputs) {
        if (output.name == name) return &output;
    }
    return nullptr;
}

}  // namespace cubecam
