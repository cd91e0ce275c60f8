// The methods of cubecam.CubeMap that filter its light, and cubecam._core._brdf.
#include "arrays.hpp"
#include "cubemap_arguments.hpp"
#include "docs/lighting.hpp"
#include "numbers.hpp"
#include "unlocked.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/lighting/brdf_table.hpp"
#include "cubecam/lighting/prefilter.hpp"
#include "cubecam/lighting/spherical_harmonics.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

using Levels = py::typing::Tuple<Pixels, py::ellipsis>;
using ProgressLike = Shown<"collections.abc.Callable[[float], object] | None">;
using CubesLike = Shown<"collections.abc.Sequence[CubeMap]">;
using SizeOrNone = OneOf<WholeNumber, py::none>;

constexpr int most_levels = 64;

py::array level_view(const CubeMapData& state, int size,
                     const std::shared_ptr<const PixelBuffer>& pixels) {
    return readonly_view(numpy_dtype(state.dtype), face_shape(size, state.channels), pixels->data(),
                         pixels);
}

Levels levels_of(const CubeMap& cube) {
    const auto state = cube.data();
    py::list levels;
    levels.append(level_view(*state, state->size, state->pixels));
    if (state->levels) {
        for (const CubeLevel& level : *state->levels) {
            levels.append(level_view(*state, level.size, level.pixels));
        }
    }
    return py::tuple(levels);
}

/// The pixels are shared, not copied.
CubePtr cube_from_levels(const CubesLike& cubes) {
    if (!py::isinstance<py::sequence>(cubes)) refuse(cubes, "levels", "a sequence of CubeMaps");
    const auto levels = py::reinterpret_borrow<py::sequence>(cubes);
    const auto count = static_cast<int>(levels.size());
    if (count < 2 || count > most_levels) {
        throw py::value_error("levels: expected 2 to " + std::to_string(most_levels) + ", got " +
                              std::to_string(count));
    }
    std::shared_ptr<const CubeMapData> first;
    auto rest = std::make_shared<CubeLevels>();
    for (int k = 0; k < count; ++k) {
        const py::object each = levels[static_cast<std::size_t>(k)];
        const std::string name = "levels[" + std::to_string(k) + "]";
        if (!py::isinstance<CubeMap>(each)) refuse(each, name.c_str(), "a CubeMap");
        const auto level = each.cast<const CubeMap&>().data();
        if (!first) {
            first = level;
            continue;
        }
        if (level->channels != first->channels || level->dtype != first->dtype) {
            throw py::value_error(name + ": expected " + std::to_string(first->channels) +
                                  " channels of " + dtype_name(first->dtype) + ", got " +
                                  std::to_string(level->channels) + " of " +
                                  dtype_name(level->dtype));
        }
        rest->push_back({level->size, level_roughness(k, count), level->pixels});
    }
    return std::make_shared<CubeMap>(first->size, first->channels, first->dtype,
                                     std::make_shared<PixelBuffer>(*first->pixels), first->mipmaps,
                                     OutputList(), first->encoding, std::move(rest));
}

py::array_t<float> roughness_of(const CubeMap& cube) {
    const auto state = cube.data();
    auto values = std::make_shared<std::vector<float>>(1, 0.0F);
    if (state->levels) {
        for (const CubeLevel& level : *state->levels) values->push_back(level.roughness);
    }
    const auto count = static_cast<py::ssize_t>(values->size());
    return readonly_view(std::shared_ptr<const std::vector<float>>(std::move(values)), {count});
}

/// Raises ValueError for faces of n x n texels that memory cannot hold while they are made.
void check_faces(int n, std::size_t texel_bytes) {
    const double side = n;
    check_memory(face_count * side * side * static_cast<double>(texel_bytes),
                 "6 x " + std::to_string(n) + " x " + std::to_string(n) + " texels");
}

/// The bytes of a texel that is filtered: as a vec4 and in the sum of each, with smaller levels.
constexpr std::size_t filtered_texel = 64;

/// Runs work that takes a progress function, without the GIL. What the user's function raises, and
/// KeyboardInterrupt, end the work.
template <typename Work>
CubePtr interruptible(py::handle progress, const Work& work) {
    if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0) {
        refuse(progress, "progress", "a function of one number, or None");
    }
    const auto report = [&](double share) {
        if (progress.is_none()) return true;
        const Locked locked;
        PyObject* result = PyObject_CallFunction(progress.ptr(), "d", share);
        if (result == nullptr) throw py::error_already_set();
        Py_DECREF(result);
        return true;
    };
    const Unlocked unlocked;
    return work(report);
}

CubePtr prefilter_cube(const CubeMap& cube, const WholeNumber& level_count, const SizeOrNone& size,
                       const ProgressLike& progress) {
    const auto levels = static_cast<int>(to_int(level_count, "levels", 2, most_levels));
    auto state = cube.data();
    const int n = size.is_none() ? state->size : to_texels(to_int(size, "size"), "size");
    check_faces(n, filtered_texel);
    return interruptible(progress, [&](const FilteredCube::Progress& report) {
        if (n != state->size) {
            const CubeMap resized(
                n, state->channels, state->dtype,
                resample_faces(*state, Sampling::centers, n, Sampling::centers, state->dtype),
                state->mipmaps, OutputList(), state->encoding);
            state = resized.data();
        }
        return prefilter(*state, levels, report);
    });
}

