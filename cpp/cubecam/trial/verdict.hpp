#pragma once

#include "cubecam/trial/report.hpp"

#include <string>

namespace cubecam::trial {

/// What is known about a job.
struct Verdict {
    Outcome outcome = Outcome::survived;
    Step step = Step::start;
    int signal = 0;  ///< Report::signal

    bool passed() const { return outcome == Outcome::survived || outcome == Outcome::failed; }
    /// Whether another trial in this process would end in the same way.
    bool known() const { return outcome != Outcome::failed && outcome != Outcome::killed; }
    /// Whether it would on another day: not if the machine was busy, or short of memory.
    bool lasting() const;
};

/// Says in words why a source is refused: "the driver crashed (SIGFPE, an arithmetic error) while
/// it compiled this source".
std::string in_words(const Verdict& verdict);

}  // namespace cubecam::trial
