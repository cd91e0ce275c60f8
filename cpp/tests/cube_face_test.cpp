/// Compares the faces of a cube with table 8.19 of the OpenGL 4.6 specification, and tests which
/// edges touch.

#include "check.hpp"

#include "cubecam/math/cube_edges.hpp"
#include "cubecam/math/cube_face.hpp"

#include <array>
#include <cmath>
#include <utility>

using namespace cubecam;

namespace {

/// A row of the table: the direction that has sc = 1, tc = 0, and the one that has sc = 0, tc = 1.
struct Row {
    Face face;
    glm::dvec3 major, along_s, along_t;
};

const std::array<Row, 6> table = {{
    {Face::pos_x, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {Face::neg_x, {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {Face::pos_y, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {Face::neg_y, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {Face::pos_z, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
    {Face::neg_z, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
}};

bool near(double a, double b) { return std::abs(a - b) < 1e-12; }

void check_table() {
    for (const Row& row : table) {
        for (const double s : {0.1, 0.5, 0.8}) {
            for (const double t : {0.2, 0.5, 0.7}) {
                const glm::dvec3 direction =
                    row.major + (2 * s - 1) * row.along_s + (2 * t - 1) * row.along_t;
                const FaceUv<double> found = direction_to_face_uv(direction * 3.0);
                CHECK(found.face == row.face);
                CHECK(near(found.s, s));
                CHECK(near(found.t, t));
                const glm::dvec3 back = face_uv_to_direction(row.face, s, t);
                CHECK(near(back.x, direction.x) && near(back.y, direction.y) &&
                      near(back.z, direction.z));
            }
        }
    }
}

/// A step beyond a side of a face leads to the face that the table of edges names, and back.
void check_edges() {
    const std::array<std::pair<double, double>, 4> beyond = {
        {{-0.01, 0.5}, {1.01, 0.5}, {0.5, -0.01}, {0.5, 1.01}}};
    for (const Face face : all_faces) {
        for (std::size_t side = 0; side < 4; ++side) {
            const auto [s, t] = beyond[side];
            const CubeEdge& edge = cube_edges[face_index(face)][side];
            CHECK(direction_to_face_uv(face_uv_to_direction(face, s, t)).face == edge.face);
            bool back = false;
            for (const CubeEdge& other : cube_edges[face_index(edge.face)]) {
                back = back || other.face == face;
            }
            CHECK(back);
        }
    }
}

}  // namespace

int main() {
    check_table();
    check_edges();
    return test::result();
}
