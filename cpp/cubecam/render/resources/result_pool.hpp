#pragma once

#include "cubecam/image/pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>

namespace cubecam {

/// Memory of results. What a caller lets go comes back and serves the next result of its size: the
/// kernel would fill every page of fresh memory with zeroes first, which takes longer than reading
/// a picture.
///
/// It holds no more than `capacity` bytes, and none that the last `patience` calls had no use for.
/// Any thread may let a result go, in a forked process as well, and after the pool is gone.
class ResultPool : public std::enable_shared_from_this<ResultPool> {
public:
    static constexpr std::uint64_t patience = 8;

    explicit ResultPool(std::size_t capacity) : capacity_(capacity) {}

    /// Contents are whatever the memory held.
    std::shared_ptr<PixelBuffer> take(std::size_t bytes);

    /// To be called once a call of the renderer, by one thread at a time.
    void next_call();

private:
    struct Held {
        std::unique_ptr<PixelBuffer> memory;
        std::uint64_t call;  ///< in which it came back
    };

    void give_back(std::unique_ptr<PixelBuffer> memory) noexcept;

    const std::size_t capacity_;
    std::mutex mutex_;
    std::list<Held> held_;  // the last one to come back first
    std::size_t bytes_ = 0;
    std::uint64_t call_ = 0;
};

}  // namespace cubecam
