// cubecam.CubeMap and cubecam.Face.
#include "arrays.hpp"
#include "cubemap_arguments.hpp"
#include "docs/cubemap.hpp"
#include "encodings.hpp"
#include "objects.hpp"
#include "unlocked.hpp"
#include "values.hpp"

#include "cubecam/core/parallel.hpp"
#include "cubecam/core/parse_name.hpp"
#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/cubemap/cubemap_layout.hpp"
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

/// A copy of pixels, made on all cores, since the copy is most of the work of a constructor.
PixelBuffer copy_pixels(const std::byte* from, std::size_t bytes) {
    PixelBuffer to(bytes);
    parallel_for(0, bytes, std::size_t{1} << 20, [&](std::size_t begin, std::size_t end) {
        std::memcpy(to.data() + begin, from + begin, end - begin);
    });
    return to;
}

using FaceLike = OneOf<Face, WholeNumber, Choice<face_words>>;

Face to_face(py::handle value) {
    if (py::isinstance<py::str>(value)) return parse_face(value.cast<std::string>());
    const auto index = whole_number(value);
    if (!index) {
        throw py::type_error("face: expected a Face, a number from 0 to 5 or a name, got " +
                             text_of(value));
    }
    if (*index < 0 || *index >= face_count) {
        throw py::index_error("face: expected 0 to 5, got " + text_of(value));
    }
    return static_cast<Face>(*index);
}

/// Raises ValueError that names the face whose shape differs; numpy's own error names none.
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

CubePtr make_cube(const ArrayLike& faces, const ConventionName& convention_name, Flag mipmaps,
                  const EncodingName& encoding_name) {
    const Convention convention = parse_convention(convention_name);
    check_six_alike(faces);
    const PixelArray pixels = pixel_array(faces, "faces", "(6, N, N, C)");
    const int size = to_texels(pixels.shape(1), "faces");
    const auto channels = static_cast<int>(pixels.shape(3));
    const Encoding encoding = to_encoding(encoding_name, faces, pixels.dtype());
    const Unlocked unlocked;
    const std::size_t texel = static_cast<std::size_t>(channels) * dtype_size(pixels.dtype());
    PixelBuffer memory = convention == Convention::gl ? copy_pixels(pixels.data(), pixels.bytes())
                                                      : convert_faces(pixels.data(), size, texel,
                                                                      convention, Convention::gl);
    return std::make_shared<CubeMap>(size, channels, pixels.dtype(), std::move(memory), mipmaps,
                                     OutputList(), encoding);
}

void set_face(CubeMap& cube, const FaceLike& face_value, const ArrayLike& value,
              const ConventionName& convention_name) {
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
    const Unlocked unlocked;
    state.reset();  // the cube can write its pixels in place if no one else holds them
    // face_source is its own inverse: the face of "gl" that is made from `named` is also the face
    // of "gl" that `named` is made from.
    const FaceSource flips = face_source(Convention::gl, convention, named);
    PixelBuffer memory(bytes);
    copy_face(pixels.data(), size, texel, flips, memory.data());
    cube.set_face(flips.face, memory);
}

Pixels faces_view(const CubeMap& cube) {
    const auto state = cube.data();
    return readonly_view(numpy_dtype(state->dtype), face_shape(state->size, state->channels),
                         state->pixels->data(), state->pixels);
}

