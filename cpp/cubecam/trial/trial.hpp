#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/trial/job.hpp"

#include <string>
#include <string_view>

namespace cubecam::trial {

/// Refuses users' GLSL with which the driver crashes, or which it cannot compile in reasonable time
/// and memory: a source that nobody has tried yet goes first to a process of its own. One object
/// serves one renderer; the helper and the verdicts are those of the process.
class Trial {
public:
    explicit Trial(const gl::Context& context);

    /// Returns if the driver survives the job. Must be called before this process compiles the
    /// sources, and before it draws with them in a new state. If no helper can be had, it adds a
    /// notice, once in the life of the process, and lets every source pass.
    /// @param source what messages call the user's source
    /// @throws ShaderError that says what happened
    void require(const Job& job, std::string_view source);

private:
    std::string platform_;
    int device_;
    std::string driver_;  ///< vendor, renderer, version, a line each
};

}  // namespace cubecam::trial
