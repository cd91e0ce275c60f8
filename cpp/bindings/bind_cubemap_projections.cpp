// CubeMap.rotate, and what python/cubecam/projections.py needs of the core.
#include "arrays.hpp"
#include "cubemap_arguments.hpp"
#include "docs/cubemap.hpp"
#include "encodings.hpp"
#include "unlocked.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/cubemap/cubemap_project.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/scene/node.hpp"

#include <glm/gtc/quaternion.hpp>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

constexpr NameTable<ProjectionKind, 9> projection_names{{
    {"perspective", ProjectionKind::perspective},
    {"equidistant", ProjectionKind::equidistant},
    {"equisolid", ProjectionKind::equisolid},
    {"stereographic", ProjectionKind::stereographic},
    {"orthographic", ProjectionKind::orthographic},
    {"mirror_ball", ProjectionKind::mirror_ball},
    {"octahedral", ProjectionKind::octahedral},
    {"dual_paraboloid", ProjectionKind::dual_paraboloid},
    {"cylindrical", ProjectionKind::cylindrical},
}};

/// `axes` has the rows right, up and forward.
Projection to_projection(const Text& name, double fov, const ArrayLike& axes, int width,
                         int height) {
    const auto rows = double_array(axes, "axes", "(3, 3)");
    glm::dmat3 columns;
    std::copy_n(rows.data(), 9, &columns[0][0]);
    return {parse_name("kind", std::string(name), projection_names), fov,
            static_cast<double>(width) / height, columns};
}

/// The texel of an output where nothing is seen: that of the background.
std::vector<std::byte> background_of(const OutputValues& output) {
    std::vector<std::byte> texel(output.texel_size());
    const auto* row = std::find_if(output_table.begin(), output_table.end(),
                                   [&](const OutputRow& r) { return r.name == output.name; });
    if (row == output_table.end() || row->type != OutputType::float32) return texel;
    for (std::size_t at = 0; at < texel.size(); at += sizeof(float)) {
        std::memcpy(texel.data() + at, &row->clear, sizeof(float));
    }
    return texel;
}

PixelsOrOutput project(const CubeMap& cube, const Text& kind, Real fov, const ArrayLike& axes,
                       const std::pair<Int, Int>& size, const OneOf<DTypeLike, py::none>& dtype,
                       const Text& output_name) {
    const int width = to_texels(*size.first, "size");
    const int height = to_texels(*size.second, "size");
    const Projection projection = to_projection(kind, fov, axes, width, height);
    const auto state = cube.data();
    const OutputValues* output = to_output(cube, output_name);
    if (output != nullptr && !dtype.is_none()) {
        throw py::value_error("dtype: expected None with output='" + output->name +
                              "', which stays " + output_type_name(output->type) + ", got " +
                              text_of(dtype));
    }
    const DType to = to_dtype(dtype, state->dtype);
    const std::size_t texel = output != nullptr
                                  ? output->texel_size()
                                  : static_cast<std::size_t>(state->channels) * dtype_size(to);
    check_memory(static_cast<double>(texel) * width * height,
                 std::to_string(width) + " x " + std::to_string(height) + " pixels");
    PixelBuffer pixels;
    if (output != nullptr) {
        {
            const Unlocked unlocked;
            pixels = project_nearest(texels_of(cube, *output), projection, width, height,
                                     background_of(*output).data());
        }
        return output_array(std::move(pixels), *output, {height, width});
    }
    {
        const Unlocked unlocked;
        pixels = project_cube(*state, projection, width, height, to);
    }
    return owned_pixels(std::move(pixels), to, {height, width, state->channels});
}

CubePtr unproject(const ArrayLike& value, const Text& kind, Real fov, const ArrayLike& axes,
                  Int size, Flag mipmaps, const OneOf<DTypeLike, py::none>& dtype,
                  const EncodingName& encoding_name) {
    const PixelArray image = pixel_array(value, "image", "(H, W, C)");
    const DType to = to_dtype(dtype, image.dtype());
    const Encoding encoding = to_encoding(encoding_name, value, image.dtype());
    const int height = to_texels(image.shape(0), "image");
    const int width = to_texels(image.shape(1), "image");
    const auto channels = static_cast<int>(image.shape(2));
    const int n = to_texels(*size, "size");
    const Projection projection = to_projection(kind, fov, axes, width, height);
    check_memory(static_cast<double>(dtype_size(to)) * 6.0 * n * n * channels,
                 std::to_string(n) + " x " + std::to_string(6 * n) + " pixels");
    const Unlocked unlocked;
    PixelBuffer faces =
        picture_to_cube({image.data(), width, height, channels, image.dtype()}, projection, n, to);
    return std::make_shared<CubeMap>(n, channels, to, std::move(faces), mipmaps, OutputList(),
                                     encoding);
}

CubePtr rotate(const CubeMap& cube, const ArrayLike& rotation) {
    const glm::dmat3 turn = glm::mat3_cast(unit_rotation(to_rotation(rotation, "rotation")));
    const auto state = cube.data();
    check_memory(static_cast<double>(state->face_bytes()) * face_count,
                 "a cube of " + std::to_string(state->size) + " texels along an edge");
    const Unlocked unlocked;
    auto faces = std::make_shared<PixelBuffer>(rotate_faces(*state, turn));
    std::shared_ptr<CubeLevels> levels;
    if (state->levels) {
        levels = std::make_shared<CubeLevels>(*state->levels);
        for (CubeLevel& level : *levels) {
            CubeMapData data = *state;
            data.size = level.size;
            data.pixels = level.pixels;
            level.pixels = std::make_shared<PixelBuffer>(rotate_faces(data, turn));
        }
    }
    OutputList outputs = cube.outputs();
    for (OutputValues& output : outputs) {
        PixelBuffer values = rotate_nearest(texels_of(cube, output), turn);
        if (output.name == "z") rotate_z(values, state->size, turn);
        output.values = std::make_shared<PixelBuffer>(std::move(values));
    }
    return std::make_shared<CubeMap>(state->size, state->channels, state->dtype, std::move(faces),
                                     state->mipmaps, std::move(outputs), state->encoding,
                                     std::move(levels));
}

}  // namespace

void bind_cubemap_projections(py::module_& module, Class<CubeMap>& cube) {
    cube.def("rotate", &rotate, py::arg("rotation"), docs::rotate);
    module.def("_project", &project, py::arg("cube"), py::arg("kind"), py::arg("fov"),
               py::arg("axes"), py::arg("size"), py::arg("dtype"), py::arg("output"),
               "A picture of a projection (math/projections.hpp); `fov` is in radians, `axes` has "
               "the rows right, up and forward, and `size` is (width, height).");
    module.def("_unproject", &unproject, py::arg("image"), py::arg("kind"), py::arg("fov"),
               py::arg("axes"), py::arg("size"), py::arg("mipmaps"), py::arg("dtype"),
               py::arg("encoding"), "A cube of a picture that `_project` could have made.");
}

}  // namespace cubecam::bindings
