/// Gives the core's notices as Python warnings.
#pragma once

#include "unlocked.hpp"

#include <pybind11/pybind11.h>

namespace cubecam::bindings {

/// Gives this thread's notices (core/notices.hpp) as cubecam.RendererWarning at the user's line.
/// Throws error_already_set if a filter turns the warning into an error. The GIL must be held.
void warn_of_notices();

/// As above, for a call that already fails: the call's own error is what the user gets, so an error
/// that a filter makes of a warning is dropped.
void warn_of_notices_after_error() noexcept;

/// Runs `call`, a function of the core, without the GIL, and then gives its notices.
///
/// Every binding whose call makes, uses or rebuilds an OpenGL context uses it. If a filter turns
/// the warning into an error, the result of the call is dropped; the renderer is then in the state
/// after the call, and gives the same notice no second time.
template <class Call>
auto with_notices(Call&& call) {
    try {
        auto result = [&call] {
            const Unlocked unlocked;
            return call();
        }();
        warn_of_notices();
        return result;
    } catch (...) {
        warn_of_notices_after_error();
        throw;
    }
}

}  // namespace cubecam::bindings
