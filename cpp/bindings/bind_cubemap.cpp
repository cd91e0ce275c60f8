// cubecam.CubeMap and cubecam.Face.
#include "arrays.hpp"
#include "bind_cubemap_docs.hpp"
#include "objects.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/cubemap/cubemap_layout.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/render/resources/outputs.hpp"

#include <pybind11/native_enum.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

using CubePtr = std::shared_ptr<CubeMap>;
using DTypeOrNone = OneOf<DTypeLike, py::none>;

std::vector<py::ssize_t> face_shape(int size, int channels) { return {6, size, size, channels}; }

int to_size(py::ssize_t length, const char* name) {
    constexpr py::ssize_t limit = 1 << 20;  // no texture is larger, and products stay in range
    if (length < 1 || length > limit) {
        throw py::value_error(std::string(name) + ": expected 1 to " + std::to_string(limit) +
                              " texels, got " + std::to_string(length));
    }
    return static_cast<int>(length);
}

/// A copy made on all cores: most of the work of a constructor.
PixelBuffer copy_pixels(const std::byte* from, std::size_t bytes) {
    PixelBuffer to(bytes);
    parallel_for(0, bytes, std::size_t{1} << 20, [&](std::size_t begin, std::size_t end) {
        std::memcpy(to.data() + begin, from + begin, end - begin);
    });
    return to;
}

Sampling parse_sampling(const std::string& name) {
    if (name == "centers") return Sampling::centers;
    if (name == "borders") return Sampling::borders;
    throw py::value_error("sampling: expected 'centers' or 'borders', got '" + name + "'");
}

Face to_face(py::handle value) {
    if (py::isinstance<py::str>(value)) return parse_face(value.cast<std::string>());
    if (py::isinstance<py::bool_>(value) || !PyIndex_Check(value.ptr())) {
        throw py::type_error("face: expected a Face, a number from 0 to 5 or a name, got " +
                             py::repr(value).cast<std::string>());
    }
    const long index = py::int_(py::reinterpret_borrow<py::object>(value)).cast<long>();
    if (index < 0 || index >= face_count) {
        throw py::index_error("face: expected 0 to 5, got " + std::to_string(index));
    }
    return static_cast<Face>(index);
}

/// numpy would only say that rows differ; which of the six it is helps more.
void check_six_alike(py::handle value) {
    if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) return;
    const auto six = py::reinterpret_borrow<py::sequence>(value);
    if (six.size() != 6) {
        throw py::value_error("faces: expected 6, got " + std::to_string(six.size()));
    }
    std::optional<py::array> first;
    for (std::size_t i = 0; i < 6; ++i) {
        const py::object face = six[i];
        if (!py::isinstance<py::array>(face)) return;
        const auto array = py::reinterpret_borrow<py::array>(face);
        if (!first) first = array;
        if (shape_text(array) != shape_text(*first)) {
            throw py::value_error("faces: expected six of one shape (N, N, C), got " +
                                  shape_text(*first) + " and, for face " + face_names[i] + ", " +
                                  shape_text(array));
        }
    }
}

CubePtr make_cube(const py::object& faces, const std::string& convention_name, bool mipmaps) {
    const Convention convention = parse_convention(convention_name);
    check_six_alike(faces);
    const PixelArray pixels = pixel_array(faces, "faces", "(6, N, N, C)");
    const int size = to_size(pixels.shape(1), "faces");
    const auto channels = static_cast<int>(pixels.shape(3));
    const py::gil_scoped_release release;
    const std::size_t texel = static_cast<std::size_t>(channels) * dtype_size(pixels.dtype());
    PixelBuffer memory = convention == Convention::gl ? copy_pixels(pixels.data(), pixels.bytes())
                                                      : convert_faces(pixels.data(), size, texel,
                                                                      convention, Convention::gl);
    return std::make_shared<CubeMap>(size, channels, pixels.dtype(), std::move(memory), mipmaps);
}

