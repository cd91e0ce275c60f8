#include "cubecam/render/resources/filtered_cubes.hpp"

#include "cubecam/lighting/radiance_faces.hpp"

namespace cubecam {
namespace {

FilteredLevel irradiance_of(const CubeMapData& data) {
    FilteredCube filter({.size = data.size, .levels = 1});
    filter.update(data, {});  // the first time, all faces
    return filter.irradiance();
}

}  // namespace

const FilteredTexture& FilteredCubes::get(const gl::Context& context, const CubeSnapshot& cube,
                                          Stats& stats) {
    const CubeMapData& data = *cube.data;
    Entry& entry = cubes_.get(cube.object, [] { return Entry{}; });
    if (!data.levels) {
        return entry.faces.update(
            context, data.size, data.face_revisions,
            [&data](Face face) { return radiance_face(data, face); }, stats);
    }
    if (entry.own_revision != data.revision) {
        entry.own.upload(context, own_levels(data), irradiance_of(data));
        entry.own_revision = data.revision;
    }
    return entry.own;
}

}  // namespace cubecam
