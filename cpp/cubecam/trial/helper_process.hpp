#pragma once

#include "cubecam/trial/verdict.hpp"

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace cubecam::trial {

/// What a helper is started with: where its context is, and how much stack the driver gets there.
struct HelperPlace {
    std::string platform;  ///< "device", "surfaceless" or "default"
    int device = -1;
    std::size_t stack_bytes = 0;

    auto operator<=>(const HelperPlace&) const = default;
};

/// A running helper: the connection to it. The helper ends when the connection does: when this
/// object is destroyed, and when this process ends in whatever way.
class Connection {
public:
    /// Starts a helper. @throws Error that says why it cannot be started.
    explicit Connection(const HelperPlace& place);
    ~Connection() { close(); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// The driver of its context: vendor, renderer, version, a line each.
    const std::string& driver() const { return driver_; }

    struct Answer {
        Report report;
        std::string text;
    };
    /// Sends a job and waits for the report. No report: the helper was ended from outside.
    std::optional<Answer> ask(std::string_view job);

private:
    void start(const HelperPlace& place);
    void close() noexcept;
    bool send(std::string_view bytes, int milliseconds);
    bool receive(void* to, std::size_t size, int milliseconds);
    std::optional<Answer> receive_report(int milliseconds);
    std::string printed() const;

    int channel_ = -1;
    int printed_ = -1;  ///< the end of a pipe: what the helper printed
    std::string driver_;
};

/// The helper of one place, which all renderers of the process share: started when it is first
/// needed, started again after it ended.
class Helper {
public:
    explicit Helper(HelperPlace place) : place_(std::move(place)) {}

    /// The helper of a place, made when it is first needed.
    static Helper& of(const HelperPlace& place);

    /// Has a job tried. `driver` is the one of the caller's context: a helper with another one
    /// cannot say anything.
    /// @throws Error that says why no helper can be had
    Verdict ask(std::string_view job, const std::string& driver);

private:
    std::timed_mutex mutex_;
    const HelperPlace place_;
    std::unique_ptr<Connection> connect();

    std::unique_ptr<Connection> connection_;
    std::string problem_;  ///< why the last start failed
    std::chrono::steady_clock::time_point next_start_{};
};

/// The path of the helper's program, which lies beside the file of this code.
std::string helper_path();

}  // namespace cubecam::trial
