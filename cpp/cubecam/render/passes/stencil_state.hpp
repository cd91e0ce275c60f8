#pragma once

#include "cubecam/gl/handle.hpp"
#include "cubecam/materials/stencil.hpp"

#include <optional>

namespace cubecam {

/// Sets the stencil test and operations of both faces; none disables the test and all writes.
/// Without a stencil buffer every pixel passes GL's test.
void set_stencil(const GladGLContext& gl, const std::optional<Stencil>& stencil);

}  // namespace cubecam
