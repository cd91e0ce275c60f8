#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <vector>

namespace cubecam {

/// The circles of a scene's probes (docs/adr/0003-probe-cycles.md): a circle is a strongly
/// connected component of "the picture of probe A may show a node that looks up probe B". The
/// answers depend on the scene alone, and neither on views nor on update policies.
class ProbeCircles {
public:
    explicit ProbeCircles(const SceneSnapshot& scene);

    /// Whether two probes are in one circle, or are the same.
    bool together(std::size_t first, std::size_t second) const;

    /// How many pictures a probe has: the largest `bounces` in its circle; 1 outside of circles.
    std::size_t levels(std::size_t probe) const { return levels_[circle_[probe]]; }

private:
    std::vector<std::size_t> circle_;  // for each probe: the number of its circle
    std::vector<std::size_t> levels_;  // for each circle
};

}  // namespace cubecam
