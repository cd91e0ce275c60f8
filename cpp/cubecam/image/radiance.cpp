#include "cubecam/image/radiance.hpp"

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace cubecam {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr std::size_t shortest_runs = 8;
constexpr std::size_t longest_runs = 0x7fff;

/// Reads bytes and never goes beyond the last one.
class RgbeBytes {
public:
    explicit RgbeBytes(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool take(std::span<const std::uint8_t>& found, std::size_t count) {
        if (bytes_.size() < count) return false;
        found = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return true;
    }

    bool take(Rgbe& pixel) {
        std::span<const std::uint8_t> found;
        if (!take(found, 4)) return false;
        std::ranges::copy(found, pixel.begin());
        return true;
    }

    bool empty() const { return bytes_.empty(); }

private:
    std::span<const std::uint8_t> bytes_;
};

enum class RgbeFault { none, end, length, overrun };

/// The rest of a scanline without runs, or with the old ones. `line` is null to count only.
RgbeFault read_pixels(RgbeBytes& bytes, Rgbe pixel, std::size_t length, Rgbe* line) {
    std::size_t at = 0;
    const auto put = [&](std::size_t count) {
        count = std::min(count, length - at);
        if (line != nullptr) std::fill_n(line + at, count, pixel);
        at += count;
    };
    put(1);
    unsigned shift = 0;
    while (at < length) {
        Rgbe next;
        if (!bytes.take(next)) return RgbeFault::end;
        if (next[0] == 1 && next[1] == 1 && next[2] == 1) {
            // Beyond 2^32 any count fills the line.
            put(std::size_t{next[3]} << std::min(shift, 32U));
            shift += 8;
        } else {
            pixel = next;
            put(1);
            shift = 0;
        }
    }
    return RgbeFault::none;
}

/// The run lengths of one component after another.
RgbeFault read_runs(RgbeBytes& bytes, std::size_t length, Rgbe* line) {
    for (std::size_t component = 0; component < 4; ++component) {
        std::size_t at = 0;
        while (at < length) {
            std::span<const std::uint8_t> found;
            if (!bytes.take(found, 1)) return RgbeFault::end;
            const bool run = found[0] > 128;
            const std::size_t count = run ? found[0] - 128U : found[0];
            if (count > length - at) return RgbeFault::overrun;
            if (!bytes.take(found, run ? 1 : count)) return RgbeFault::end;
            if (line != nullptr) {
                for (std::size_t i = 0; i < count; ++i) {
                    line[at + i][component] = found[run ? 0 : i];
                }
            }
            at += count;
        }
    }
    return RgbeFault::none;
}

RgbeFault read_scanline(RgbeBytes& bytes, std::size_t length, Rgbe* line) {
    Rgbe first;
    if (!bytes.take(first)) return RgbeFault::end;
    const bool may_be_runs = length >= shortest_runs && length <= longest_runs;
    if (may_be_runs && first[0] == 2 && first[1] == 2 && first[2] < 128) {
        if (first[2] * 256U + first[3] != length) return RgbeFault::length;
        return read_runs(bytes, length, line);
    }
    return read_pixels(bytes, first, length, line);
}

std::string describe(RgbeFault fault, std::size_t scanline, std::size_t length) {
    const std::string start = "scanline " + std::to_string(scanline) + ": expected " +
                              std::to_string(length) + " pixels, got ";
    switch (fault) {
        case RgbeFault::length: return start + "run lengths of another number";
        case RgbeFault::overrun: return start + "a run that is too long";
        default: return start + "a file that ends early";
    }
}

}  // namespace

RadianceScan scan_radiance(std::span<const std::uint8_t> bytes, std::size_t scanlines,
                           std::size_t length) {
    RgbeBytes rest(bytes);
    for (std::size_t i = 0; i < scanlines; ++i) {
        poll_interrupts();
        const RgbeFault fault = read_scanline(rest, length, nullptr);
        if (fault == RgbeFault::none) continue;
        if (fault == RgbeFault::end) {
            RgbeBytes whole(bytes);
            Rgbe first;
            const bool fits = whole.take(first) && read_pixels(whole, first, scanlines * length,
                                                               nullptr) == RgbeFault::none;
            // Bytes that are left show that the scanlines were meant to be read otherwise.
            if (fits && whole.empty()) return {bytes, 1, scanlines * length};
        }
        throw std::invalid_argument(describe(fault, i, length));
    }
    return {bytes, scanlines, length};
}

void read_radiance(const RadianceScan& scan, std::span<float> out) {
    std::array<float, 256> scales{};
    for (int exponent = 1; exponent < 256; ++exponent) {
        scales[static_cast<std::size_t>(exponent)] = std::ldexp(1.0F, exponent - 136);
    }
    RgbeBytes bytes(scan.bytes);
    std::vector<Rgbe> line(scan.length);
    auto number = out.begin();
    for (std::size_t i = 0; i < scan.scanlines; ++i) {
        poll_interrupts();
        if (read_scanline(bytes, scan.length, line.data()) != RgbeFault::none) {
            throw std::logic_error("a Radiance picture changed while it was read");
        }
        for (const Rgbe& pixel : line) {
            const float scale = scales[pixel[3]];
            for (std::size_t c = 0; c < 3; ++c) *number++ = static_cast<float>(pixel[c]) * scale;
        }
    }
}

}  // namespace cubecam
