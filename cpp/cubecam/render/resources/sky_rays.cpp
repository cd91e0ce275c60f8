#include "cubecam/render/resources/sky_rays.hpp"

#include <algorithm>
#include <cmath>

namespace cubecam {
namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The sum of the columns of a matrix, each times a number.
glm::dvec3 at(const glm::dmat3& rays, const glm::dvec2& place) {
    return rays[0] + place.x * rays[1] + place.y * rays[2];
}

/// The place of the shortest of the rays rays[0] + x rays[1] + y rays[2]; the middle for parallel
/// rays, which all have the same length.
glm::dvec2 shortest(const glm::dmat3& rays) {
    const double xx = glm::dot(rays[1], rays[1]);
    const double xy = glm::dot(rays[1], rays[2]);
    const double yy = glm::dot(rays[2], rays[2]);
    const double x = -glm::dot(rays[0], rays[1]);
    const double y = -glm::dot(rays[0], rays[2]);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0)) return glm::dvec2(0.0);
    return glm::dvec2(x * yy - y * xy, y * xx - x * xy) / determinant;
}

double half_pixel(double place, int size) {
    return std::clamp(0.5 * std::round(2.0 * place), 0.0, static_cast<double>(size));
}

}  // namespace

glm::dmat4 sky_rays(const View& view, int width, int height) {
    const glm::dmat4 rows = glm::transpose(view.projection);
    const glm::dvec3 row_w(rows[3]);
    // A factor of one side of a cross product does not turn it, and products of the rows of a very
    // narrow or very wide view could overflow.
    const double by_x = std::max(largest(glm::dvec3(rows[0])), largest(row_w));
    const double by_y = std::max(largest(glm::dvec3(rows[1])), largest(row_w));
    const glm::dvec3 x = glm::dvec3(rows[0]) / by_x;
    const glm::dvec3 y = glm::dvec3(rows[1]) / by_y;
    const glm::dvec2 half = 0.5 * glm::dvec2(width, height);
    const glm::dmat3 rays(glm::cross(x, y), glm::cross(y, row_w / by_x) / half.x,
                          glm::cross(row_w / by_y, x) / half.y);

    // Of both directions along a ray, what is seen has a positive w. Parallel rays go from the near
    // plane to the far one.
    double towards = glm::dot(row_w / by_x, rays[0]);
    if (towards == 0.0) towards = glm::dot(glm::dvec3(rows[2]), rays[0]) * rows[3].w;

    const glm::dvec2 axis = shortest(rays) + half;
    const glm::dvec2 centre(half_pixel(axis.x, width), half_pixel(axis.y, height));
    const glm::dvec3 first = at(rays, centre - half);
    const double longest =
        std::max({largest(first), largest(rays[1]) * width, largest(rays[2]) * height});
    const glm::dmat3 scaled =
        glm::dmat3(first, rays[1], rays[2]) * ((towards < 0.0 ? -1.0 : 1.0) / longest);
    // Rays turn to the world by the inverse of the view alone, which knows neither plane.
    glm::dmat4 in_world(glm::inverse(glm::dmat3(view.view)) * scaled);
    in_world[3] = glm::dvec4(centre, 0.0, 0.0);
    return in_world;
}

}  // namespace cubecam
