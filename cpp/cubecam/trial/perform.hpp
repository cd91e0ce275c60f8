#pragma once

#include "cubecam/trial/job.hpp"
#include "cubecam/trial/report.hpp"

#include <glad/gl.h>

#include <functional>

namespace cubecam::trial {

/// Compiles, links and draws one pixel, as a job says. It runs in the helper; `begins` hears of
/// each step before the driver can crash in it. A source with errors is no failure.
/// @throws Error for a state that cannot be set up.
void perform(const GladGLContext& gl, const Job& job, const std::function<void(Step)>& begins);

}  // namespace cubecam::trial
