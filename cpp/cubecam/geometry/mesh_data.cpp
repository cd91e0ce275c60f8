#include "cubecam/geometry/mesh_data.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/tangents.hpp"
#include "cubecam/geometry/vertex_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

void check_alpha(const std::vector<glm::vec4>& colors) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
        poll_interrupts(i);
        const glm::vec4& c = colors[i];
        if (c.a >= 0.0F && c.a <= 1.0F) continue;
        throw std::invalid_argument("expected colors with an alpha from 0 to 1, got " +
                                    describe(c) + " at vertex " + std::to_string(i));
    }
}

void check_triangles(const std::vector<glm::uvec3>& triangles, std::size_t vertices,
                     const std::string& of = "") {
    expect(!triangles.empty(), "at least one triangle" + of, "none");
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        poll_interrupts(i);
        const glm::uvec3& t = triangles[i];
        const std::uint32_t largest = std::max({t.x, t.y, t.z});
        if (largest < vertices) continue;
        throw std::out_of_range("expected indices below the number of vertices, " +
                                std::to_string(vertices) + ", got " + std::to_string(largest) +
                                " in triangle " + std::to_string(i) + of);
    }
}

/// Whether a normal has unit length and is kept as it is: normals that a mesh gave out come back
/// unchanged.
bool unit_length(const glm::vec3& normal) {
    const glm::dvec3 wide(normal);
    constexpr double close = 1e-6;
    constexpr double least = (1.0 - close) * (1.0 - close);
    constexpr double most = (1.0 + close) * (1.0 + close);
    const double squared = glm::dot(wide, wide);
    return squared >= least && squared <= most;
}

/// Gives every normal unit length. Zero normals, which some files contain, are replaced by smooth
/// ones.
void normalize_all(std::vector<glm::vec3>& normals, const std::vector<glm::vec3>& positions,
                   const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::vec3> smooth;
    for (std::size_t begin = 0; begin < normals.size(); begin += vertex_block) {
        poll_interrupts();
        const std::size_t end = std::min(normals.size(), begin + vertex_block);
        bool unit = true;
        for (std::size_t i = begin; i < end; ++i) unit &= unit_length(normals[i]);
        for (std::size_t i = begin; i < end && !unit; ++i) {
            if (unit_length(normals[i])) continue;
            const glm::dvec3 normal(normals[i]);
            const double length = glm::length(normal);
            if (length == 0.0 && smooth.empty()) smooth = smooth_normals(positions, triangles);
            normals[i] = length == 0.0 ? smooth[i] : glm::vec3(normal / length);
        }
    }
}

void check_handedness(const std::vector<glm::vec4>& tangents) {
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        poll_interrupts(i);
        if (std::abs(tangents[i].w) == 1.0F) continue;
        throw std::invalid_argument("expected tangents with a fourth number of 1 or -1, got " +
                                    describe(tangents[i]) + " at vertex " + std::to_string(i));
    }
}

/// Gives every tangent unit length. Tangents of length 0 get any direction in the surface.
void normalize_all(std::vector<glm::vec4>& tangents, const std::vector<glm::vec3>& normals) {
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        poll_interrupts(i);
        if (unit_length(glm::vec3(tangents[i]))) continue;
        const glm::dvec3 tangent(tangents[i]);
        const double length = glm::length(tangent);
        const glm::dvec3 unit =
            length > 0.0 ? tangent / length : any_tangent(glm::dvec3(normals[i]));
        tangents[i] = glm::vec4(unit, tangents[i].w);
    }
}

