#include "cubecam/render/resources/filtered_faces.hpp"

namespace cubecam {

const FilteredTexture& FilteredFaces::update(const gl::Context& context, int size,
                                             const Revisions& revisions,
                                             const std::function<Texels(Face)>& read,
                                             Stats& stats) {
    const FilterRule rule{.size = size};
    if (!filter_ || !(filter_->rule() == rule)) {
        filter_.emplace(rule);
        revisions_ = {};
    }
    if (revisions_ == revisions) return texture_;

    std::array<bool, face_count> changed{};
    std::array<Texels, face_count> texels;
    FilteredCube::Faces faces;
    for (const Face face : all_faces) {
        const std::size_t i = face_index(face);
        changed[i] = revisions_[i] != revisions[i];
        if (changed[i]) {
            texels[i] = read(face);
            ++stats.faces_filtered;
        }
        faces[i] = texels[i];
    }
    revisions_ = {};  // until the update is complete
    filter_->update(faces, changed);
    texture_.upload(context, filter_->levels(), filter_->irradiance());
    revisions_ = revisions;
    return texture_;
}

}  // namespace cubecam
