#pragma once

#include "cubecam/image/pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>

namespace cubecam {

/// Memory of results. The memory of a result that its owner has released serves the next result of
/// the same size: the kernel would fill every page of new memory with zeroes first, which takes
/// longer than reading a picture.
///
/// The pool holds at most `capacity` bytes, and frees memory that the last `patience` calls did not
/// use. Any thread may release a result, also in a forked process and after the end of the pool.
class ResultPool : public std::enable_shared_from_this<ResultPool> {
public:
    static constexpr std::uint64_t patience = 8;

    explicit ResultPool(std::size_t capacity) : capacity_(capacity) {}

    /// Returns memory with undefined contents.
    std::shared_ptr<PixelBuffer> take(std::size_t bytes);

    /// Each call of the renderer calls this once, one thread at a time.
    void next_call();

private:
    struct Held {
        std::unique_ptr<PixelBuffer> memory;
        std::uint64_t call;  ///< during which it was released
    };

    void give_back(std::unique_ptr<PixelBuffer> memory) noexcept;

    const std::size_t capacity_;
    std::mutex mutex_;
    std::list<Held> held_;  // the most recently released first
    std::size_t bytes_ = 0;
    std::uint64_t call_ = 0;
};

}  // namespace cubecam
