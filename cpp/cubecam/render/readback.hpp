#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/resources/read_ring.hpp"
#include "cubecam/render/resources/result_pool.hpp"
#include "cubecam/render/resources/target.hpp"

#include <cstddef>
#include <memory>
#include <utility>

namespace cubecam {

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

}  // namespace cubecam
