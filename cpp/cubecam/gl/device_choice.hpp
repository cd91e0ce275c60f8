#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/egl_display.hpp"

#include <string>
#include <vector>

/// From a DeviceChoice to what is tried, in order. Private to gl/.
namespace cubecam::gl {

enum class DeviceKind { any, gpu, software };

/// One place where a context may be made.
struct Candidate {
    egl::Platform platform = egl::Platform::device;
    egl::Device device = nullptr;
    DeviceInfo info;  ///< index -1 and no name beyond the device platform
};

struct CandidateList {
    std::string asked;  ///< the choice in words, for messages
    DeviceKind kind = DeviceKind::any;
    std::vector<Candidate> candidates;
    std::vector<std::string> attempts;  ///< what already failed, such as the enumeration of devices
};

/// Throws ContextError that lists the devices when there is none of that index, name or UUID.
CandidateList list_candidates(const DeviceChoice& choice);

}  // namespace cubecam::gl
