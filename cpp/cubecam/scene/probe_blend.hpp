#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace cubecam {

class Probe;

/// How many probes a node may look up at once, of all those of its blend.
inline constexpr std::size_t most_blended_probes = 4;

/// Several probes as the environment of a node: each fragment sees them by their influences, and
/// the scene's environment where these do not reach (docs/adr/0030). It never changes.
class ProbeBlend {
public:
    /// Throws std::invalid_argument for no probe, or one that occurs twice.
    explicit ProbeBlend(std::vector<std::shared_ptr<Probe>> probes);

    const std::vector<std::shared_ptr<Probe>>& probes() const { return probes_; }

private:
    std::vector<std::shared_ptr<Probe>> probes_;
};

}  // namespace cubecam