void set_face(CubeMap& cube, const py::object& face_value, const py::object& value,
              const std::string& convention_name) {
    const Convention convention = parse_convention(convention_name);
    const Face named = to_face(face_value);
    std::shared_ptr<const CubeMapData> state = cube.data();
    const std::string n = std::to_string(state->size);
    const std::string shape = "(" + n + ", " + n + ", " + std::to_string(state->channels) + ")";
    const PixelArray pixels = pixel_array(value, "pixels", shape);
    if (pixels.dtype() != state->dtype) {
        throw py::type_error(std::string("pixels: expected ") + dtype_name(state->dtype) +
                             ", as the cube's, got " + dtype_name(pixels.dtype()));
    }
    const int size = state->size;
    const std::size_t texel = static_cast<std::size_t>(state->channels) * dtype_size(state->dtype);
    const std::size_t bytes = state->face_bytes();
    const py::gil_scoped_release release;
    state.reset();  // held by the cube alone, it can be written in place
    // face_source is its own inverse: what gl takes from `named` is what `named` is there.
    const FaceSource flips = face_source(Convention::gl, convention, named);
    PixelBuffer memory(bytes);
    copy_face(pixels.data(), size, texel, flips, memory.data());
    cube.set_face(flips.face, memory);
}

py::array faces_view(const CubeMap& cube) {
    const auto state = cube.data();
    return readonly_view(numpy_dtype(state->dtype), face_shape(state->size, state->channels),
                         state->pixels->data(), state->pixels);
}

py::array sample(const CubeMap& cube, const py::object& directions, const py::object& lod) {
    const auto towards = float_array(directions, "directions", "(..., 3)");
    const auto count = static_cast<std::size_t>(towards.size() / 3);
    const float* d = towards.data();
    for (std::size_t i = 0; i < count; ++i) {
        if (d[3 * i] == 0 && d[3 * i + 1] == 0 && d[3 * i + 2] == 0) {
            throw py::value_error(
                "directions: expected a length other than 0, got (0, 0, 0) as number " +
                std::to_string(i));
        }
    }
    const auto levels = float_array(lod, "lod", "(...)");
    std::vector<py::ssize_t> shape(towards.shape(), towards.shape() + towards.ndim() - 1);
    const bool same = levels.ndim() == towards.ndim() - 1 &&
                      std::equal(shape.begin(), shape.end(), levels.shape());
    if (levels.ndim() != 0 && !same) {
        throw py::value_error(
            "lod: expected one number or the shape of directions without its last axis, got " +
            shape_text(levels));
    }
    const auto state = cube.data();
    const bool only_zero = std::all_of(levels.data(), levels.data() + levels.size(),
                                       [](float level) { return level == 0; });
    if (!only_zero && !state->mipmaps) {
        throw py::value_error("lod: expected 0 for a cubemap without mipmaps, got other levels; "
                              "make it with mipmaps=True");
    }
    shape.push_back(state->channels);
    py::array_t<float> result(shape);
    float* to = result.mutable_data();
    const float* lods = only_zero ? nullptr : levels.data();
    const std::size_t lod_count = levels.ndim() == 0 ? 1 : count;
    const py::gil_scoped_release release;
    cube.sample(d, count, lods, lod_count, to);
    return result;
}

/// Refuses pictures that memory cannot hold.
void check_picture(double width, double height, int channels, DType dtype) {
    check_memory(static_cast<double>(dtype_size(dtype)) * width * height * channels,
                 std::to_string(static_cast<long long>(width)) + " x " +
                     std::to_string(static_cast<long long>(height)) + " pixels");
}

py::array to_equirect(const CubeMap& cube, std::optional<int> width, const std::string& center_name,
                      const std::string& sampling_name, const DTypeOrNone& dtype) {
    const Center center = parse_center(center_name);
    const Sampling sampling = parse_sampling(sampling_name);
    const auto state = cube.data();
    const DType to = to_dtype(dtype, state->dtype);
    const int columns = to_size(width.value_or(4 * state->size), "width");
    check_picture(columns, columns / 2.0, state->channels, to);
    PixelBuffer pixels;
    {
        const py::gil_scoped_release release;
        pixels = cube_to_equirect(*state, columns, center, sampling, to);
    }
    return owned_pixels(std::move(pixels), to, {columns / 2, columns, state->channels});
}