Bounds bounds_of(const std::vector<glm::vec3>& positions) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    // Four vertices at a time, for SIMD.
    std::array<float, 12> low;
    std::array<float, 12> high;
    low.fill(infinity);
    high.fill(-infinity);
    const std::size_t fours = positions.size() / 4;
    for (std::size_t four = 0; four < fours; ++four) {
        const float* from = &positions[4 * four].x;
        for (std::size_t i = 0; i < 12; ++i) {
            low[i] = from[i] < low[i] ? from[i] : low[i];
            high[i] = from[i] > high[i] ? from[i] : high[i];
        }
    }
    glm::vec3 lowest(infinity);
    glm::vec3 highest(-infinity);
    for (std::size_t i = 0; i < 12; i += 3) {
        lowest = glm::min(lowest, glm::vec3(low[i], low[i + 1], low[i + 2]));
        highest = glm::max(highest, glm::vec3(high[i], high[i + 1], high[i + 2]));
    }
    for (std::size_t v = 4 * fours; v < positions.size(); ++v) {
        lowest = glm::min(lowest, positions[v]);
        highest = glm::max(highest, positions[v]);
    }
    return {glm::dvec3(lowest), glm::dvec3(highest)};
}

/// The values of the triangles' corners, one after the other.
template <class T>
std::vector<T> unshared(const std::vector<T>& values, const std::vector<glm::uvec3>& triangles) {
    std::vector<T> corners;
    corners.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles) {
        poll_interrupts(corners.size() / 3);
        for (int i = 0; i < 3; ++i) corners.push_back(values[triangle[i]]);
    }
    return corners;
}

/// The values at some indices.
template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& from) {
    std::vector<T> found;
    found.reserve(from.size());
    for (const std::uint32_t index : from) found.push_back(values[index]);
    return found;
}

/// The vertices of the triangles' corners, one after the other.
std::vector<std::uint32_t> corners_of(const std::vector<glm::uvec3>& triangles) {
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles) {
        for (int i = 0; i < 3; ++i) corners.push_back(triangle[i]);
    }
    return corners;
}

template <class T>
VertexStream<T> stream_of(std::vector<T>&& values, std::uint64_t revision) {
    if (values.empty()) return {nullptr, revision};
    return {std::make_shared<const std::vector<T>>(std::move(values)), revision};
}

}  // namespace

MeshData::MeshData(Arrays arrays)
    : identity_(std::make_shared<const MeshIdentity>()), revision_(next_revision()) {
    check_triangles(arrays.triangles, arrays.positions.size());
    triangles_ = std::make_shared<const std::vector<glm::uvec3>>(std::move(arrays.triangles));
    set_positions(std::move(arrays.positions));
    set_normals(std::move(arrays.normals));
    set_uvs(std::move(arrays.uvs));
    set_colors(std::move(arrays.colors));
    set_uvs1(std::move(arrays.uvs1));
    set_tangents(std::move(arrays.tangents));
    set_influences(std::move(arrays.influences));
    set_targets(std::move(arrays.targets));
    set_levels(arrays.levels);
}

void MeshData::set_positions(std::vector<glm::vec3> positions) {
    check_finite(positions, "positions");
    bounds_ = bounds_of(positions);
    positions_ = stream_of(std::move(positions), revision_);
}

void MeshData::set_normals(std::vector<glm::vec3> normals) {
    check_length(normals, positions()->size(), "normals");
    check_finite(normals, "normals");
    smooth_ = normals.empty();
    if (smooth_) {
        normals = smooth_normals(*positions(), *triangles());
    } else {
        normalize_all(normals, *positions(), *triangles());
    }
    normals_ = stream_of(std::move(normals), revision_);
}

void MeshData::set_uvs(std::vector<glm::vec2> uvs) {
    check_length(uvs, positions()->size(), "uvs");
    check_finite(uvs, "uvs");
    uvs_ = stream_of(std::move(uvs), revision_);
}

void MeshData::set_uvs1(std::vector<glm::vec2> uvs) {
    check_length(uvs, positions()->size(), "uvs1");
    check_finite(uvs, "uvs1");
    uvs1_ = stream_of(std::move(uvs), revision_);
}

void MeshData::set_tangents(std::vector<glm::vec4> tangents) {
    check_length(tangents, positions()->size(), "tangents");
    check_finite(tangents, "tangents");
    check_handedness(tangents);
    normalize_all(tangents, *normals());
    tangents_ = stream_of(std::move(tangents), revision_);
}

