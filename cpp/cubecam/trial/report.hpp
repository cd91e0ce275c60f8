#pragma once

#include <cstdint>

namespace cubecam::trial {

/// What the driver was doing.
enum class Step : std::uint8_t { start, compile, link, draw };

/// How a trial ended.
enum class Outcome : std::uint8_t {
    ready,          ///< the helper has a context; its text names the driver
    survived,       ///< the source may have errors, but the driver reported them
    crashed,        ///< by a signal
    ended,          ///< the driver ended the process
    out_of_time,    ///< Limits::seconds
    out_of_memory,  ///< Limits::bytes
    failed,         ///< the helper could not try: its text says why
    killed,         ///< the helper was ended from outside, again and again
};

/// What the helper may take for one source.
struct Limits {
    static constexpr int seconds = 10;  ///< of CPU time
    /// Of the clock, if the driver waits for something: in each such span it has to take
    /// least_milliseconds of CPU time. So a busy machine makes no source fail.
    static constexpr int wall_seconds = 30;
    static constexpr int least_milliseconds = 500;
    /// After so many seconds one of the two limits has struck.
    static constexpr int most_seconds = wall_seconds * (1000 * seconds / least_milliseconds + 1);
    static constexpr std::uint64_t bytes = std::uint64_t{1} << 30;
    static constexpr std::uint32_t job_bytes = 8U << 20;  ///< text and state
};

/// A message from the helper; `text_size` bytes of text follow it.
struct Report {
    std::uint32_t magic = 0;
    Outcome outcome = Outcome::failed;
    Step step = Step::start;
    /// Of a crash; SIGPROF or SIGALRM: which time was over; out_of_memory, 1: the machine has less
    /// memory left than Limits::bytes.
    std::uint8_t signal = 0;
    std::uint8_t reserved = 0;
    std::uint32_t text_size = 0;

    static constexpr std::uint32_t right_magic = 0x43435431;  // changes with the messages
};

/// The descriptor through which the helper gets jobs and sends reports: its standard input.
inline constexpr int helper_channel = 0;

}  // namespace cubecam::trial