CubePtr from_equirect(const PixelArray& image, std::optional<int> size, Center center, bool mipmaps,
                      Sampling sampling, DType to) {
    const int height = to_size(image.shape(0), "image");
    const int width = to_size(image.shape(1), "image");
    const auto channels = static_cast<int>(image.shape(2));
    const int n = to_size(size.value_or(default_face_size(width)), "size");
    check_picture(n, 6.0 * n, channels, to);
    const py::gil_scoped_release release;
    PixelBuffer faces = equirect_to_cube(
        {image.data(), width, height, channels, image.dtype(), center, sampling}, n, to);
    return std::make_shared<CubeMap>(n, channels, to, std::move(faces), mipmaps);
}

CubePtr from_layout(const py::object& value, const std::optional<std::string>& layout_name,
                    const std::string& convention_name, std::optional<int> size,
                    const std::string& center_name, bool mipmaps, const DTypeOrNone& dtype) {
    const Convention convention = parse_convention(convention_name);
    const Center center = parse_center(center_name);
    const PixelArray image = pixel_array(value, "image", "(H, W, C)");
    const DType to = to_dtype(dtype, image.dtype());
    const int height = to_size(image.shape(0), "image");
    const int width = to_size(image.shape(1), "image");
    const Layout layout =
        layout_name ? parse_layout(*layout_name) : recognize_layout(width, height);
    if (layout == Layout::equirect) {
        return from_equirect(image, size, center, mipmaps, Sampling::centers, to);
    }
    if (size) throw py::value_error("size: expected with an equirect only; see CubeMap.resize");
    const bool openexr = layout == Layout::openexr;
    const Layout cells = openexr ? Layout::column : layout;
    const int n = layout_face_size(cells, width, height);
    const auto channels = static_cast<int>(image.shape(2));
    const std::size_t texel = static_cast<std::size_t>(channels) * dtype_size(image.dtype());
    const Convention given = openexr ? Convention::inside : convention;

    const py::gil_scoped_release release;
    PixelBuffer faces = picture_to_faces(image.data(), width, height, texel, cells, given);
    if (given != Convention::gl)
        faces = convert_faces(faces.data(), n, texel, given, Convention::gl);
    if (openexr) {
        const CubeMap bordered(n, channels, image.dtype(), std::move(faces));
        faces = resample_faces(*bordered.data(), Sampling::borders, n, Sampling::centers, to);
    } else if (to != image.dtype()) {
        faces = convert_pixels(faces, image.dtype(), to);
    }
    return std::make_shared<CubeMap>(n, channels, to, std::move(faces), mipmaps);
}

py::array to_convention(const CubeMap& cube, const std::string& name) {
    const Convention convention = parse_convention(name);
    const auto state = cube.data();
    PixelBuffer faces;
    {
        const py::gil_scoped_release release;
        const std::size_t texel =
            static_cast<std::size_t>(state->channels) * dtype_size(state->dtype);
        faces =
            convert_faces(state->pixels->data(), state->size, texel, Convention::gl, convention);
    }
    return owned_pixels(std::move(faces), state->dtype, face_shape(state->size, state->channels));
}

