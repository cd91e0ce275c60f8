/// The scanlines of Radiance pictures (.hdr, .pic), in every coding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cubecam {

/// Where the pixels of a Radiance picture are, found before memory for them is taken.
struct RadianceScan {
    std::span<const std::uint8_t> bytes;
    std::size_t scanlines = 0;
    std::size_t length = 0;  ///< pixels of a scanline
};

/// Checks that the bytes after the header hold `scanlines` scanlines of `length` pixels each, of
/// which at least one. Takes no memory, and a time that depends on the bytes alone. Raises
/// std::invalid_argument, which names the scanline.
///
/// Each scanline has a coding of its own: run lengths of the four components one after another,
/// from 8 to 32767 pixels (G. Ward 1991); or pixels, of which (1, 1, 1, n) repeats the one before n
/// times, and 256 times as often for each such pixel right before it. What a repeat has too much is
/// skipped at the end of a scanline, as Radiance does. If the bytes then end early, repeats that go
/// on in the next scanline are tried, as some programs write them.
RadianceScan scan_radiance(std::span<const std::uint8_t> bytes, std::size_t scanlines,
                           std::size_t length);

/// Writes three numbers for each pixel: component / 256 * 2^(exponent - 128), and 0 for the
/// exponent 0. The order is that of the file.
void read_radiance(const RadianceScan& scan, std::span<float> out);

}  // namespace cubecam
