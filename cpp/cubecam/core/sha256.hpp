#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cubecam {

/// The hash of FIPS 180-4, section 6.2. Nobody can find two texts with one hash, so a hash may
/// stand for a text that somebody hostile wrote.
class Sha256 {
public:
    using Digest = std::array<std::uint8_t, 32>;

    void add(std::string_view text);
    /// The hash of all texts that were added, one after the other. Nothing may be added after it.
    Digest finish();

private:
    void mix(const std::uint8_t* block);

    std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<std::uint8_t, 64> rest_{};
    std::uint64_t length_ = 0;  ///< bytes so far
};

}  // namespace cubecam
