#include "cubecam/cubemap/cubemap.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/core/revision.hpp"
#include "cubecam/cubemap/box_filter.hpp"
#include "cubecam/cubemap/cube_texels.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

void check_outputs(const OutputList& outputs, int size) {
    const std::size_t texels =
        face_count * static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    for (const OutputValues& output : outputs) {
        const std::size_t expected = texels * output.texel_size();
        if (output.values->size() == expected) continue;
        throw std::invalid_argument(output.name + ": expected " + std::to_string(expected) +
                                    " bytes, got " + std::to_string(output.values->size()));
    }
}

void check_levels(const CubeLevels* levels, const CubeMapData& data) {
    if (levels == nullptr) return;
    float before = 0.0F;
    for (const CubeLevel& level : *levels) {
        const std::size_t expected = face_count * static_cast<std::size_t>(level.size) *
                                     static_cast<std::size_t>(level.size) *
                                     static_cast<std::size_t>(data.channels) *
                                     dtype_size(data.dtype);
        if (level.pixels->size() != expected) {
            throw std::invalid_argument("levels: expected " + std::to_string(expected) +
                                        " bytes for " + std::to_string(level.size) +
                                        " texels along an edge, got " +
                                        std::to_string(level.pixels->size()));
        }
        if (!(level.roughness > before && level.roughness <= 1.0F)) {
            throw std::invalid_argument("roughness: expected numbers that grow from 0 to at most "
                                        "1, got " +
                                        std::to_string(level.roughness) + " after " +
                                        std::to_string(before));
        }
        before = level.roughness;
    }
}

std::array<std::uint64_t, face_count> new_face_revisions() {
    std::array<std::uint64_t, face_count> revisions;
    for (std::uint64_t& revision : revisions) revision = next_revision();
    return revisions;
}

/// Compares bytes, so that NaN (the position of the background) equals itself.
template <typename T>
bool same_values(const std::shared_ptr<const Buffer<T>>& a,
                 const std::shared_ptr<const Buffer<T>>& b) {
    if (a == b) return true;
    return a && b && a->size() == b->size() &&
           std::memcmp(a->data(), b->data(), a->size() * sizeof(T)) == 0;
}

/// Computes again, by sum_tap, the numbers of a row that are not finite.
template <typename Pixel>
[[gnu::noinline]] void mend_row(const Pixel* face, int size, int channels, const BoxTap& down,
                                const std::vector<BoxTap>& taps, std::vector<float>& row) {
    for (std::size_t at = 0; at < row.size(); ++at) {
        if (is_finite<1>(row[at])) continue;
        const std::size_t channel = at % static_cast<std::size_t>(channels);
        const BoxTap& across = taps[at / static_cast<std::size_t>(channels)];
        row[at] = sum_tap(down, [&](int i) {
            return sum_tap(across, [&](int j) {
                const auto texel =
                    static_cast<std::size_t>(down.first + i) * static_cast<std::size_t>(size) +
                    static_cast<std::size_t>(across.first + j);
                return to_float(face[texel * static_cast<std::size_t>(channels) + channel]);
            });
        });
    }
}

/// Where a lookup meets a cube: between two levels, with the weight of the second.
struct LevelPlace {
    FaceUv<float> uv;
    std::size_t below;
    float weight;
};

/// Computes again, as sums of weighted texels, the lookups begin..end that are not finite.
template <typename Pixel, int channels, typename PlaceOf>
[[gnu::noinline]] void mend_lookups(const std::vector<CubeTexels<Pixel, channels>>& levels,
                                    const PlaceOf& place_of, std::size_t begin, std::size_t end,
                                    float* to) {
    for (std::size_t i = begin; i < end; ++i) {
        const Lane<channels> found = load_texel<channels>(to + channels * i);
        if (is_finite<channels>(found)) continue;
        const auto [uv, below, weight] = place_of(i);
        Lane<channels> sum = levels[below].sum_bilinear(uv.face, uv.s, uv.t);
        if (weight > 0) {
            sum = sum * (1.0f - weight) +
                  levels[below + 1].sum_bilinear(uv.face, uv.s, uv.t) * weight;
        }
        store_texel<channels>(finite_or<channels>(found, sum), to + channels * i);
    }
}