void MeshData::set_colors(std::vector<glm::vec4> colors) {
    check_length(colors, positions()->size(), "colors");
    check_finite(colors, "colors");
    check_alpha(colors);
    translucent_colors_ = std::any_of(colors.begin(), colors.end(),
                                      [](const glm::vec4& color) { return color.a < 1.0F; });
    colors_ = stream_of(std::move(colors), revision_);
}

void MeshData::set_influences(std::shared_ptr<const Influences> influences) {
    if (influences) check_length(influences->vertices(), positions()->size(), "joints");
    influences_ = std::move(influences);
}

void MeshData::set_targets(MorphTargets targets) {
    for (const auto& target : targets) {
        expect(target != nullptr, "morph targets", "none");
        check_length(target->vertices(), positions()->size(), "displacements of a morph target");
    }
    targets_ = targets.empty() ? nullptr : std::make_shared<const MorphTargets>(std::move(targets));
}

void MeshData::set_levels(const std::vector<MeshLevel>& levels) {
    std::vector<DrawnLevel> made;
    double last = 0.0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const std::string of = " of level " + std::to_string(i);
        check_triangles(levels[i].triangles, positions()->size(), of);
        expect_not_negative(levels[i].error, "an error" + of + " that is");
        expect(levels[i].error >= last,
               "errors of levels that do not decrease, from fine to coarse",
               describe(levels[i].error) + " after " + describe(last));
        last = levels[i].error;
        made.push_back(drawn_level(
            std::make_shared<const std::vector<glm::uvec3>>(levels[i].triangles), last));
    }
    levels_ =
        made.empty() ? nullptr : std::make_shared<const std::vector<DrawnLevel>>(std::move(made));
}

void MeshData::make_levels_again(double factor) {
    if (!levels_) return;
    std::vector<DrawnLevel> made;
    for (const DrawnLevel& level : *levels_) {
        made.push_back(drawn_level(level.triangles, factor * level.error));
    }
    levels_ = std::make_shared<const std::vector<DrawnLevel>>(std::move(made));
}

