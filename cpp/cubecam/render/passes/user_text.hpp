#pragma once

#include "cubecam/materials/user_shader.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace cubecam {

/// What a user's text is for: the fragments or the vertices of a material, or an image effect.
enum class UserStage : std::uint8_t { fragment, vertex, effect };

/// The name of a user's text in messages: its path, or else "fragment" or "vertex".
std::string_view title_of(const UserSource& source, UserStage stage);

/// Refuses what the driver would not refuse, what it would report on a line of another file, and
/// what would make it use much memory or time. `source` has plain lines.
/// @throws ShaderError that quotes the user's own line.
void check_user_text(const UserSource& source, UserStage stage);

/// A user's text in the form in which it is compiled.
struct PreparedText {
    std::string text;   ///< has the lines of the user's text
    std::string after;  ///< what follows it: `void cubecam_zeros()`, and the end of its macros
};

/// Gives every variable without a value the value 0, since a driver would leave there what another
/// program had in this memory. Variables outside of functions get it in cubecam_zeros(), which
/// main() calls first. Variables that a macro with several definitions declares with different
/// types, and those that a switch with conditions inside jumps past, get none. `source` has passed
/// check_user_text() and place_outputs().
/// @throws ShaderError if that needs too much text.
PreparedText prepare_user_text(const UserSource& source, UserStage stage);

}  // namespace cubecam