CubePtr irradiance_of(const CubeMap& cube, const WholeNumber& size, const ProgressLike& progress) {
    const int n = to_texels(to_int(size, "size"), "size");
    check_faces(n, filtered_texel);
    const auto state = cube.data();
    return interruptible(progress, [&](const FilteredCube::Progress& report) {
        return irradiance(*state, n, report);
    });
}

py::array_t<double> sh_of(const CubeMap& cube, const WholeNumber& order_value) {
    const auto order = static_cast<int>(to_int(order_value, "order", 0, largest_sh_order));
    const auto state = cube.data();
    std::vector<double> coefficients;
    {
        const Unlocked unlocked;
        coefficients = cube_to_sh(*state, order);
    }
    return owned_array(std::move(coefficients),
                       {static_cast<py::ssize_t>(sh_count(order)), state->channels});
}

CubePtr cube_from_sh(const ArrayLike& value, const WholeNumber& size) {
    const auto array = double_array(value, "coefficients", "(K, C)");
    const auto order =
        static_cast<int>(std::lround(std::sqrt(static_cast<double>(array.shape(0))))) - 1;
    if (order < 0 || order > largest_sh_order ||
        static_cast<py::ssize_t>(sh_count(order)) != array.shape(0)) {
        throw py::value_error("coefficients: expected 1, 4, 9, 16, ... up to " +
                              std::to_string(sh_count(largest_sh_order)) + " rows, got " +
                              std::to_string(array.shape(0)));
    }
    const auto channels = static_cast<int>(array.shape(1));
    if (channels != 1 && channels != 3 && channels != 4) {
        throw py::value_error("coefficients: expected 1, 3 or 4 columns, got " +
                              std::to_string(array.shape(1)));
    }
    const int n = to_texels(to_int(size, "size"), "size");
    check_faces(n, 2 * sizeof(float) * static_cast<std::size_t>(channels));
    const std::vector<double> coefficients = to_vector(array);
    const Unlocked unlocked;
    const Buffer<float> faces = sh_to_faces(coefficients, order, channels, n);
    PixelBuffer pixels(faces.size() * sizeof(float));
    floats_to_pixels(DType::float32, faces.data(), faces.size(), pixels.data());
    return std::make_shared<CubeMap>(n, channels, DType::float32, std::move(pixels));
}

/// Arrays of one shape, which Python broadcast.
py::array_t<float> brdf_of(const ContiguousArray<float>& n_dot_v,
                           const ContiguousArray<float>& roughness) {
    std::vector<py::ssize_t> shape(n_dot_v.shape(), n_dot_v.shape() + n_dot_v.ndim());
    shape.push_back(2);
    py::array_t<float> result(shape);
    const float* cosine = n_dot_v.data();
    const float* rough = roughness.data();
    float* to = result.mutable_data();
    for (py::ssize_t i = 0; i < n_dot_v.size(); ++i) {
        const glm::vec2 found = brdf(cosine[i], rough[i]);
        *to++ = found.x;
        *to++ = found.y;
    }
    return result;
}

py::array_t<float> brdf_table_view() {
    const std::span<const glm::vec4> table = brdf_table();
    // The table lives as long as the process.
    const std::shared_ptr<const void> owner(table.data(), [](const void*) {});
    return readonly_view(py::dtype::of<float>(), {brdf_table_size, brdf_table_size, 4},
                         table.data(), owner);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_lighting(py::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;

    declared<CubeMap>()
        .def_property_readonly("levels", &levels_of, docs::levels)
        .def_property_readonly("roughness", &roughness_of, docs::roughness)
        .def("prefilter", &prefilter_cube, py::arg("levels") = 6, py::arg("size") = py::none(),
             py::kw_only(), py::arg("progress") = py::none(), docs::prefilter)
        .def("irradiance", &irradiance_of, py::arg("size") = 32, py::kw_only(),
             py::arg("progress") = py::none(), docs::irradiance)
        .def("sh", &sh_of, py::arg("order") = 2, docs::sh)
        .def_static("from_levels", &cube_from_levels, py::arg("levels"), docs::from_levels)
        .def_static("from_sh", &cube_from_sh, py::arg("coefficients"), py::kw_only(),
                    py::arg("size") = 32, docs::from_sh);
    module.def("_brdf", &brdf_of, py::arg("n_dot_v"), py::arg("roughness"),
               "For cubecam.brdf: (..., 2) of arrays of one shape.");
    module.def("_brdf_table", &brdf_table_view,
               "The table of the shaders, (64, 64, 4) float32: roughness by N.V; scale, bias, the "
               "albedo of sheen, 0.");
}
