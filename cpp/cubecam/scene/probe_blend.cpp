#include "cubecam/scene/probe_blend.hpp"

#include "cubecam/core/checks.hpp"

#include <set>
#include <utility>

namespace cubecam {

ProbeBlend::ProbeBlend(std::vector<std::shared_ptr<Probe>> probes) : probes_(std::move(probes)) {
    expect(!probes_.empty(), "probes: at least one Probe", "none");
    const std::set<std::shared_ptr<Probe>> distinct(probes_.begin(), probes_.end());
    expect(distinct.size() == probes_.size(), "probes: each Probe once", "one of them twice");
}

}  // namespace cubecam
