// The methods of cubecam.CubeMap that make pictures of it and read it from pictures.
#include "arrays.hpp"
#include "cubemap_arguments.hpp"
#include "docs/cubemap.hpp"
#include "encodings.hpp"
#include "numbers.hpp"
#include "sampling_name.hpp"
#include "unlocked.hpp"
#include "values.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/cubemap/cubemap_layout.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace cubecam::bindings {

namespace {

using DTypeOrNone = OneOf<DTypeLike, py::none>;

/// Raises ValueError for a picture that memory cannot hold.
void check_picture(double width, double height, int channels, DType dtype) {
    check_memory(static_cast<double>(dtype_size(dtype)) * width * height * channels,
                 std::to_string(static_cast<long long>(width)) + " x " +
                     std::to_string(static_cast<long long>(height)) + " pixels");
}

/// Raises ValueError for a dtype given with an output, whose numbers are not converted.
void check_no_dtype(const DTypeOrNone& dtype, const OutputValues& output) {
    if (dtype.is_none()) return;
    throw py::value_error("dtype: expected None with output='" + output.name + "', which stays " +
                          output_type_name(output.type) + ", got " + text_of(dtype));
}

PixelsOrOutput to_equirect(const CubeMap& cube, Argument<std::optional<int>> width,
                           const CenterName& center_name, const SamplingName& sampling_name,
                           const DTypeOrNone& dtype, const Text& output_name) {
    const Center center = parse_center(center_name);
    const Sampling sampling = parse_sampling(sampling_name);
    const auto state = cube.data();
    if (const OutputValues* output = to_output(cube, output_name)) {
        check_no_dtype(dtype, *output);
        const int columns = to_texels(width.value_or(4 * state->size), "width");
        check_picture(columns, columns / 2.0, output->channels, DType::float32);
        PixelBuffer texels;
        {
            const Unlocked unlocked;
            texels = nearest_equirect(texels_of(cube, *output), columns, center, sampling);
        }
        return output_array(std::move(texels), *output, {columns / 2, columns});
    }
    const DType to = to_dtype(dtype, state->dtype);
    const int columns = to_texels(width.value_or(4 * state->size), "width");
    check_picture(columns, columns / 2.0, state->channels, to);
    std::shared_ptr<PixelBuffer> pixels;
    {
        const Unlocked unlocked;
        pixels = cube_to_equirect(*state, columns, center, sampling, to);
    }
    return owned_pixels(std::move(pixels), numpy_dtype(to),
                        {columns / 2, columns, state->channels});
}

CubePtr from_equirect(const PixelArray& image, std::optional<int> size, Center center, bool mipmaps,
                      Sampling sampling, DType to, Encoding encoding) {
    const int height = to_texels(image.shape(0), "image");
    const int width = to_texels(image.shape(1), "image");
    const auto channels = static_cast<int>(image.shape(2));
    const int n = to_texels(size.value_or(default_face_size(width)), "size");
    check_picture(n, 6.0 * n, channels, to);
    try {
        const Unlocked unlocked;
        return std::make_shared<CubeMap>(
            n, channels, to,
            equirect_to_cube(
                {image.data(), width, height, channels, image.dtype(), center, sampling}, n, to),
            mipmaps, OutputList(), encoding);
    } catch (const FoundNan& found) {
        refuse_nan(image, "image", found.index);
    }
}

CubePtr from_layout(const ArrayLike& value, const std::optional<LayoutName>& layout_name,
                    const ConventionName& convention_name, Argument<std::optional<int>> size,
                    const CenterName& center_name, Flag mipmaps, const DTypeOrNone& dtype,
                    const EncodingName& encoding_name) {
    const Convention convention = parse_convention(convention_name);
    const Center center = parse_center(center_name);
    const PixelArray image = pixel_array(value, "image", "(H, W, C)", Values::any);
    const DType to = to_dtype(dtype, image.dtype());
    const Encoding encoding = to_encoding(encoding_name, value, image.dtype());
    const int height = to_texels(image.shape(0), "image");
    const int width = to_texels(image.shape(1), "image");
    const Layout layout =
        layout_name ? parse_layout(*layout_name) : recognize_layout(width, height);
    if (layout == Layout::equirect) {
        return from_equirect(image, size, center, mipmaps, Sampling::centers, to, encoding);
    }
    check_not_nan(image, "image");
    if (size) throw py::value_error("size: expected only with an equirect; see CubeMap.resize");
    const bool openexr = layout == Layout::openexr;
    const Layout cells = openexr ? Layout::column : layout;
    const int n = layout_face_size(cells, width, height);
    const auto channels = static_cast<int>(image.shape(2));
    const std::size_t texel = static_cast<std::size_t>(channels) * dtype_size(image.dtype());
    const Convention given = openexr ? Convention::inside : convention;

    const Unlocked unlocked;
    PixelBuffer faces = picture_to_faces(image.data(), width, height, texel, cells, given);
    if (given != Convention::gl)
        faces = convert_faces(faces.data(), n, texel, given, Convention::gl);
    if (openexr) {
        const CubeMap bordered(n, channels, image.dtype(), std::move(faces));
        faces = resample_faces(*bordered.data(), Sampling::borders, n, Sampling::centers, to);
    } else if (to != image.dtype()) {
        faces = convert_pixels(faces, image.dtype(), to);
    }
    return std::make_shared<CubeMap>(n, channels, to, std::move(faces), mipmaps, OutputList(),
                                     encoding);
}

PixelsOrOutput to_convention(const CubeMap& cube, const ConventionName& name,
                             const Text& output_name) {
    const Convention convention = parse_convention(name);
    const auto state = cube.data();
    PixelBuffer faces;
    if (const OutputValues* output = to_output(cube, output_name)) {
        {
            const Unlocked unlocked;
            faces = convert_faces(output->values->data(), state->size, output->texel_size(),
                                  Convention::gl, convention);
        }
        return output_array(std::move(faces), *output, {6, state->size, state->size});
    }
    {
        const Unlocked unlocked;
        const std::size_t texel =
            static_cast<std::size_t>(state->channels) * dtype_size(state->dtype);
        faces =
            convert_faces(state->pixels->data(), state->size, texel, Convention::gl, convention);
    }
    return owned_pixels(std::move(faces), state->dtype, face_shape(state->size, state->channels));
}

py::array output_in_layout(const CubeMap& cube, const OutputValues& output, Layout layout,
                           Convention convention) {
    const int n = cube.data()->size;
    const PictureSize shape = layout_size(layout, n);
    PixelBuffer picture;
    {
        const Unlocked unlocked;
        const std::size_t texel = output.texel_size();
        const PixelBuffer faces =
            convert_faces(output.values->data(), n, texel, Convention::gl, convention);
        picture = faces_to_picture(faces.data(), n, texel, layout, convention);
    }
    return output_array(std::move(picture), output, {shape.height, shape.width});
}

PixelsOrOutput to_layout(const CubeMap& cube, const LayoutName& layout_name,
                         const ConventionName& convention_name, const DTypeOrNone& dtype,
                         const Text& output_name) {
    const Layout layout = parse_layout(layout_name);
    const Convention convention = parse_convention(convention_name);
    if (layout == Layout::equirect) {
        return to_equirect(cube, std::nullopt, "-z", "centers", dtype, output_name);
    }
    const auto state = cube.data();
    const bool openexr = layout == Layout::openexr;
    if (const OutputValues* output = to_output(cube, output_name)) {
        check_no_dtype(dtype, *output);
        // Of as many samples on the borders, each lies in the texel of its own row and column.
        return output_in_layout(cube, *output, openexr ? Layout::column : layout,
                                openexr ? Convention::inside : convention);
    }
    const DType to = to_dtype(dtype, state->dtype);
    const PictureSize shape = layout_size(openexr ? Layout::column : layout, state->size);
    PixelBuffer picture;
    {
        const Unlocked unlocked;
        const auto channels = static_cast<std::size_t>(state->channels);
        if (openexr) {
            const PixelBuffer faces =
                resample_faces(*state, Sampling::centers, state->size, Sampling::borders, to);
            picture = convert_faces(faces.data(), state->size, channels * dtype_size(to),
                                    Convention::gl, Convention::inside);
        } else {
            const std::size_t texel = channels * dtype_size(state->dtype);
            const PixelBuffer faces = convert_faces(state->pixels->data(), state->size, texel,
                                                    Convention::gl, convention);
            picture = faces_to_picture(faces.data(), state->size, texel, layout, convention);
            if (to != state->dtype) picture = convert_pixels(picture, state->dtype, to);
        }
    }
    return owned_pixels(std::move(picture), to, {shape.height, shape.width, state->channels});
}

CubePtr resize(const CubeMap& cube, Int size, const DTypeOrNone& dtype) {
    to_texels(size, "size");
    const auto state = cube.data();
    const DType to = to_dtype(dtype, state->dtype);
    check_picture(size, 6.0 * size, state->channels, to);
    const Unlocked unlocked;
    PixelBuffer faces = resample_faces(*state, Sampling::centers, size, Sampling::centers, to);
    OutputList outputs = cube.outputs();
    for (OutputValues& output : outputs) {
        output.values = std::make_shared<PixelBuffer>(nearest_faces(texels_of(cube, output), size));
    }
    return std::make_shared<CubeMap>(size, state->channels, to, std::move(faces), state->mipmaps,
                                     std::move(outputs), state->encoding);
}

}  // namespace

