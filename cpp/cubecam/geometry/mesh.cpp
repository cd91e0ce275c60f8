#include "cubecam/geometry/mesh.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/revision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

template <class Vector>
void check_finite(const std::vector<Vector>& values, const char* name) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        for (int axis = 0; axis < Vector::length(); ++axis) {
            if (std::isfinite(values[i][axis])) continue;
            throw std::invalid_argument(std::string("expected finite ") + name + ", got " +
                                        describe(values[i][axis]) + " at vertex " +
                                        std::to_string(i));
        }
    }
}

void check_alpha(const std::vector<glm::vec4>& colors) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const glm::vec4& c = colors[i];
        if (c.a >= 0.0F && c.a <= 1.0F) continue;
        throw std::invalid_argument("expected colors with an alpha from 0 to 1, got " +
                                    describe(c) + " at vertex " + std::to_string(i));
    }
}

template <class Vector>
void check_length(const std::vector<Vector>& values, std::size_t vertices, const char* name) {
    if (values.empty() || values.size() == vertices) return;
    throw std::invalid_argument("expected as many " + std::string(name) + " as positions, " +
                                std::to_string(vertices) + ", got " +
                                std::to_string(values.size()));
}

void check_triangles(const std::vector<glm::uvec3>& triangles, std::size_t vertices) {
    expect(!triangles.empty(), "at least one triangle", "none");
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3& t = triangles[i];
        const std::uint32_t largest = std::max({t.x, t.y, t.z});
        if (largest < vertices) continue;
        throw std::out_of_range("expected indices below the number of vertices, " +
                                std::to_string(vertices) + ", got " + std::to_string(largest) +
                                " in triangle " + std::to_string(i));
    }
}

/// Makes every normal unit length. Those without a direction (files hold such) become smooth ones.
void normalise(std::vector<glm::vec3>& normals, const std::vector<glm::vec3>& positions,
               const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::vec3> smooth;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 normal(normals[i]);
        const double length = glm::length(normal);
        if (length == 0.0) {
            if (smooth.empty()) smooth = smooth_normals(positions, triangles);
            normals[i] = smooth[i];
        } else if (std::abs(length - 1.0) > 1e-6) {
            // Closer ones stay as they are, so that arrays that went out come back unchanged.
            normals[i] = glm::vec3(normal / length);
        }
    }
}

Bounds bounds_of(const std::vector<glm::vec3>& positions) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (const glm::vec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    return {glm::dvec3(low), glm::dvec3(high)};
}

template <class T>
Mesh::Array<T> shared(std::vector<T>&& values) {
    return values.empty() ? nullptr : std::make_shared<const std::vector<T>>(std::move(values));
}

}  // namespace

Mesh::Mesh(Arrays arrays) : revision_(next_revision()) {
    const std::size_t vertices = arrays.positions.size();
    check_triangles(arrays.triangles, vertices);
    check_length(arrays.normals, vertices, "normals");
    check_length(arrays.uvs, vertices, "uvs");
    check_length(arrays.colors, vertices, "colors");
    check_finite(arrays.positions, "positions");
    check_finite(arrays.normals, "normals");
    check_finite(arrays.uvs, "uvs");
    check_finite(arrays.colors, "colors");
    check_alpha(arrays.colors);

    if (arrays.normals.empty()) {
        arrays.normals = smooth_normals(arrays.positions, arrays.triangles);
    } else {
        normalise(arrays.normals, arrays.positions, arrays.triangles);
    }
    bounds_ = bounds_of(arrays.positions);
    translucent_colors_ = std::any_of(arrays.colors.begin(), arrays.colors.end(),
                                      [](const glm::vec4& color) { return color.a < 1.0F; });
    positions_ = shared(std::move(arrays.positions));
    triangles_ = shared(std::move(arrays.triangles));
    normals_ = shared(std::move(arrays.normals));
    uvs_ = shared(std::move(arrays.uvs));
    colors_ = shared(std::move(arrays.colors));
}

std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& positions,
                                      const std::vector<glm::uvec3>& triangles) {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : triangles) {
        glm::dvec3 corners[3];
        for (int i = 0; i < 3; ++i) corners[i] = glm::dvec3(positions[triangle[i]]);
        const glm::dvec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double twice_area = glm::length(cross);
        if (!(twice_area > 0.0)) continue;
        const glm::dvec3 normal = cross / twice_area;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 a = corners[(i + 1) % 3] - corners[i];
            const glm::dvec3 b = corners[(i + 2) % 3] - corners[i];
            // |a x b| is twice the area at every corner; atan2 keeps its digits at small angles.
            sums[triangle[i]] += std::atan2(twice_area, glm::dot(a, b)) * normal;
        }
    }
    std::vector<glm::vec3> normals(positions.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i]);
        normals[i] = length > 0.0 ? glm::vec3(sums[i] / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }
    return normals;
}

Mesh centred_and_scaled(const Mesh& mesh, double size) {
    expect_positive(size, "size");
    const glm::dvec3 extent = mesh.bounds().extent();
    const double largest = std::max({extent.x, extent.y, extent.z});
    expect(largest > 0.0, "a mesh of some extent", "all vertices at one point");
    const glm::dvec3 center = mesh.bounds().center();
    const double factor = size / largest;

    Mesh::Arrays arrays;
    arrays.positions.reserve(mesh.positions()->size());
    for (const glm::vec3& position : *mesh.positions()) {
        arrays.positions.emplace_back((glm::dvec3(position) - center) * factor);
    }
    arrays.triangles = *mesh.triangles();
    arrays.normals = *mesh.normals();
    if (mesh.uvs()) arrays.uvs = *mesh.uvs();
    if (mesh.colors()) arrays.colors = *mesh.colors();
    return Mesh(std::move(arrays));
}

}  // namespace cubecam
