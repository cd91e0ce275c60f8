#pragma once

#include "cubecam/materials/user_shader.hpp"
#include "cubecam/render/resources/outputs.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cubecam {

/// Returns the outputs that a user's fragment source declares, such as `out vec4 heat;`, in their
/// order.
/// @throws std::invalid_argument for a declaration of another form or type, or with the name of a
/// built-in output.
std::vector<NamedOutput> declared_outputs(const UserSource& fragment);

/// Adapts a user's fragment source to a program that writes `outputs`: a declaration of one of
/// these gets its location, every other one becomes a plain variable. The result has plain lines
/// (gl::with_plain_lines), as many as before.
/// @throws the exceptions of declared_outputs.
UserSource place_outputs(const UserSource& source, const Outputs& outputs);

/// Returns the defines by which surface.frag writes `outputs`. `declared` are the outputs that the
/// user's own source declares; the other named outputs are written as 0.
std::vector<std::pair<std::string, std::string>>
output_defines(const Outputs& outputs, const std::vector<NamedOutput>& declared = {});

}  // namespace cubecam
