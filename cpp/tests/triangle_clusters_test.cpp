/// Tests that groups of triangles find every triangle that a frustum shows, and few others.

#include "check.hpp"

#include "cubecam/geometry/triangle_clusters.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace cubecam;

namespace {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

/// Small triangles in a box of 2 x 2 x 2 units, some of them in one plane.
Soup soup(std::mt19937& random, std::uint32_t count) {
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    Soup made;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 middle(place(random), place(random), i % 3 == 0 ? 0.5F : place(random));
        for (int corner = 0; corner < 3; ++corner) {
            made.positions.push_back(middle +
                                     0.03F * glm::vec3(place(random), place(random), 0.0F));
        }
        made.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return made;
}

bool inside(const glm::dmat4& m, const glm::vec3& p) {
    const glm::dvec4 clip = m * glm::dvec4(glm::dvec3(p), 1.0);
    return glm::all(glm::lessThanEqual(glm::abs(glm::dvec3(clip)), glm::dvec3(clip.w)));
}

void finds_what_a_frustum_shows() {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-1.5, 1.5);
    for (const std::uint32_t count : {1U, 17U, 1000U, 20'000U}) {
        const Soup mesh = soup(random, count);
        const TriangleClusters clusters(mesh.positions, mesh.triangles);
        CHECK(clusters.finite());
        std::vector<std::uint32_t> sorted(clusters.order().begin(), clusters.order().end());
        std::sort(sorted.begin(), sorted.end());
        for (std::uint32_t i = 0; i < count; ++i) CHECK_EQUAL(sorted[i], i);
        std::size_t found_in_all = 0;
        std::size_t shown_in_all = 0;
        for (int turn = 0; turn < 20; ++turn) {
            const glm::dvec3 eye(place(random), place(random), place(random));
            const glm::dmat4 m =
                glm::perspective(0.2, 1.0, 0.1, 10.0) *
                glm::lookAt(eye, glm::dvec3(place(random), place(random), 0.0), {0.1, 1.0, 0.2});
            std::vector<TriangleClusters::Range> ranges;
            const std::size_t counted =
                clusters.find(Frustum(m), 0.0, glm::dvec4(0.0), count, ranges);
            std::vector<int> found(count, 0);
            for (const TriangleClusters::Range& range : ranges) {
                CHECK(range.first < range.last && range.last <= count);
                for (std::size_t i = range.first; i < range.last; ++i) ++found[clusters.order()[i]];
            }
            std::size_t total = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                CHECK(found[i] <= 1);
                total += static_cast<std::size_t>(found[i]);
                bool shows = false;
                for (int corner = 0; corner < 3; ++corner) {
                    shows = shows || inside(m, mesh.positions[mesh.triangles[i][corner]]);
                }
                CHECK(!shows || found[i] == 1);
                shown_in_all += shows ? 1 : 0;
            }
            CHECK_EQUAL(counted, total);
            found_in_all += total;
        }
        if (count == 20'000U) {
            CHECK(shown_in_all > 1000);
            CHECK(found_in_all < 20 * count / 4);
        }
    }
}

void gives_up_where_there_are_too_many() {
    std::mt19937 random(2);
    const Soup mesh = soup(random, 2000);
    const TriangleClusters clusters(mesh.positions, mesh.triangles);
    std::vector<TriangleClusters::Range> ranges;
    const Frustum all(glm::ortho(-2.0, 2.0, -2.0, 2.0, -2.0, 2.0));
    CHECK_EQUAL(clusters.find(all, 0.0, glm::dvec4(0.0), 2000, ranges), std::size_t{2000});
    CHECK_EQUAL(ranges.size(), std::size_t{1});
    ranges.clear();
    CHECK(clusters.find(all, 0.0, glm::dvec4(0.0), 1999, ranges) > 1999);
}

void growth_and_errors_widen_what_is_found() {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const TriangleClusters clusters(positions, {{0, 1, 2}});
    // It shows x from 1.5 to 2.5.
    const Frustum beside(glm::ortho(1.5, 2.5, -2.0, 2.0, -2.0, 2.0));
    const auto found = [&](double growth, const glm::dvec4& error) {
        std::vector<TriangleClusters::Range> ranges;
        return clusters.find(beside, growth, error, 1, ranges);
    };
    CHECK_EQUAL(found(0.0, glm::dvec4(0.0)), std::size_t{0});
    CHECK_EQUAL(found(0.4, glm::dvec4(0.0)), std::size_t{0});
    CHECK_EQUAL(found(0.6, glm::dvec4(0.0)), std::size_t{1});
    // Half a unit is 1 in clip space.
    CHECK_EQUAL(found(0.0, {0.9, 5.0, 5.0, 0.0}), std::size_t{0});
    CHECK_EQUAL(found(0.0, {1.1, 0.0, 0.0, 0.0}), std::size_t{1});
    CHECK_EQUAL(found(0.0, {0.0, 0.0, 0.0, 1.1}), std::size_t{1});
}

void corners_that_are_not_finite_are_told() {
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK(!TriangleClusters({{0, 0, 0}, {1, infinity, 0}, {0, 1, 0}}, {{0, 1, 2}}).finite());
    // A vertex of no triangle does not count.
    CHECK(TriangleClusters({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, infinity, 0}}, {{0, 1, 2}})
              .finite());
}

}  // namespace

int main() {
    finds_what_a_frustum_shows();
    gives_up_where_there_are_too_many();
    growth_and_errors_widen_what_is_found();
    corners_that_are_not_finite_are_told();
    return test::result();
}
