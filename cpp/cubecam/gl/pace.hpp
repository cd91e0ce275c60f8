#pragma once

#include <cstddef>

struct GladGLContext;  // <glad/gl.h>; only files that call GL include it

namespace cubecam::gl {

/// Keeps the time short in which the driver cannot be interrupted: the driver is never more than
/// two chunks of work behind, and waiting for it polls for interrupts (core/interrupts.hpp).
///
/// Drivers, llvmpipe among them, take commands at once and work on them later. Without a pace, a
/// picture of many pixels would be one long wait in the first call that reads it.
class Pace {
public:
    /// A driver fills this many pixels with a costly shader in less than half a second.
    static constexpr double chunk = 1 << 22;

    /// Notes commands that fill so many pixels, times a factor for costly ones. Polls; waits for
    /// the chunk before the last when another is complete.
    void submitted(const GladGLContext& gl, double pixels);

    /// Waits until the driver has worked off everything, unless that takes no time.
    void finish(const GladGLContext& gl);

private:
    void end_chunk(const GladGLContext& gl);

    double pending_ = 0;
    void* running_ = nullptr;  ///< GLsync of the last complete chunk
};

}  // namespace cubecam::gl