py::array to_layout(const CubeMap& cube, const std::string& layout_name,
                    const std::string& convention_name, const DTypeOrNone& dtype) {
    const Layout layout = parse_layout(layout_name);
    const Convention convention = parse_convention(convention_name);
    if (layout == Layout::equirect) return to_equirect(cube, std::nullopt, "-z", "centers", dtype);
    const auto state = cube.data();
    const bool openexr = layout == Layout::openexr;
    const DType to = to_dtype(dtype, state->dtype);
    const PictureSize shape = layout_size(openexr ? Layout::column : layout, state->size);
    PixelBuffer picture;
    {
        const py::gil_scoped_release release;
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

CubePtr resize(const CubeMap& cube, int size, const DTypeOrNone& dtype) {
    to_size(size, "size");
    const auto state = cube.data();
    const DType to = to_dtype(dtype, state->dtype);
    check_picture(size, 6.0 * size, state->channels, to);
    const py::gil_scoped_release release;
    PixelBuffer faces = resample_faces(*state, Sampling::centers, size, Sampling::centers, to);
    return std::make_shared<CubeMap>(size, state->channels, to, std::move(faces), state->mipmaps);
}

py::array output_view(const CubeMap& cube, const OutputValues& output) {
    const int n = cube.data()->size;
    std::vector<py::ssize_t> shape = {6, n, n};
    if (output.channels > 1) shape.push_back(output.channels);
    return readonly_view(numpy_dtype(output.type), std::move(shape), output.values->data(),
                         output.values);
}

py::object output_of(const CubeMap& cube, std::string_view name) {
    const OutputValues* output = find_output(cube.outputs(), name);
    return output == nullptr ? py::object(py::none()) : py::object(output_view(cube, *output));
}

py::typing::Dict<py::str, py::array> outputs_of(const CubeMap& cube) {
    py::typing::Dict<py::str, py::array> outputs;
    for (const OutputValues& output : cube.outputs()) {
        outputs[py::str(output.name)] = output_view(cube, output);
    }
    return outputs;
}

/// What outputs_of gave, of a cube of this size. Names that the table does not have are those of
/// users' materials, float32 with one to four channels.
OutputList copy_outputs(const py::dict& arrays, int size) {
    OutputList outputs;
    for (const auto& [key, value] : arrays) {
        OutputValues output;
        output.name = key.cast<std::string>();
        const auto* row = std::find_if(output_table.begin(), output_table.end(),
                                       [&](const OutputRow& r) { return r.name == output.name; });
        py::array array = value.cast<py::array>();
        output.channels =
            array.ndim() == 4 ? static_cast<int>(std::clamp<py::ssize_t>(array.shape(3), 1, 4)) : 1;
        if (row != output_table.end()) {
            output.channels = row->channels;
            output.type = row->type;
        }
        std::string shape = "(6";
        for (int i = 0; i < 2; ++i) shape += ", " + std::to_string(size);
        if (output.channels > 1) shape += ", " + std::to_string(output.channels);
        check_shape(array, output.name.c_str(), shape + ")");
        array =
            py::module_::import("numpy").attr("ascontiguousarray")(array, numpy_dtype(output.type));
        output.values = std::make_shared<PixelBuffer>(copy_pixels(
            static_cast<const std::byte*>(array.data()), static_cast<std::size_t>(array.nbytes())));
        outputs.push_back(std::move(output));
    }
    return outputs;
}

constexpr std::size_t cube_parts = 3;

py::tuple get_state(const CubeMap& cube) {
    return closed_state(py::make_tuple(faces_view(cube), cube.data()->mipmaps, outputs_of(cube)));
}

/// NaN is let through: what was rendered may hold it, and what was pickled must come back.
CubePtr from_state(const py::tuple& closed) {
    const py::tuple state = opened_state(closed);
    if (state.size() != cube_parts) {
        throw py::value_error("CubeMap: expected a state of " + std::to_string(cube_parts) +
                              " parts, got " + std::to_string(state.size()));
    }
    const PixelArray pixels = pixel_array(state[0], "faces", "(6, N, N, C)", Values::any);
    const int size = to_size(pixels.shape(1), "faces");
    return std::make_shared<CubeMap>(size, static_cast<int>(pixels.shape(3)), pixels.dtype(),
                                     copy_pixels(pixels.data(), pixels.bytes()),
                                     state[1].cast<bool>(),
                                     copy_outputs(state[2].cast<py::dict>(), size));
}

std::string captured_doc(const OutputRow& row) {
    return "ndarray (6, N, N" + (row.channels > 1 ? ", " + std::to_string(row.channels) : "") +
           ") " + output_type_name(row.type) +
           ", read-only, of a capture that requested it, or "
           "None: " +
           std::string(row.meaning) + ".";
}

py::tuple reduce(const py::object& self) {
    return py::make_tuple(py::module_::import("copyreg").attr("__newobj__"),
                          py::make_tuple(py::type::of(self)), get_state(self.cast<CubeMap&>()));
}

std::string represent(const CubeMap& cube) {
    const auto state = cube.data();
    return "CubeMap(size=" + std::to_string(state->size) +
           ", channels=" + std::to_string(state->channels) + ", dtype=" + dtype_name(state->dtype) +
           ", mipmaps=" + (state->mipmaps ? "True" : "False") + ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_cubemap(py::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;

    py::native_enum<Face>(module, "Face", "enum.IntEnum", docs::face)
        .value("POS_X", Face::pos_x)
        .value("NEG_X", Face::neg_x)
        .value("POS_Y", Face::pos_y)
        .value("NEG_Y", Face::neg_y)
        .value("POS_Z", Face::pos_z)
        .value("NEG_Z", Face::neg_z)
        .finalize();
    module.attr("Face").attr("__module__") = "cubecam";

    auto cube = bindings::declare<CubeMap>(module, "CubeMap", docs::cubemap);
    cube.def(py::init(&make_cube), py::arg("faces"), py::kw_only(), py::arg("convention") = "gl",
             py::arg("mipmaps") = false)
        .def_property_readonly("faces", &faces_view, docs::faces)
        .def_property_readonly(
            "size", [](const CubeMap& c) { return c.data()->size; },
            "N, texels along an edge, int.")
        .def_property_readonly(
            "channels", [](const CubeMap& c) { return c.data()->channels; }, "C: 1, 3 or 4, int.")
        .def_property_readonly(
            "dtype", [](const CubeMap& c) { return numpy_dtype(c.data()->dtype); },
            "numpy.dtype: uint8, float16 or float32.")
        .def_property_readonly(
            "mipmaps", [](const CubeMap& c) { return c.data()->mipmaps; },
            "Whether lookups are trilinear, bool.");
    for (const OutputRow& row : output_table) {
        cube.def_property_readonly(
            row.name.data(), [name = row.name](const CubeMap& c) { return output_of(c, name); },
            captured_doc(row).c_str());
    }
    cube.def_property_readonly("outputs", &outputs_of, docs::outputs);

    cube.def("set_face", &set_face, py::arg("face"), py::arg("pixels"), py::kw_only(),
             py::arg("convention") = "gl", docs::set_face)
        .def("sample", &sample, py::arg("directions"), py::kw_only(), py::arg("lod") = 0.0,
             docs::sample)
        .def("to_equirect", &to_equirect, py::kw_only(), py::arg("width") = py::none(),
             py::arg("center") = "-z", py::arg("sampling") = "centers",
             py::arg("dtype") = py::none(), docs::to_equirect)
        .def_static(
            "from_equirect",
            [](const py::object& image, std::optional<int> size, const std::string& center,
               const std::string& sampling, bool mipmaps, const DTypeOrNone& dtype) {
                const PixelArray pixels = pixel_array(image, "image", "(H, W, C)");
                return from_equirect(pixels, size, parse_center(center), mipmaps,
                                     parse_sampling(sampling), to_dtype(dtype, pixels.dtype()));
            },
            py::arg("image"), py::kw_only(), py::arg("size") = py::none(), py::arg("center") = "-z",
            py::arg("sampling") = "centers", py::arg("mipmaps") = false,
            py::arg("dtype") = py::none(), docs::from_equirect)
        .def("to_convention", &to_convention, py::arg("convention"), docs::to_convention)
        .def("to_layout", &to_layout, py::arg("layout") = "cross", py::kw_only(),
             py::arg("convention") = "gl", py::arg("dtype") = py::none(), docs::to_layout)
        .def_static("from_layout", &from_layout, py::arg("image"), py::kw_only(),
                    py::arg("layout") = py::none(), py::arg("convention") = "gl",
                    py::arg("size") = py::none(), py::arg("center") = "-z",
                    py::arg("mipmaps") = false, py::arg("dtype") = py::none(), docs::from_layout)
        .def("resize", &resize, py::arg("size"), py::kw_only(), py::arg("dtype") = py::none(),
             docs::resize);

    const auto duplicate = [](const CubeMap& c) { return std::make_shared<CubeMap>(c); };
    cube.def("copy", duplicate, "An independent cubemap with the same contents.")
        .def("__copy__", duplicate)
        .def(
            "__deepcopy__", [duplicate](const CubeMap& c, const py::dict&) { return duplicate(c); },
            py::arg("memo"))
        .def(
            "__eq__",
            [](const CubeMap& a, const CubeMap& b) {
                const py::gil_scoped_release release;
                return a.same_contents(b);
            },
            py::is_operator(), py::arg("other"),
            "Whether the contents are the same bit for bit, captured outputs included.")
        .def(
            "__ne__",
            [](const CubeMap& a, const CubeMap& b) {
                const py::gil_scoped_release release;
                return !a.same_contents(b);
            },
            py::is_operator(), py::arg("other"))
        .def("__repr__", &represent)
        .def(py::pickle(&get_state, &from_state))
        .def("__reduce__", &reduce);
}
