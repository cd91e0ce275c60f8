#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/image/result_pool.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/resources/read_ring.hpp"
#include "cubecam/render/resources/target.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cubecam {

/// An output as it is read: the values of a texel.
struct OutputKind {
    std::string name;
    int channels;
    OutputType type;
    OutputSource source;
    std::size_t slot;  ///< of a shader's output

    std::size_t bytes() const {
        return output_type_size(type) * static_cast<std::size_t>(channels);
    }
};

/// The outputs in the order in which results list them.
std::vector<OutputKind> output_kinds(const Outputs& outputs);

/// The bytes of a texel of a picture in a result, which has no packed formats.
inline std::size_t color_bytes(Format format) {
    return format == Format::rgb565 ? 4 : texel_size(format);
}

/// Where the layers of a target are written, one after the other.
struct LayerMemory {
    std::byte* color = nullptr;       ///< null: the target has no colour
    std::vector<std::byte*> outputs;  ///< in the order of output_kinds
};

/// The main memory that reading a target takes: the results, and one layer on its way.
std::size_t result_bytes(const TargetDescription& description);

/// Pixels on their way from the GPU.
class PixelsUnderWay {
public:
    virtual ~PixelsUnderWay() = default;
    /// Waits for them. The context must be current, and the same. Polls.
    virtual void arrive() = 0;
};

/// A result whose memory is filled now, or when its pixels have arrived.
template <class Result>
struct Reading {
    Result result;
    std::unique_ptr<PixelsUnderWay> pixels;  ///< null: they are there

    /// Waits for the pixels.
    Result finished() && {
        if (pixels != nullptr) pixels->arrive();
        return std::move(result);
    }
};

/// Copies of a target's contents. Frames are flipped so that row 0 is on top, with several views
/// one below the other; cube faces are copied as they are. After these functions the target may
/// change.
Reading<Frame> start_frame(const gl::Context& context, Target& target, ResultPool& pool,
                           ReadRing& ring);
Reading<std::shared_ptr<CubeMap>> start_cube(const gl::Context& context, Target& target,
                                             ResultPool& pool, ReadRing& ring, Encoding encoding);

/// A texel of each buffer where nothing is drawn: the bytes of the colour, then those of each
/// output.
struct ClearTexels {
    std::vector<std::byte> color;
    std::vector<std::vector<std::byte>> outputs;
};
/// Reads the texels from a target that was cleared.
ClearTexels read_texels(const gl::Context& context, Target& target, ResultPool& pool,
                        ReadRing& ring);

/// Copies the layers that were drawn into given memory, and fills the others with a texel.
void read_layers(const gl::Context& context, Target& target, const std::vector<bool>& drawn,
                 const ClearTexels& clear, ResultPool& pool, ReadRing& ring, const LayerMemory& to);

}  // namespace cubecam