/// The vertices of a level keep their order.
DrawnLevel MeshData::drawn_level(Array<glm::uvec3> level_triangles, double error) const {
    std::vector<std::uint32_t> place(positions()->size(), 0);
    for (const glm::uvec3& triangle : *level_triangles) {
        for (int i = 0; i < 3; ++i) place[triangle[i]] = 1;
    }
    std::vector<std::uint32_t> used;
    for (std::size_t v = 0; v < place.size(); ++v) {
        if (place[v] == 0) continue;
        place[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(static_cast<std::uint32_t>(v));
    }
    std::vector<glm::uvec3> triangles;
    triangles.reserve(level_triangles->size());
    for (const glm::uvec3& triangle : *level_triangles) {
        triangles.emplace_back(place[triangle.x], place[triangle.y], place[triangle.z]);
    }
    MeshData made = *this;
    made.identity_ = std::make_shared<const MeshIdentity>();
    made.revision_ = next_revision();
    made.triangles_ = std::make_shared<const std::vector<glm::uvec3>>(std::move(triangles));
    const auto gather = [&](auto& stream) {
        if (stream.values) stream = stream_of(gathered(*stream.values, used), made.revision_);
    };
    gather(made.positions_);
    gather(made.normals_);
    gather(made.uvs_);
    gather(made.colors_);
    gather(made.uvs1_);
    gather(made.tangents_);
    made.sources_ = nullptr;
    made.influences_ = nullptr;
    made.influences_of_ = nullptr;
    made.targets_ = nullptr;
    made.levels_ = nullptr;
    made.smooth_ = false;
    return {std::move(level_triangles), error, std::make_shared<const MeshData>(std::move(made))};
}

MeshData MeshData::updated(MeshUpdate update) const {
    MeshData next = *this;
    next.revision_ = next_revision();
    const bool moved = update.positions.has_value();
    if (moved) {
        expect(update.positions->size() == positions()->size(),
               "as many positions as the mesh has, " + std::to_string(positions()->size()),
               std::to_string(update.positions->size()));
        next.set_positions(std::move(*update.positions));
    }
    if (update.normals) {
        next.set_normals(std::move(*update.normals));
    } else if (moved && smooth_) {
        next.set_normals({});
    }
    if (update.uvs) next.set_uvs(std::move(*update.uvs));
    if (update.colors) next.set_colors(std::move(*update.colors));
    if (update.uvs1) next.set_uvs1(std::move(*update.uvs1));
    if (update.tangents) next.set_tangents(std::move(*update.tangents));
    if (update.influences) next.set_influences(std::move(*update.influences));
    if (update.targets) next.set_targets(std::move(*update.targets));
    if (update.levels) {
        next.set_levels(*update.levels);
    } else if (update.changes_vertices()) {
        next.levels_ = nullptr;
    }
    return next;
}

MeshData MeshData::flat_shaded(const MeshData* before) const {
    MeshData flat = *this;
    flat.revision_ = next_revision();
    if (before != nullptr) {
        flat.identity_ = before->identity_;
        flat.triangles_ = before->triangles_;
    } else {
        flat.identity_ = std::make_shared<const MeshIdentity>();
        std::vector<glm::uvec3> triangles(triangles_->size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto first = static_cast<std::uint32_t>(3 * i);
            triangles[i] = {first, first + 1, first + 2};
        }
        flat.triangles_ = std::make_shared<const std::vector<glm::uvec3>>(std::move(triangles));
    }
    // Each stream has the revision of the stream from which it was made.
    if (before != nullptr && before->positions_.revision == positions_.revision) {
        flat.positions_ = before->positions_;
        flat.normals_ = before->normals_;
        flat.bounds_ = before->bounds_;
        flat.smooth_ = true;
    } else {
        flat.set_positions(unshared(*positions(), *triangles()));
        flat.set_normals({});
        flat.positions_.revision = flat.normals_.revision = positions_.revision;
    }
    const auto follow = [&](auto stream) {
        auto& to = flat.*stream;
        if (before != nullptr && (before->*stream).revision == to.revision) {
            to = before->*stream;
        } else if (to.values) {
            to = stream_of(unshared(*to.values, *triangles()), to.revision);
        }
    };
    follow(&MeshData::uvs_);
    follow(&MeshData::colors_);
    follow(&MeshData::uvs1_);
    follow(&MeshData::tangents_);
    flat.targets_ = nullptr;
    flat.levels_ = nullptr;
    if (influences_ && before != nullptr && before->influences_of_ == influences_) {
        flat.influences_ = before->influences_;
    } else if (influences_) {
        flat.influences_ =
            std::make_shared<const Influences>(influences_->gathered(corners_of(*triangles())));
    }
    flat.influences_of_ = influences_;
    return flat;
}

MeshData MeshData::with_tangents(int uv_set, const MeshData* before) const {
    const auto uv_stream = uv_set == 0 ? &MeshData::uvs_ : &MeshData::uvs1_;
    const auto same = [&](auto stream) {
        return before != nullptr && (before->*stream).revision == (this->*stream).revision;
    };
    MeshData made = *this;
    made.revision_ = next_revision();
    made.sources_ = nullptr;
    if (same(&MeshData::positions_) && same(&MeshData::normals_) && same(uv_stream)) {
        made.identity_ = before->identity_;
        made.triangles_ = before->triangles_;
        made.sources_ = before->sources_;
        made.tangents_ = before->tangents_;
    } else {
        TangentSpace space =
            find_tangents(*positions(), *normals(), *(this->*uv_stream).values, *triangles());
        const bool same_vertices =
            before != nullptr && *before->triangles_ == space.triangles &&
            (before->sources_ ? *before->sources_ == space.sources : space.sources.empty());
        if (same_vertices) {
            made.identity_ = before->identity_;
            made.triangles_ = before->triangles_;
            made.sources_ = before->sources_;
        } else {
            before = nullptr;  // another mesh: nothing of it fits
            made.identity_ = std::make_shared<const MeshIdentity>();
            if (!space.sources.empty()) {
                made.triangles_ =
                    std::make_shared<const std::vector<glm::uvec3>>(std::move(space.triangles));
                made.sources_ =
                    std::make_shared<const std::vector<std::uint32_t>>(std::move(space.sources));
            }
        }
        made.tangents_ = stream_of(std::move(space.tangents), made.revision_);
    }
    const auto follow = [&](auto stream) {
        auto& to = made.*stream;
        if (same(stream)) {
            to = before->*stream;
        } else if (to.values && made.sources_) {
            to = stream_of(gathered(*to.values, *made.sources_), to.revision);
        }
    };
    follow(&MeshData::positions_);
    follow(&MeshData::normals_);
    follow(&MeshData::uvs_);
    follow(&MeshData::colors_);
    follow(&MeshData::uvs1_);
    made.targets_ = nullptr;
    if (influences_ && made.sources_) {
        const bool kept = before != nullptr && before->influences_of_ == influences_ &&
                          before->sources_ == made.sources_;
        made.influences_ =
            kept ? before->influences_
                 : std::make_shared<const Influences>(influences_->gathered(*made.sources_));
    }
    made.influences_of_ = influences_;
    // Split vertices would get other smooth normals after an update of their positions.
    if (made.sources_) made.smooth_ = false;
    if (made.sources_) made.levels_ = nullptr;  // their corners would need to choose between copies
    made.make_levels_again(1.0);
    return made;
}

MeshData MeshData::of_new_mesh() && {
    identity_ = std::make_shared<const MeshIdentity>();
    return std::move(*this);
}

void MeshData::set_deformed_positions(std::vector<glm::vec3> positions) {
    bounds_ = bounds_of(positions);
    positions_ = stream_of(std::move(positions), revision_);
}

void MeshData::set_deformed_normals(std::vector<glm::vec3> normals, bool lost) {
    if (lost) normalize_all(normals, *positions(), *triangles());
    normals_ = stream_of(std::move(normals), revision_);
}

void MeshData::set_deformed_tangents(std::vector<glm::vec4> tangents, bool lost) {
    if (lost) normalize_all(tangents, *normals());
    tangents_ = stream_of(std::move(tangents), revision_);
}

MeshData MeshData::morphed(std::span<const float> weights, const MeshData* before) const {
    MeshData next = *this;
    next.revision_ = next_revision();
    next.targets_ = nullptr;
    next.levels_ = nullptr;
    next.identity_ = before != nullptr ? before->identity_ : std::make_shared<const MeshIdentity>();
    const auto changes = [&]<class Vector>(MorphTarget::Array<Vector> const& (MorphTarget::*of)()
                                               const) {
        std::vector<Displacement<Vector>> found;
        for (std::size_t i = 0; i < std::min(weights.size(), target_count()); ++i) {
            const auto& values = ((*targets_)[i].get()->*of)();
            if (weights[i] != 0.0F && values) found.push_back({values.get(), weights[i]});
        }
        return found;
    };
    const auto moves = changes(&MorphTarget::positions);
    if (!moves.empty()) next.set_deformed_positions(displaced(*positions(), moves));
    if (smooth_) {
        if (!moves.empty()) next.set_normals({});
    } else if (const auto turns = changes(&MorphTarget::normals); !turns.empty()) {
        auto normals = displaced(*this->normals(), turns);
        const bool lost = normalize_each(normals);
        next.set_deformed_normals(std::move(normals), lost);
    }
    if (const auto turns = changes(&MorphTarget::tangents); tangents() && !turns.empty()) {
        std::vector<glm::vec3> directions(tangents()->begin(), tangents()->end());
        directions = displaced(directions, turns);
        const bool lost = normalize_each(directions);
        std::vector<glm::vec4> signed_ones;
        signed_ones.reserve(directions.size());
        for (std::size_t i = 0; i < directions.size(); ++i) {
            signed_ones.emplace_back(directions[i], (*tangents())[i].w);
        }
        next.set_deformed_tangents(std::move(signed_ones), lost);
    }
    if (const auto shifts = changes(&MorphTarget::uvs); uvs() && !shifts.empty()) {
        next.uvs_ = stream_of(displaced(*uvs(), shifts), next.revision_);
    }
    if (const auto shifts = changes(&MorphTarget::uvs1); uvs1() && !shifts.empty()) {
        next.uvs1_ = stream_of(displaced(*uvs1(), shifts), next.revision_);
    }
    if (const auto shifts = changes(&MorphTarget::colors); colors() && !shifts.empty()) {
        auto mixed = displaced(*colors(), shifts);
        for (glm::vec4& color : mixed) color = glm::clamp(color, 0.0F, 1.0F);
        next.set_colors(std::move(mixed));
    }
    return next;
}

MeshData MeshData::skinned(std::span<const JointMatrix> joints, const MeshData* before) const {
    MeshData next = *this;
    next.revision_ = next_revision();
    SkinnedVertices made =
        skin({positions().get(), smooth_ ? nullptr : normals().get(), tangents().get()},
             *influences_, joints);
    next.levels_ = nullptr;
    if (made.mirrors) {
        next.triangles_ = std::make_shared<const std::vector<glm::uvec3>>(
            turned_triangles(*triangles(), made.sides));
    }
    if (before != nullptr && before->positions()->size() == positions()->size() &&
        (before->triangles_ == next.triangles_ || *before->triangles_ == *next.triangles_)) {
        next.identity_ = before->identity_;
        next.triangles_ = before->triangles_;
    } else {
        next.identity_ = std::make_shared<const MeshIdentity>();
    }
    next.set_deformed_positions(std::move(made.positions));
    if (smooth_) {
        next.set_normals({});
    } else {
        next.set_deformed_normals(std::move(made.normals), made.lost);
    }
    if (tangents()) next.set_deformed_tangents(std::move(made.tangents), made.lost);
    return next;
}

MeshData MeshData::with_targets_of(const MeshData& base) && {
    if (!base.targets_) return std::move(*this);
    MorphTargets targets = *base.targets_;
    if (sources_ || triangles_ != base.triangles_) {
        const std::vector<std::uint32_t> from =
            sources_ ? *sources_ : corners_of(*base.triangles());
        for (auto& target : targets) {
            target = std::make_shared<const MorphTarget>(target->gathered(from));
        }
    }
    set_targets(std::move(targets));
    return std::move(*this);
}

MeshData MeshData::centered_and_scaled(double size) const {
    expect_positive(size, "size");
    expect(!influences_, "a mesh without joints, whose matrices fit its size", "one with joints");
    const glm::dvec3 extent = bounds().extent();
    const double largest = std::max({extent.x, extent.y, extent.z});
    expect(largest > 0.0, "a mesh of some extent", "all vertices at one point");
    const glm::dvec3 center = bounds().center();
    const double factor = size / largest;

    std::vector<glm::vec3> scaled;
    scaled.reserve(positions()->size());
    for (const glm::vec3& position : *positions()) {
        scaled.emplace_back((glm::dvec3(position) - center) * factor);
    }
    MeshData next = *this;
    next.revision_ = next_revision();
    next.set_positions(std::move(scaled));
    if (targets_) {
        MorphTargets targets = *targets_;
        for (auto& target : targets) {
            target = std::make_shared<const MorphTarget>(target->scaled(factor));
        }
        next.set_targets(std::move(targets));
    }
    next.make_levels_again(factor);
    return next;
}

std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
    std::size_t step = 0;
    for (const glm::uvec3& triangle : triangles) {
        poll_interrupts(step++);
        glm::dvec3 corners[3];
        for (int i = 0; i < 3; ++i) corners[i] = glm::dvec3(positions[triangle[i]]);
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double twice_area = glm::length(cross);
        if (!(twice_area > 0.0)) continue;
        const glm::dvec3 normal = cross / twice_area;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 a = corners[(i + 1) % 3] - corners[i];
            const glm::dvec3 b = corners[(i + 2) % 3] - corners[i];
            // |a x b| is twice the area at every corner; atan2 stays accurate at small angles.
            sums[triangle[i]] += std::atan2(twice_area, glm::dot(a, b)) * normal;
        }
    }
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        poll_interrupts(i);
        const double length = glm::length(sums[i]);
        normals[i] = length > 0.0 ? glm::vec3(sums[i] / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }
    return normals;
}

}  // namespace cubecam