void bind_cubemap_pictures(Class<CubeMap>& cube) {
    // Two signatures of each, so that type checkers know the dtype of colours.
    cube.def(
            "to_equirect",
            [](const CubeMap& c, Argument<std::optional<int>> width, const CenterName& center,
               const SamplingName& sampling, const DTypeOrNone& dtype) -> Pixels {
                return to_equirect(c, width, center, sampling, dtype, "color");
            },
            py::kw_only(), py::arg("width") = py::none(), py::arg("center") = "-z",
            py::arg("sampling") = "centers", py::arg("dtype") = py::none(), docs::to_equirect)
        .def("to_equirect", &to_equirect, py::kw_only(), py::arg("width") = py::none(),
             py::arg("center") = "-z", py::arg("sampling") = "centers",
             py::arg("dtype") = py::none(), py::arg("output") = "color", docs::to_equirect_output)
        .def_static(
            "from_equirect",
            [](const ArrayLike& image, Argument<std::optional<int>> size, const CenterName& center,
               const SamplingName& sampling, Flag mipmaps, const DTypeOrNone& dtype,
               const EncodingName& encoding) {
                // The filter finds a NaN.
                const PixelArray pixels = pixel_array(image, "image", "(H, W, C)", Values::any);
                return from_equirect(pixels, size, parse_center(center), mipmaps,
                                     parse_sampling(sampling), to_dtype(dtype, pixels.dtype()),
                                     to_encoding(encoding, image, pixels.dtype()));
            },
            py::arg("image"), py::kw_only(), py::arg("size") = py::none(), py::arg("center") = "-z",
            py::arg("sampling") = "centers", py::arg("mipmaps") = false,
            py::arg("dtype") = py::none(), py::arg("encoding") = py::none(), docs::from_equirect)
        .def(
            "to_convention",
            [](const CubeMap& c, const ConventionName& convention) -> Pixels {
                return to_convention(c, convention, "color");
            },
            py::arg("convention"), docs::to_convention)
        .def("to_convention", &to_convention, py::arg("convention"), py::kw_only(),
             py::arg("output") = "color", docs::to_convention_output)
        .def(
            "to_layout",
            [](const CubeMap& c, const LayoutName& layout, const ConventionName& convention,
               const DTypeOrNone& dtype) -> Pixels {
                return to_layout(c, layout, convention, dtype, "color");
            },
            py::arg("layout") = "cross", py::kw_only(), py::arg("convention") = "gl",
            py::arg("dtype") = py::none(), docs::to_layout)
        .def("to_layout", &to_layout, py::arg("layout") = "cross", py::kw_only(),
             py::arg("convention") = "gl", py::arg("dtype") = py::none(),
             py::arg("output") = "color", docs::to_layout_output)
        .def_static("from_layout", &from_layout, py::arg("image"), py::kw_only(),
                    py::arg("layout") = py::none(), py::arg("convention") = "gl",
                    py::arg("size") = py::none(), py::arg("center") = "-z",
                    py::arg("mipmaps") = false, py::arg("dtype") = py::none(),
                    py::arg("encoding") = py::none(), docs::from_layout)
        .def("resize", &resize, py::arg("size"), py::kw_only(), py::arg("dtype") = py::none(),
             docs::resize);
}

}  // namespace cubecam::bindings
