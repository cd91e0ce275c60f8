#pragma once

#include "cubecam/core/versioned.hpp"

#include <cstdint>

namespace cubecam {

struct PlanarMirrorValue {
    /// A path may meet so many planar mirrors, this one as the last of them.
    int bounces = 1;
    /// How far from the surface bent and rough reflections are looked up, world units.
    double distance = 1.0;

    bool operator==(const PlanarMirrorValue&) const = default;
};

/// Throws std::invalid_argument for bounces < 1 or a distance that is not above 0.
void check(const PlanarMirrorValue& value);

/// What a flat surface reflects, exactly: each picture that shows the surface gets a picture of its
/// own, the same view mirrored at the surface's plane (docs/adr/0027). A PlanarMirror is only a
/// description: each renderer holds contents of its own, and the plane is that of the node's mesh.
class PlanarMirror {
public:
    using State = Versioned<PlanarMirrorValue>::State;

    explicit PlanarMirror(PlanarMirrorValue value);
    PlanarMirror(const PlanarMirror&) = delete;
    PlanarMirror& operator=(const PlanarMirror&) = delete;

    State state() const { return value_.state(); }
    PlanarMirrorValue value() const { return value_.value(); }
    const Revision& revision() const { return value_.revision(); }
    /// A number that no other planar mirror of this process has or had.
    std::uint64_t identity() const { return identity_; }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](PlanarMirrorValue& value) {
            change(value);
            check(value);
        });
    }

private:
    std::uint64_t identity_;
    Versioned<PlanarMirrorValue> value_;
};

}  // namespace cubecam
