#include "cubecam/geometry/morph_target.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/geometry/vertex_checks.hpp"

#include <utility>

namespace cubecam {

namespace {

template <class T>
std::vector<T> rows_at(const MorphTarget::Array<T>& values,
                       const std::vector<std::uint32_t>& vertices) {
    std::vector<T> rows;
    if (!values) return rows;
    rows.reserve(vertices.size());
    for (const std::uint32_t vertex : vertices) rows.push_back((*values)[vertex]);
    return rows;
}

template <class T>
std::vector<T> copied(const MorphTarget::Array<T>& values) {
    return values ? *values : std::vector<T>();
}

}  // namespace

template <class T>
MorphTarget::Array<T> MorphTarget::taken(std::vector<T> values, const char* name) {
    if (values.empty()) return nullptr;
    if (vertices_ == 0) vertices_ = values.size();
    if (values.size() != vertices_) {
        expect(false,
               std::string("as many ") + name + " as other numbers of the morph target, " +
                   std::to_string(vertices_),
               std::to_string(values.size()));
    }
    check_finite(values, name);
    return std::make_shared<const std::vector<T>>(std::move(values));
}

MorphTarget::MorphTarget(Arrays arrays, std::string name) : name_(std::move(name)) {
    positions_ = taken(std::move(arrays.positions), "positions");
    normals_ = taken(std::move(arrays.normals), "normals");
    tangents_ = taken(std::move(arrays.tangents), "tangents");
    uvs_ = taken(std::move(arrays.uvs), "uvs");
    colors_ = taken(std::move(arrays.colors), "colors");
    uvs1_ = taken(std::move(arrays.uvs1), "uvs1");
    expect(vertices_ > 0, "a morph target of at least one array", "none");
}

MorphTarget MorphTarget::gathered(const std::vector<std::uint32_t>& vertices) const {
    return {{rows_at(positions_, vertices), rows_at(normals_, vertices),
             rows_at(tangents_, vertices), rows_at(uvs_, vertices), rows_at(colors_, vertices),
             rows_at(uvs1_, vertices)},
            name_};
}

MorphTarget MorphTarget::scaled(double factor) const {
    Arrays arrays{copied(positions_), copied(normals_), copied(tangents_),
                  copied(uvs_),       copied(colors_),  copied(uvs1_)};
    for (glm::vec3& position : arrays.positions) {
        position = glm::vec3(glm::dvec3(position) * factor);
    }
    return {std::move(arrays), name_};
}

}  // namespace cubecam
