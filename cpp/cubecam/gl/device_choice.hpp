#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/egl_display.hpp"

#include <string>
#include <vector>

/// Turns a DeviceChoice into a list of attempts, in order. Private to gl/.
namespace cubecam::gl {

enum class DeviceKind { any, gpu, software };

/// One place where a context may be made.
struct Candidate {
    egl::Platform platform = egl::Platform::device;
    egl::Device device = nullptr;
    DeviceInfo info;  ///< index -1 and no name if `platform` is not `device`
};

struct CandidateList {
    std::string choice;  ///< the choice in words, for messages
    DeviceKind kind = DeviceKind::any;
    std::vector<Candidate> candidates;
    std::vector<std::string> attempts;  ///< failures so far, such as that of listing devices
};

/// Throws ContextError that lists the devices if none has that index, name or UUID.
CandidateList list_candidates(const DeviceChoice& choice);

}  // namespace cubecam::gl
