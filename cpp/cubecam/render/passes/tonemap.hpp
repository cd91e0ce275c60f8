#pragma once

#include <cstdint>
#include <string_view>

namespace cubecam {

/// How linear colour is brought into 0..1; `none` leaves it as it is.
enum class Tonemap : std::uint8_t { none, reinhard, aces, neutral };

/// Transfer function applied last; `srgb` is IEC 61966-2-1.
enum class Encode : std::uint8_t { none, srgb };

/// Both throw std::invalid_argument for a name they do not know, listing those they do.
Tonemap parse_tonemap(std::string_view name);
Encode parse_encode(std::string_view name);

}  // namespace cubecam
