/// Taps that are kept from one conversion to the next of the same sizes. Only the .cpp files of
/// cubemap/ include this header.
#pragma once

#include "cubecam/core/memory.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/tap_list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace cubecam {

/// What the taps of a conversion depend on.
struct TapKey {
    bool to_cube;
    int width;  ///< of the panorama
    int height;
    int size;  ///< of the faces
    Center center;
    Sampling sampling;

    bool operator==(const TapKey&) const = default;
};

/// How a conversion fills its tiles, with the taps that are kept. A plan that the cache holds never
/// changes, so threads may share it.
class TapPlan {
public:
    virtual ~TapPlan() = default;

    /// How many bytes the taps of all tiles will take, about.
    virtual double taps_bytes() const = 0;
    /// The bytes of the plan and its kept taps.
    std::size_t bytes() const;

    /// Makes room for the taps of all tiles: `kept` then returns memory to fill.
    void keep(std::size_t tiles) { kept_.resize(tiles); }
    bool keeps() const { return !kept_.empty(); }
    TileTaps& kept(std::size_t tile) { return kept_[tile]; }

protected:
    std::size_t own_bytes_ = 0;

private:
    std::vector<TileTaps> kept_;
};

/// The plans of the last conversions, of at most `capacity` bytes. Taps are kept from the second
/// conversion of the same sizes on, so a single one takes no memory for them, and are let go after
/// `patience` conversions without them, or when something else needs the memory.
class TapCache {
public:
    static constexpr std::size_t capacity = std::size_t{64} << 20;
    static constexpr std::uint64_t patience = 64;

    /// The plan for a key, or null; then `wanted` says whether to keep the taps of the next one.
    std::shared_ptr<TapPlan> find(const TapKey& key, bool& wanted);
    void add(const TapKey& key, std::shared_ptr<TapPlan> plan);
    /// Frees all plans, and returns how many bytes they had.
    std::size_t clear();
    std::size_t bytes();

    /// The one of this process. It can be used in a forked process, too.
    static TapCache& instance();

private:
    struct Entry {
        TapKey key;
        std::shared_ptr<TapPlan> plan;  ///< null: the key was seen, its taps are not kept
        std::size_t bytes;
        std::uint64_t used;
    };

    /// Removes what is too old or too much; the caller frees it after the lock.
    void shrink(std::vector<Entry>& freed);

    std::mutex mutex_;
    std::vector<Entry> entries_;  ///< the last used one first
    std::uint64_t calls_ = 0;
};

/// In how many parts a batch of pictures is cut, so that with all tiles there are enough pieces for
/// all threads. The taps of a tile serve all pictures of a part; a part is small enough for Ctrl-C.
inline std::size_t batch_parts(std::size_t pictures, std::size_t tiles) {
    constexpr std::size_t most = 16;
    const std::size_t pieces = 4 * worker_count();
    return std::min(pictures, std::max((pieces + tiles - 1) / tiles, (pictures + most - 1) / most));
}

/// Calls fill(tile, part, first, last, scratch) on all cores for each tile and each part of the
/// pictures; a part has the pictures from `first` up to `last`, which is excluded. The tiles of one
/// thread reuse a Scratch.
template <typename Scratch, typename Fill>
void for_each_tile(std::size_t pictures, std::size_t tiles, const Fill& fill) {
    const std::size_t parts = batch_parts(pictures, tiles);
    parallel_for_with<Scratch>(0, tiles * parts, 1,
                               [&](std::size_t begin, std::size_t end, Scratch& scratch) {
                                   for (std::size_t i = begin; i < end; ++i) {
                                       const std::size_t part = i % parts;
                                       fill(i / parts, part, part * pictures / parts,
                                            (part + 1) * pictures / parts, scratch);
                                   }
                               });
}

/// Returns the plan for a key: one that is kept, or what `make()` returns. The second time, its
/// taps are to be kept: `fresh` is true then, and the caller gives the filled plan to the cache.
template <typename Plan, typename Make>
std::shared_ptr<Plan> plan_for(const TapKey& key, const Make& make, bool& fresh) {
    bool wanted = false;
    fresh = false;
    if (auto kept = TapCache::instance().find(key, wanted)) {
        return std::static_pointer_cast<Plan>(std::move(kept));
    }
    std::shared_ptr<Plan> plan = make();
    const double bytes = plan->taps_bytes();
    if (wanted && bytes <= static_cast<double>(TapCache::capacity) / 2 &&
        4 * bytes <= memory_left().bytes) {
        plan->keep(plan->tiles());
        fresh = true;
    }
    return plan;
}

}  // namespace cubecam
