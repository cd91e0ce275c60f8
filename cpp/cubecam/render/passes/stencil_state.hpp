#pragma once

#include "cubecam/gl/handle.hpp"
#include "cubecam/materials/stencil.hpp"

#include <optional>

namespace cubecam {

/// Sets the stencil test and operations of both faces; none: the test is off and nothing is
/// written. Without a stencil buffer GL lets every pixel pass.
void set_stencil(const GladGLContext& gl, const std::optional<Stencil>& stencil);

}  // namespace cubecam