OutputArray sample(const CubeMap& cube, const ArrayLike& directions, const ArrayLike& lod,
                   const Text& output_name) {
    const OutputValues* output = to_output(cube, output_name);
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
    if (output != nullptr) {
        if (!only_zero) {
            throw py::value_error("lod: expected 0 for an output, which has one level, got others");
        }
        PixelBuffer found;
        {
            const Unlocked unlocked;
            found = nearest_lookup(texels_of(cube, *output), d, count);
        }
        return output_array(std::move(found), *output, std::move(shape));
    }
    if (!only_zero && !state->mipmaps) {
        throw py::value_error("lod: expected 0 for a cubemap without mipmaps, got other levels; "
                              "make it with mipmaps=True");
    }
    shape.push_back(state->channels);
    py::array_t<float> result(shape);
    float* to = result.mutable_data();
    const float* lods = only_zero ? nullptr : levels.data();
    const std::size_t lod_count = levels.ndim() == 0 ? 1 : count;
    {
        const Unlocked unlocked;
        cube.sample(d, count, lods, lod_count, to);
    }
    return result;
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

py::typing::Dict<py::str, OutputArray> outputs_of(const CubeMap& cube) {
    py::typing::Dict<py::str, OutputArray> outputs;
    for (const OutputValues& output : cube.outputs()) {
        outputs[py::str(output.name)] = output_view(cube, output);
    }
    return outputs;
}

/// Outputs from the dict that `outputs_of` made of a cube of this size. A name that is not in the
/// table is an output of a user's material: float32 with one to four channels.
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

/// A cube without filtered levels has a state of four parts, which older versions read, too.
py::tuple get_state(const CubeMap& cube) {
    const auto data = cube.data();
    py::tuple state = py::make_tuple(faces_view(cube), data->mipmaps, outputs_of(cube),
                                     to_string(data->encoding));
    if (data->levels) {
        py::list levels;
        for (const CubeLevel& level : *data->levels) {
            levels.append(py::make_tuple(level.roughness,
                                         readonly_view(numpy_dtype(data->dtype),
                                                       face_shape(level.size, data->channels),
                                                       level.pixels->data(), level.pixels)));
        }
        state = state + py::make_tuple(levels);
    }
    return closed_state(state);
}

std::shared_ptr<const CubeLevels> copy_levels(const py::sequence& states) {
    auto levels = std::make_shared<CubeLevels>();
    for (const py::handle each : states) {
        const auto [roughness, faces] = each.cast<std::pair<float, py::object>>();
        const PixelArray pixels = pixel_array(faces, "levels", "(6, N, N, C)", Values::any);
        levels->push_back(
            {to_texels(pixels.shape(1), "levels"), roughness,
             std::make_shared<PixelBuffer>(copy_pixels(pixels.data(), pixels.bytes()))});
    }
    return levels;
}

/// NaN is kept: a rendered cube may hold NaN, and unpickling must restore it.
CubePtr from_state(const py::tuple& closed) {
    const py::tuple state = opened_state(closed);
    // The first pickles of cubecam 0.2 have no encoding.
    if (state.size() < 3 || state.size() > 5) {
        throw py::value_error("CubeMap: expected a state of 4 or 5 parts, got " +
                              std::to_string(state.size()));
    }
    const PixelArray pixels = pixel_array(state[0], "faces", "(6, N, N, C)", Values::any);
    const int size = to_texels(pixels.shape(1), "faces");
    return std::make_shared<CubeMap>(
        size, static_cast<int>(pixels.shape(3)), pixels.dtype(),
        std::make_shared<PixelBuffer>(copy_pixels(pixels.data(), pixels.bytes())),
        state[1].cast<bool>(), copy_outputs(state[2].cast<py::dict>(), size),
        state.size() >= 4 ? parse_encoding(state[3].cast<std::string>()) : Encoding::linear,
        state.size() == 5 ? copy_levels(state[4].cast<py::sequence>()) : nullptr);
}

/// A copy of one capture of a batch. NaN is kept.
CubePtr cube_of_batch(const ArrayLike& faces, const py::dict& outputs,
                      const EncodingNow& encoding) {
    const PixelArray pixels = pixel_array(faces, "faces", "(6, N, N, C)", Values::any);
    const int size = to_texels(pixels.shape(1), "faces");
    return std::make_shared<CubeMap>(
        size, static_cast<int>(pixels.shape(3)), pixels.dtype(),
        std::make_shared<PixelBuffer>(copy_pixels(pixels.data(), pixels.bytes())), false,
        copy_outputs(outputs, size), parse_encoding(encoding));
}

std::string output_doc(const OutputRow& row) {
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

std::string outputs_text(const OutputList& outputs) {
    if (outputs.empty()) return "";
    py::list names;
    for (const OutputValues& output : outputs) names.append(output.name);
    return ", outputs=" + py::repr(py::tuple(names)).cast<std::string>();
}

std::string represent(const CubeMap& cube) {
    const auto state = cube.data();
    return "CubeMap(size=" + std::to_string(state->size) +
           ", channels=" + std::to_string(state->channels) + ", dtype=" + dtype_name(state->dtype) +
           ", mipmaps=" + (state->mipmaps ? "True" : "False") +
           (state->levels ? ", levels=" + std::to_string(state->levels->size() + 1) : "") +
           outputs_text(cube.outputs()) + ", encoding='" + std::string(to_string(state->encoding)) +
           "')";
}

}  // namespace

const OutputValues* to_output(const CubeMap& cube, const std::string& name) {
    if (name == "color") return nullptr;
    if (const OutputValues* output = find_output(cube.outputs(), name)) return output;
    std::string held = "\"color\"";
    for (const OutputValues& output : cube.outputs()) held += ", \"" + output.name + "\"";
    throw py::value_error(
        "output: expected " + held +
        (cube.outputs().empty()
             ? ", since this cube has no output besides; Renderer.capture has outputs="
             : ", which this cube has") +
        "; got '" + shortened(name) + "'");
}

py::array output_array(PixelBuffer texels, const OutputValues& output,
                       std::vector<py::ssize_t> shape) {
    if (output.channels > 1) shape.push_back(output.channels);
    return owned_pixels(std::make_shared<PixelBuffer>(std::move(texels)), numpy_dtype(output.type),
                        std::move(shape));
}

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
             py::arg("mipmaps") = false, py::arg("encoding") = py::none())
        .def_property_readonly("faces", &faces_view, docs::faces)
        .def_property_readonly(
            "size", [](const CubeMap& c) { return c.data()->size; },
            "int: N, texels along an edge of a face.")
        .def_property_readonly(
            "channels", [](const CubeMap& c) { return c.data()->channels; }, "int: C, 1, 3 or 4.")
        .def_property_readonly(
            "dtype", [](const CubeMap& c) -> PixelDType { return numpy_dtype(c.data()->dtype); },
            "numpy.dtype: uint8, float16 or float32.")
        .def_property_readonly(
            "mipmaps", [](const CubeMap& c) { return c.data()->mipmaps; },
            "bool: whether lookups are trilinear.")
        .def_property_readonly(
            "encoding",
            [](const CubeMap& c) -> EncodingNow { return to_string(c.data()->encoding); },
            "str: \"linear\" or \"srgb\", what the numbers of `faces` are.");
    for (const OutputRow& row : output_table) {
        with_array_type(row.type, [&](auto type) {
            cube.def_property_readonly(
                row.name.data(),
                [name = row.name](const CubeMap& c) -> decltype(type) {
                    return output_of(c, name);
                },
                output_doc(row).c_str());
        });
    }
    cube.def_property_readonly("outputs", &outputs_of, docs::outputs);

    cube.def("set_face", &set_face, py::arg("face"), py::arg("pixels"), py::kw_only(),
             py::arg("convention") = "gl", docs::set_face)
        // Two signatures, so that type checkers know the dtype of colours.
        .def(
            "sample",
            [](const CubeMap& c, const ArrayLike& directions, const ArrayLike& lod)
                -> py::array_t<float> { return sample(c, directions, lod, "color"); },
            py::arg("directions"), py::kw_only(), py::arg("lod") = 0.0, docs::sample)
        .def("sample", &sample, py::arg("directions"), py::kw_only(), py::arg("lod") = 0.0,
             py::arg("output") = "color", docs::sample_output);
    bind_cubemap_pictures(cube);
    bind_cubemap_projections(module, cube);

    const auto duplicate = [](const CubeMap& c) { return std::make_shared<CubeMap>(c); };
    cube.def("copy", duplicate, "An independent cubemap with the same contents.")
        .def("__copy__", duplicate)
        .def(
            "__deepcopy__",
            [duplicate](const CubeMap& c, const py::typing::Dict<py::int_, py::object>&) {
                return duplicate(c);
            },
            py::arg("memo"))
        .def(
            "__eq__",
            [](const CubeMap& a, const CubeMap& b) {
                const Unlocked unlocked;
                return a.same_contents(b);
            },
            py::is_operator(), py::arg("other"),
            "Whether the contents are the same bit for bit, captured outputs and filtered levels "
            "included.")
        .def(
            "__ne__",
            [](const CubeMap& a, const CubeMap& b) {
                const Unlocked unlocked;
                return !a.same_contents(b);
            },
            py::is_operator(), py::arg("other"))
        .def("__repr__", &represent)
        .def(py::pickle(&get_state, &from_state))
        .def("__reduce__", &reduce);
    module.def("_cube_of_batch", &cube_of_batch, py::arg("faces"), py::arg("outputs"),
               py::arg("encoding"), "A cubemap from a part of a batch.");
}
