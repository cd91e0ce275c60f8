#include "cubecam/scene/planar_mirror.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/revision.hpp"

#include <string>

namespace cubecam {

void check(const PlanarMirrorValue& value) {
    expect(value.bounces >= 1, "bounces of at least 1", std::to_string(value.bounces));
    expect_positive(value.distance, "distance");
}

PlanarMirror::PlanarMirror(PlanarMirrorValue value)
    : identity_(next_revision()), value_((cubecam::check(value), value)) {}

}  // namespace cubecam
