#pragma once

#include "cubecam/render/passes/programs.hpp"

#include <set>
#include <span>
#include <string>
#include <string_view>

namespace cubecam {

/// The file that a blend's text replaces in shaders/passes/surface.frag.
inline constexpr std::string_view environment_include = "include/environment.glsl";

/// The names that this file and include/parallax.glsl declare, which a blend has once for each
/// environment, as `environment_from_0` and `environment_from_1`.
const std::set<std::string, std::less<>>& environment_names();

/// GLSL for several environments: that of one for each, its names followed by its number and its
/// textures on units of its own, then include/environment_blend.glsl, which has the names without
/// numbers.
std::string blended_environment_text(std::span<const EnvironmentUnits> units);

}  // namespace cubecam
