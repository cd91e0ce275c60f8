#pragma once

#include "cubecam/materials/user_shader.hpp"
#include "cubecam/render/resources/outputs.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cubecam {

/// The outputs that a user's fragment source declares, `out vec4 heat;`, in their order.
/// @throws std::invalid_argument for one of another form or type, or of a name that is taken.
std::vector<NamedOutput> declared_outputs(const UserSource& fragment);

/// A user's fragment source for a program that writes `outputs`: a declaration of one of those gets
/// its location, every other one becomes a plain variable. Line numbers stay as they are.
/// @throws as declared_outputs.
UserSource place_outputs(const UserSource& fragment, const Outputs& outputs);

/// What surface.frag is compiled with so that it writes `outputs`. `declared`: what the user's own
/// source in it declares; the others that are named are written as 0.
std::vector<std::pair<std::string, std::string>>
output_defines(const Outputs& outputs, const std::vector<NamedOutput>& declared = {});

}  // namespace cubecam
