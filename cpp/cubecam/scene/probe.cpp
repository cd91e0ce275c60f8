#include "cubecam/scene/probe.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/revision.hpp"

#include <string>
#include <utility>

namespace cubecam {

bool ProbeValue::operator==(const ProbeValue& other) const {
    return position == other.position && same_node(parent, other.parent) && size == other.size &&
           near == other.near && far == other.far && format == other.format &&
           mipmaps == other.mipmaps && samples == other.samples && update == other.update &&
           every == other.every && faces_per_frame == other.faces_per_frame &&
           depth_format == other.depth_format && prefilter == other.prefilter &&
           parallax == other.parallax && influence == other.influence && bounces == other.bounces &&
           same_nodes(exclude, other.exclude);
}

void check(const ProbeValue& value) {
    expect_finite(value.position, "position");
    expect(value.size >= 1, "size of at least 1", std::to_string(value.size));
    expect_positive(value.near, "near");
    expect_positive(value.far, "far");
    if (!(value.near < value.far)) {
        expect(false, "near < far",
               "near " + describe(value.near) + ", far " + describe(value.far));
    }
    expect(value.samples >= 1, "samples of at least 1", std::to_string(value.samples));
    expect(value.every >= 1, "update every 1 or more frames", std::to_string(value.every));
    expect(value.faces_per_frame >= 1 && value.faces_per_frame <= 6, "faces_per_frame from 1 to 6",
           std::to_string(value.faces_per_frame));
    expect(value.bounces >= 1 && value.bounces <= most_bounces, "bounces from 1 to 16",
           std::to_string(value.bounces));
    check(value.parallax);
    check(value.influence);
    if (value.parallax.by_distance()) {
        expect(value.depth_format == DepthFormat::depth_component32f ||
                   value.depth_format == DepthFormat::depth32f_stencil8,
               "depth_format 'depth_component32f' or 'depth32f_stencil8' with parallax='distance' "
               "or 'layers'",
               "'" + std::string(to_string(value.depth_format)) + "'");
    }
}

Probe::Probe(ProbeValue value)
    : identity_(next_revision()), value_((cubecam::check(value), std::move(value))) {}

}  // namespace cubecam
