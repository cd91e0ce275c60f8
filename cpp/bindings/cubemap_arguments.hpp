/// What the two binding files of cubecam.CubeMap share.
#pragma once

#include "choice.hpp"
#include "objects.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/cubemap/cubemap_layout.hpp"
#include "cubecam/cubemap/cubemap_nearest.hpp"

#include <memory>
#include <string>
#include <vector>

namespace cubecam::bindings {

using CubePtr = std::shared_ptr<CubeMap>;
using ConventionName = Choice<convention_names>;
using LayoutName = Choice<layout_names>;
using CenterName = Choice<center_names>;

inline std::vector<py::ssize_t> face_shape(int size, int channels) {
    return {6, size, size, channels};
}

inline int to_texels(py::ssize_t length, const char* name) {
    constexpr py::ssize_t limit = 1 << 20;  // no texture is larger, and products stay in range
    if (length < 1 || length > limit) {
        throw py::value_error(std::string(name) + ": expected 1 to " + std::to_string(limit) +
                              " texels, got " + std::to_string(length));
    }
    return static_cast<int>(length);
}

/// The output of a cube that an argument `output` names; null for "color". Raises ValueError that
/// lists the outputs of the cube.
const OutputValues* to_output(const CubeMap& cube, const std::string& name);

/// The bytes of an output's texels.
inline TexelBytes texels_of(const CubeMap& cube, const OutputValues& output) {
    return {output.values->data(), cube.data()->size, output.texel_size()};
}

/// An array of texels of an output's type; the axis of the channels is left out if there is one.
py::array output_array(PixelBuffer texels, const OutputValues& output,
                       std::vector<py::ssize_t> shape);

/// The methods that turn a cube into pictures and back: panoramas, layouts, other conventions and
/// other sizes.
void bind_cubemap_pictures(Class<CubeMap>& cube);

/// `CubeMap.rotate`, and the functions behind the methods of python/cubecam/projections.py.
void bind_cubemap_projections(py::module_& module, Class<CubeMap>& cube);

}  // namespace cubecam::bindings
