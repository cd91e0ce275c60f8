#include "cubecam/geometry/primitives.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

namespace cubecam::primitives {

namespace {

/// Enough vertices for any picture; a mistyped count must not exhaust the memory.
constexpr std::int64_t most_vertices = std::int64_t{1} << 24;

void expect_count(int count, int least, const char* name) {
    expect(count >= least, std::string(name) + " of at least " + std::to_string(least),
           std::to_string(count));
}

void expect_vertices(std::int64_t columns, std::int64_t rows) {
    const std::int64_t vertices = columns * rows;
    expect(vertices <= most_vertices,
           "a mesh of at most " + std::to_string(most_vertices) + " vertices",
           std::to_string(vertices));
    // Position, normal, texture coordinates, and two triangles for each vertex; vectors that grow
    // hold their numbers twice.
    constexpr double bytes = 2 * (3 + 3 + 2 + 2 * 3) * sizeof(float);
    check_memory(bytes * static_cast<double>(vertices), std::to_string(vertices) + " vertices");
}

/// (sine, cosine) of step / steps of a full turn. Quarter turns are exact, and step = steps gives
/// the same bits as step = 0, so that bounds are round numbers and seams are closed.
glm::dvec2 turn(int step, int steps) {
    const std::int64_t quarter_steps = 4 * std::int64_t{step % steps};
    if (quarter_steps % steps == 0) {
        constexpr std::array<glm::dvec2, 4> quarters = {{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
        return quarters[static_cast<std::size_t>(quarter_steps / steps)];
    }
    const double angle = 2.0 * std::numbers::pi * (step % steps) / steps;
    return {std::sin(angle), std::cos(angle)};
}

/// Collects vertices, then triangles between them.
class Builder {
public:
    std::uint32_t vertex(glm::dvec3 position, glm::dvec3 normal, glm::dvec2 uv) {
        poll_interrupts(arrays_.positions.size());
        arrays_.positions.emplace_back(position);
        arrays_.normals.emplace_back(glm::normalize(normal));
        arrays_.uvs.emplace_back(uv);
        return static_cast<std::uint32_t>(arrays_.positions.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        poll_interrupts(arrays_.triangles.size());
        arrays_.triangles.emplace_back(a, b, c);
    }

    /// The corners are counter-clockwise, seen from outside.
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }

    MeshData mesh() { return MeshData(std::move(arrays_)); }

    /// The mesh after a quarter turn round X that takes +Y to +Z.
    MeshData turned_to_z() {
        for (auto* vectors : {&arrays_.positions, &arrays_.normals}) {
            for (glm::vec3& v : *vectors) v = {v.x, 0.0F - v.z, v.y};
        }
        return mesh();
    }

private:
    MeshData::Arrays arrays_;
};

/// The direction at step / steps of a turn round +Y that begins at -Z. A viewer in front, at +Z,
/// sees a picture on it unmirrored, with its middle at +Z.
glm::dvec3 around(int step, int steps) {
    // Step 0 is -Z; with growing u the direction turns to -X, then +Z, then +X.
    const glm::dvec2 t = turn(step, steps);
    return {0.0 - t.x, 0.0, 0.0 - t.y};
}

/// A band round the Y axis between two circles. Its normals have `rise` as their y for 1 outwards.
void add_band(Builder& builder, glm::dvec2 low, glm::dvec2 high, double rise, glm::dvec2 v,
              int segments) {
    std::uint32_t a = 0;
    std::uint32_t d = 0;
    for (int i = 0; i <= segments; ++i) {
        const glm::dvec3 outward = around(i, segments);
        const glm::dvec3 normal = outward + glm::dvec3(0.0, rise, 0.0);
        const double u = double(i) / segments;
        const auto on = [&](const glm::dvec2& circle, double along) {
            return builder.vertex({circle.x * outward.x, circle.y, circle.x * outward.z}, normal,
                                  {u, along});
        };
        const auto b = on(low, v.x);
        const auto c = on(high, v.y);
        if (i > 0) builder.quad(a, b, c, d);
        a = b;
        d = c;
    }
}

/// A cone's side from a circle (radius, height) to its apex on the Y axis.
void add_cone_side(Builder& builder, glm::dvec2 circle, double apex_height, glm::dvec2 v,
                   int segments) {
    const double rise = apex_height - circle.y;
    const auto slope = [&](const glm::dvec3& outward) {
        return rise * outward + glm::dvec3(0.0, circle.x, 0.0);
    };
    std::uint32_t a = 0;
    for (int i = 0; i <= segments; ++i) {
        const glm::dvec3 outward = around(i, segments);
        const auto b = builder.vertex({circle.x * outward.x, circle.y, circle.x * outward.z},
                                      slope(outward), {double(i) / segments, v.x});
        if (i > 0) {
            // Each triangle has an apex vertex of its own, with the normal of the triangle's
            // middle.
            const glm::dvec3 middle = around(2 * i - 1, 2 * segments);
            const auto apex =
                builder.vertex({0.0, apex_height, 0.0}, slope(middle), {(i - 0.5) / segments, v.y});
            builder.triangle(a, b, apex);
        }
        a = b;
    }
}

/// A disc across the Y axis at `height`, looking along `side` (+1 or -1) Y.
void add_disc(Builder& builder, double radius, double height, double side, int segments) {
    const glm::dvec3 normal(0.0, side, 0.0);
    const auto center = builder.vertex({0.0, height, 0.0}, normal, {0.5, 0.5});
    std::uint32_t last = 0;
    for (int i = 0; i <= segments; ++i) {
        const glm::dvec3 d = around(i % segments, segments);
        // As on the plane, +X is to the right; up in the picture is -Z from above, +Z from below.
        const auto rim = builder.vertex({radius * d.x, height, radius * d.z}, normal,
                                        {0.5 + 0.5 * d.x, 0.5 - 0.5 * side * d.z});
        if (i > 0 && side > 0.0) builder.triangle(center, last, rim);
        if (i > 0 && side < 0.0) builder.triangle(center, rim, last);
        last = rim;
    }
}

/// A disc with a hole, which looks along -Y.
void add_ring(Builder& builder, double inner, double outer, double height, int segments) {
    std::uint32_t a = 0;
    std::uint32_t d = 0;
    for (int i = 0; i <= segments; ++i) {
        const glm::dvec3 outward = around(i % segments, segments);
        const auto on = [&](double radius) {
            const double share = 0.5 * radius / outer;
            return builder.vertex({radius * outward.x, height, radius * outward.z},
                                  {0.0, -1.0, 0.0},
                                  {0.5 + share * outward.x, 0.5 + share * outward.z});
        };
        const auto b = on(inner);
        const auto c = on(outer);
        if (i > 0) builder.quad(d, a, b, c);
        a = b;
        d = c;
    }
}

}  // namespace

MeshData plane(double width, double depth) {
    expect_positive(width, "width");
    expect_positive(depth, "depth");
    const double x = 0.5 * width;
    const double z = 0.5 * depth;
    const glm::dvec3 up(0.0, 1.0, 0.0);
    Builder builder;
    const auto a = builder.vertex({-x, 0.0, z}, up, {0.0, 0.0});
    const auto b = builder.vertex({x, 0.0, z}, up, {1.0, 0.0});
    const auto c = builder.vertex({x, 0.0, -z}, up, {1.0, 1.0});
    const auto d = builder.vertex({-x, 0.0, -z}, up, {0.0, 1.0});
    builder.quad(a, b, c, d);
    return builder.mesh();
}

MeshData box(glm::dvec3 size) {
    for (int axis = 0; axis < 3; ++axis) expect_positive(size[axis], "size");
    // The normal of each face, and the direction that is up in its picture, seen from outside;
    // right is up x normal.
    constexpr std::array<std::pair<glm::dvec3, glm::dvec3>, 6> faces = {{
        {{1, 0, 0}, {0, 1, 0}},
        {{-1, 0, 0}, {0, 1, 0}},
        {{0, 1, 0}, {0, 0, -1}},
        {{0, -1, 0}, {0, 0, 1}},
        {{0, 0, 1}, {0, 1, 0}},
        {{0, 0, -1}, {0, 1, 0}},
    }};
    Builder builder;
    for (const auto& [normal, up] : faces) {
        const glm::dvec3 right = glm::cross(up, normal);
        const auto corner = [&, &n = normal, &u = up](double s, double t) {
            return builder.vertex(0.5 * size * (n + s * right + t * u), n,
                                  {0.5 + 0.5 * s, 0.5 + 0.5 * t});
        };
        const auto a = corner(-1, -1);
        const auto b = corner(1, -1);
        const auto c = corner(1, 1);
        const auto d = corner(-1, 1);
        builder.quad(a, b, c, d);
    }
    return builder.mesh();
}

MeshData sphere(double radius, int segments, int rings) {
    expect_positive(radius, "radius");
    expect_count(segments, 3, "segments");
    expect_count(rings, 2, "rings");
    expect_vertices(std::int64_t{segments} + 1, std::int64_t{rings} + 1);
    Builder builder;
    for (int row = 0; row <= rings; ++row) {
        // From the south pole up: half a turn is `rings` steps.
        const glm::dvec2 polar = turn(row, 2 * rings);
        const bool pole = row == 0 || row == rings;
        for (int column = 0; column <= segments; ++column) {
            const glm::dvec3 outward =
                pole ? glm::dvec3(0.0, -polar.y, 0.0)
                     : polar.x * around(column, segments) + glm::dvec3(0.0, -polar.y, 0.0);
            // Each vertex at a pole belongs to one triangle and has the u of that triangle's
            // middle.
            const double shift = row == 0 ? -0.5 : row == rings ? 0.5 : 0.0;
            const double u = std::clamp((column + shift) / segments, 0.0, 1.0);
            builder.vertex(radius * outward, outward, {u, double(row) / rings});
        }
    }
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row) * (static_cast<std::uint32_t>(segments) + 1) +
               static_cast<std::uint32_t>(column);
    };
    for (int row = 0; row < rings; ++row) {
        for (int column = 0; column < segments; ++column) {
            const auto a = at(row, column);
            const auto b = at(row, column + 1);
            const auto c = at(row + 1, column + 1);
            const auto d = at(row + 1, column);
            if (row == 0) {
                builder.triangle(b, c, d);
            } else if (row + 1 == rings) {
                builder.triangle(a, b, d);
            } else {
                builder.quad(a, b, c, d);
            }
        }
    }
    return builder.mesh();
}

MeshData cylinder(double radius, double height, int segments) {
    expect_positive(radius, "radius");
    expect_positive(height, "height");
    expect_count(segments, 3, "segments");
    expect_vertices(std::int64_t{segments} + 1, 4);
    const double half = 0.5 * height;
    Builder builder;
    add_band(builder, {radius, -half}, {radius, half}, 0.0, {0.0, 1.0}, segments);
    add_disc(builder, radius, half, 1.0, segments);
    add_disc(builder, radius, -half, -1.0, segments);
    return builder.mesh();
}

MeshData cone(double radius, double height, int segments) {
    expect_positive(radius, "radius");
    expect_positive(height, "height");
    expect_count(segments, 3, "segments");
    expect_vertices(std::int64_t{segments} + 1, 3);
    const double half = 0.5 * height;
    Builder builder;
    add_cone_side(builder, {radius, -half}, half, {0.0, 1.0}, segments);
    add_disc(builder, radius, -half, -1.0, segments);
    return builder.mesh();
}

MeshData torus(double radius, double tube, int segments, int sides) {
    expect_positive(radius, "radius");
    expect_positive(tube, "tube");
    expect(tube < radius, "a tube thinner than the radius",
           "tube " + describe(tube) + ", radius " + describe(radius));
    expect_count(segments, 3, "segments");
    expect_count(sides, 3, "sides");
    expect_vertices(std::int64_t{segments} + 1, std::int64_t{sides} + 1);
    Builder builder;
    for (int side = 0; side <= sides; ++side) {
        // The circle starts at the inside, where the seam is, and goes down, outside and up: v
        // grows upwards outside.
        const glm::dvec2 t = turn(side, sides);
        for (int i = 0; i <= segments; ++i) {
            const glm::dvec3 ring = around(i, segments);
            const glm::dvec3 outward = -t.y * ring + glm::dvec3(0.0, -t.x, 0.0);
            builder.vertex(radius * ring + tube * outward, outward,
                           {double(i) / segments, double(side) / sides});
        }
    }
    const auto columns = static_cast<std::uint32_t>(segments) + 1;
    for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(sides); ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const auto a = row * columns + column;
            builder.quad(a, a + 1, a + 1 + columns, a + columns);
        }
    }
    return builder.mesh();
}

MeshData arrow(double length, double radius, double head_length, double head_radius, int segments) {
    expect_positive(length, "length");
    expect_positive(radius, "radius");
    expect_positive(head_length, "head_length");
    expect_positive(head_radius, "head_radius");
    expect(head_length < length, "a head shorter than the arrow",
           "head_length " + describe(head_length) + ", length " + describe(length));
    expect(head_radius > radius, "a head wider than the shaft",
           "head_radius " + describe(head_radius) + ", radius " + describe(radius));
    expect_count(segments, 3, "segments");
    expect_vertices(std::int64_t{segments} + 1, 7);
    const double neck = length - head_length;
    // Along +Y first, as the other shapes; z is the height above the origin in the end.
    Builder builder;
    add_disc(builder, radius, 0.0, -1.0, segments);
    add_band(builder, {radius, 0.0}, {radius, neck}, 0.0, {0.0, neck / length}, segments);
    add_ring(builder, radius, head_radius, neck, segments);
    add_cone_side(builder, {head_radius, neck}, length, {neck / length, 1.0}, segments);
    return builder.turned_to_z();
}

}  // namespace cubecam::primitives
