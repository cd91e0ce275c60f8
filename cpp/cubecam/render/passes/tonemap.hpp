#pragma once

#include "cubecam/core/parse_name.hpp"

#include <cstdint>
#include <string_view>

namespace cubecam {

/// How linear colour is mapped into 0..1; `none` does not change it.
enum class Tonemap : std::uint8_t { none, reinhard, aces, neutral };

/// The transfer function, which is applied last; `srgb` is IEC 61966-2-1.
enum class Encode : std::uint8_t { none, srgb };

inline constexpr NameTable<Tonemap, 3> tonemap_names{
    {{"reinhard", Tonemap::reinhard}, {"aces", Tonemap::aces}, {"neutral", Tonemap::neutral}}};
inline constexpr NameTable<Encode, 1> encode_names{{{"srgb", Encode::srgb}}};

/// Both functions throw std::invalid_argument that lists the known names, for any other name.
Tonemap parse_tonemap(std::string_view name);
Encode parse_encode(std::string_view name);

}  // namespace cubecam