PixelBuffer halve_faces(const std::byte* pixels, int size, int channels, DType dtype) {
    const int half = std::max(1, size / 2);
    const auto from_values = static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
                             static_cast<std::size_t>(channels);
    const auto to_values = static_cast<std::size_t>(half) * static_cast<std::size_t>(half) *
                           static_cast<std::size_t>(channels);
    PixelBuffer result(face_count * to_values * dtype_size(dtype));

    std::vector<BoxTap> taps;
    const double scale = static_cast<double>(size) / half;
    for (int i = 0; i < half; ++i)
        taps.push_back(box_tap((i + 0.5) * scale - 0.5, BoxWidth(scale)));

    parallel_for(0, face_count, 1, [&](std::size_t begin, std::size_t end) {
        std::vector<float> row(static_cast<std::size_t>(half) * static_cast<std::size_t>(channels));
        for (std::size_t face = begin; face < end; ++face) {
            with_pixels(
                dtype, pixels + face * from_values * dtype_size(dtype), [&](const auto* from) {
                    for (int y = 0; y < half; ++y) {
                        poll_interrupts();
                        const BoxTap& down = taps[static_cast<std::size_t>(y)];
                        for (int x = 0; x < half; ++x) {
                            const BoxTap& across = taps[static_cast<std::size_t>(x)];
                            for (int c = 0; c < channels; ++c) {
                                row[static_cast<std::size_t>(x * channels + c)] =
                                    apply_tap<Reach::far>(down, [&](int i) {
                                        const auto* line =
                                            from + static_cast<std::ptrdiff_t>(down.first + i) *
                                                       size * channels;
                                        return apply_tap<Reach::far>(across, [&](int j) {
                                            return to_float(
                                                line[(across.first + j) * channels + c]);
                                        });
                                    });
                            }
                        }
                        if (!all_finite(row.data(), row.size())) [[unlikely]] {
                            mend_row(from, size, channels, down, taps, row);
                        }
                        floats_to_pixels(
                            dtype, row.data(), row.size(),
                            result.data() +
                                (face * to_values + static_cast<std::size_t>(y) * row.size()) *
                                    dtype_size(dtype));
                    }
                });
        }
    });
    return result;
}

}  // namespace

CubeMap::CubeMap(int size, int channels, DType dtype, std::shared_ptr<PixelBuffer> pixels,
                 bool mipmaps, OutputList outputs, Encoding encoding,
                 std::shared_ptr<const CubeLevels> levels)
    : outputs_(std::move(outputs)) {
    if (size < 1) {
        throw std::invalid_argument("size: expected at least 1, got " + std::to_string(size));
    }
    if (channels != 1 && channels != 3 && channels != 4) {
        throw std::invalid_argument("channels: expected 1, 3 or 4, got " +
                                    std::to_string(channels));
    }
    CubeMapData data{
        size, channels, dtype, mipmaps, encoding, nullptr, new_face_revisions(), next_revision()};
    if (pixels->size() != face_count * data.face_bytes()) {
        throw std::invalid_argument(
            "pixels: expected " + std::to_string(face_count * data.face_bytes()) + " bytes (6 x " +
            std::to_string(size) + " x " + std::to_string(size) + " x " + std::to_string(channels) +
            " " + dtype_name(dtype) + "), got " + std::to_string(pixels->size()));
    }
    check_outputs(outputs_, size);
    check_levels(levels.get(), data);
    data.levels = std::move(levels);
    // The buffer itself is not const: set_face may write to it when there is no other owner.
    data.pixels = std::move(pixels);
    set_data(std::move(data));
}

void CubeMap::set_data(CubeMapData data) {
    data_ = std::make_shared<const CubeMapData>(std::move(data));
    revision_.set(data_->revision);
}

CubeMap::CubeMap(const CubeMap& other) {
    const std::lock_guard lock(other.mutex_);
    CubeMapData data = *other.data_;
    data.face_revisions = new_face_revisions();
    data.revision = next_revision();
    set_data(std::move(data));
    outputs_ = other.outputs_;
    mip_chain_ = other.mip_chain_;
}

std::shared_ptr<const CubeMapData> CubeMap::data() const {
    const std::lock_guard lock(mutex_);
    return data_;
}

void CubeMap::set_face(Face face, std::span<const std::byte> pixels) {
    const std::lock_guard lock(mutex_);
    if (data_->levels) {
        throw std::invalid_argument("set_face: expected a cubemap without filtered levels, got " +
                                    std::to_string(data_->levels->size() + 1) +
                                    " levels, which would not belong to the new face");
    }
    const std::size_t bytes = data_->face_bytes();
    if (pixels.size() != bytes) {
        throw std::invalid_argument(
            "pixels: expected " + std::to_string(bytes) + " bytes (" + std::to_string(data_->size) +
            " x " + std::to_string(data_->size) + " x " + std::to_string(data_->channels) + " " +
            dtype_name(data_->dtype) + "), got " + std::to_string(pixels.size()));
    }
    if (std::memcmp(data_->face_pixels(face).data(), pixels.data(), bytes) == 0) return;

    CubeMapData next = *data_;
    // If this state has no other owner (and cannot get one while we hold the mutex), the new face
    // is written into its memory: six faces that arrive one by one then cost one copy, not six. The
    // two owners here are data_ and next. The fence pairs with the release of the last other owner.
    const bool alone = data_.use_count() == 1 && next.pixels.use_count() == 2;
    if (alone) {
        std::atomic_thread_fence(std::memory_order_acquire);
    } else {
        next.pixels = std::make_shared<PixelBuffer>(*next.pixels);
    }
    auto* writable = const_cast<PixelBuffer*>(next.pixels.get());
    std::memcpy(writable->data() + face_index(face) * bytes, pixels.data(), bytes);
    next.face_revisions[face_index(face)] = next_revision();
    next.revision = next_revision();
    set_data(std::move(next));
    mip_chain_.reset();
}

