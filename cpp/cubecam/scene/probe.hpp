#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/scene/influence.hpp"
#include "cubecam/scene/parallax.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <optional>

namespace cubecam {

class Node;

/// When a probe is drawn again.
enum class ProbeUpdate : std::uint8_t {
    on_change,       ///< whenever a face has changed: always up to date
    once,            ///< the first time it is needed
    manual,          ///< only by Renderer::update_probes
    every_n_frames,  ///< on every n-th call that needs it
};

struct ProbeValue {
    glm::dvec3 position{0.0};  ///< world; relative to the parent if there is one
    std::weak_ptr<Node> parent;
    int size = 256;
    double near = 0.05;
    double far = 1000.0;
    Format format = Format::rgba16f;
    bool mipmaps = false;
    int samples = 1;
    ProbeUpdate update = ProbeUpdate::on_change;
    int every = 1;            ///< n of every_n_frames
    int faces_per_frame = 6;  ///< the largest number of faces drawn in one call
    WeakNodes exclude;
    DepthFormat depth_format = DepthFormat::depth_component32f;
    /// How many mirrors of a circle of probes that see each other a path meets (docs/adr/0003).
    int bounces = 1;
    /// Whether it is filtered by roughness; none: if a drawn surface needs that.
    std::optional<bool> prefilter;
    ParallaxValue parallax;
    InfluenceValue influence;  ///< where it counts in a ProbeBlend

    bool operator==(const ProbeValue& other) const;
};

/// The largest ProbeValue::bounces: each is a picture of its own.
inline constexpr int most_bounces = 16;

/// Throws std::invalid_argument for size < 1, near <= 0, near >= far, samples < 1, n < 1, faces
/// outside 1..6, bounces outside 1..most_bounces, a wrong parallax or influence, or a march through
/// distances without depths of 32 bits.
void check(const ProbeValue& value);

/// A cubemap that follows the scene. A Probe is only a description: each renderer holds contents of
/// its own.
///
/// A probe does not show the nodes that use it. If it is attached to a node, it follows the node's
/// position; its axes remain the world's.
class Probe {
public:
    using State = Versioned<ProbeValue>::State;

    explicit Probe(ProbeValue value);
    Probe(const Probe&) = delete;
    Probe& operator=(const Probe&) = delete;

    State state() const { return value_.state(); }
    ProbeValue value() const { return value_.value(); }
    const Revision& revision() const { return value_.revision(); }
    /// A number that no other probe of this process has or had.
    std::uint64_t identity() const { return identity_; }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](ProbeValue& value) {
            change(value);
            check(value);
        });
    }

private:
    std::uint64_t identity_;
    Versioned<ProbeValue> value_;
};

}  // namespace cubecam
