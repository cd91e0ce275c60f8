#pragma once

#include "cubecam/trial/report.hpp"

#include <cstdint>
#include <string_view>

/// What the helper does to itself: limits, and reports about its own end.
namespace helper {

/// Gives up what the helper has from its owner: descriptors, a place in the queue of the kernel
/// when memory gets short.
void leave_owner();

/// From now on a crash of this thread, and the end of the process, send a report.
void catch_crashes();

/// Limits the memory that may be taken from here on. Returns data_bytes().
std::uint64_t limit_memory();
/// The writable memory of the process.
std::uint64_t data_bytes();

/// The time of a job: when it is over, the process reports so and ends.
void start_clock();
void stop_clock();
/// Whether no job has come for a while.
bool is_idle();

/// Waits until Mesa's thread for its disk cache has written what a job compiled: the owner, which
/// compiles the same next, then finds it there. Does nothing with another driver.
void wait_for_cache();

void begin(cubecam::trial::Step step);
void send(cubecam::trial::Outcome outcome, std::string_view text = {});

}  // namespace helper