std::shared_ptr<const CubeMap::MipChain> CubeMap::mip_chain() const {
    std::shared_ptr<const CubeMapData> state;
    {
        const std::lock_guard lock(mutex_);
        if (mip_chain_) return mip_chain_;
        state = data_;
    }
    auto chain =
        std::make_shared<const MipChain>(state->mipmaps ? make_mip_chain(*state) : MipChain());
    const std::lock_guard lock(mutex_);
    if (data_ == state) mip_chain_ = chain;
    return chain;
}

void CubeMap::sample(const float* directions, std::size_t count, const float* lods,
                     std::size_t lod_count, float* to) const {
    // Pixels and mip chain must belong to one state, even if set_face runs in between.
    const std::shared_ptr<const CubeMapData> state = data();
    std::shared_ptr<const MipChain> chain;
    if (state->mipmaps && lods) {
        chain = mip_chain();
        if (data() != state) chain = std::make_shared<const MipChain>(make_mip_chain(*state));
    }
    sample_cube(*state, chain.get(), directions, count, lods, lod_count, to);
}

bool CubeMap::same_contents(const CubeMap& other) const {
    if (this == &other) return true;
    const auto a = data();
    const auto b = other.data();
    const auto same_output = [](const OutputValues& p, const OutputValues& q) {
        return p.name == q.name && p.channels == q.channels && p.type == q.type &&
               same_values<std::byte>(p.values, q.values);
    };
    const auto same_level = [](const CubeLevel& p, const CubeLevel& q) {
        return p.size == q.size && p.roughness == q.roughness &&
               same_values<std::byte>(p.pixels, q.pixels);
    };
    const auto& p = a->levels;
    const auto& q = b->levels;
    const bool same_levels =
        p == q || (p && q && std::equal(p->begin(), p->end(), q->begin(), q->end(), same_level));
    return same_levels && a->size == b->size && a->channels == b->channels &&
           a->dtype == b->dtype && a->mipmaps == b->mipmaps && a->encoding == b->encoding &&
           same_values<std::byte>(a->pixels, b->pixels) &&
           std::equal(outputs_.begin(), outputs_.end(), other.outputs_.begin(),
                      other.outputs_.end(), same_output);
}

CubeMap::MipChain make_mip_chain(const CubeMapData& data) {
    CubeMap::MipChain chain;
    const std::byte* level = data.pixels->data();
    for (int size = data.size; size > 1; size = std::max(1, size / 2)) {
        chain.push_back(halve_faces(level, size, data.channels, data.dtype));
        level = chain.back().data();
    }
    return chain;
}

void sample_cube(const CubeMapData& data, const CubeMap::MipChain* chain, const float* directions,
                 std::size_t count, const float* lods, std::size_t lod_count, float* to) {
    const auto top = static_cast<float>(data.mipmaps && chain ? chain->size() : 0);
    with_channels(data.channels, [&](auto constant) {
        constexpr int channels = decltype(constant)::value;
        with_pixels(data.dtype, data.pixels->data(), [&](const auto* pixels) {
            using Texels = CubeTexels<std::remove_cvref_t<decltype(*pixels)>, channels>;
            std::vector<Texels> levels = {{pixels, data.size}};
            for (std::size_t i = 0; i < static_cast<std::size_t>(top); ++i) {
                levels.push_back({reinterpret_cast<decltype(pixels)>((*chain)[i].data()),
                                  std::max(1, levels.back().size / 2)});
            }
            const auto place_of = [&](std::size_t i) {
                const float* d = directions + 3 * i;
                const float level = lods ? lods[lod_count == 1 ? 0 : i] : 0.0f;
                const float lod = std::clamp(level, 0.0f, top);
                const auto below = static_cast<std::size_t>(lod);
                return LevelPlace{direction_to_face_uv(glm::vec3(d[0], d[1], d[2])), below,
                                  lod - static_cast<float>(below)};
            };
            constexpr std::size_t piece = 1 << 12;  // whose results stay in the cache
            parallel_for(0, count, piece, [&](std::size_t first, std::size_t last) {
                for (std::size_t begin = first; begin < last; begin += piece) {
                    const std::size_t end = std::min(begin + piece, last);
                    for (std::size_t i = begin; i < end; ++i) {
                        const auto [uv, below, weight] = place_of(i);
                        Lane<channels> texel = levels[below].bilinear(uv.face, uv.s, uv.t);
                        if (weight > 0) {
                            texel = mix_texels(
                                texel, levels[below + 1].bilinear(uv.face, uv.s, uv.t), weight);
                        }
                        store_texel<channels>(texel, to + channels * i);
                    }
                    if (all_finite(to + channels * begin, channels * (end - begin))) continue;
                    mend_lookups(levels, place_of, begin, end, to);
                }
            });
        });
    });
}

}  // namespace cubecam
