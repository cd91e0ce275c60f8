#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

/// Notices: what a call tells its caller besides its result. The core never prints; the bindings
/// give each notice as a cubecam.RendererWarning when the call returns.
///
/// A notice belongs to the thread on which it was added, since a call runs on the caller's thread.
namespace cubecam {

inline std::vector<std::string>& thread_notices() {
    thread_local std::vector<std::string> notices;
    return notices;
}

/// Adds a notice of this thread's current call; an equal text is added once. A call that repeats
/// something cannot fill the memory: further texts are left out after the first hundred.
inline void add_notice(std::string text) {
    constexpr std::size_t most = 100;
    std::vector<std::string>& notices = thread_notices();
    if (notices.size() >= most || std::find(notices.begin(), notices.end(), text) != notices.end())
        return;
    notices.push_back(std::move(text));
}

/// Returns this thread's notices in the order in which they were added, and forgets them.
inline std::vector<std::string> take_notices() { return std::exchange(thread_notices(), {}); }

}  // namespace cubecam
