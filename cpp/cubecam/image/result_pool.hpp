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

    /// Each call of a renderer, and each conversion, calls this once.
    void next_call();

    /// Frees what the pool holds, and returns how many bytes that was.
    std::size_t clear();

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

/// Memory for the result of a conversion, from a pool of this process of at most
/// conversion_results bytes. It is a reserve of the checks of memory (core/memory.hpp).
std::shared_ptr<PixelBuffer> result_memory(std::size_t bytes);
inline constexpr std::size_t conversion_results = std::size_t{64} << 20;

}  // namespace cubecam
