/// Arrays of numpy: checks and conversions from Python, and views and arrays for Python.
///
/// Shapes are written as in the documentation: "(V, 3)", "(6, N, N, C)", "(..., 3)". A number is a
/// length. A letter stands for any length of at least 0, the same length wherever the letter
/// stands.
/// "..." at the front stands for any number of axes. Messages quote shapes: "positions: expected
/// shape (V, 3), got (3, 7)".
///
/// Real numbers of any width, integers included, are converted, from arrays, lists and tuples.
/// bool, complex, object, str and dates raise TypeError; wrong shapes and values raise ValueError.
/// A masked array raises TypeError if its mask hides a value, since the number behind the mask
/// means nothing.
#pragma once

#include "objects.hpp"

#include "cubecam/image/output_values.hpp"
#include "cubecam/image/pixels.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cubecam {

namespace py = pybind11;

enum class Values {
    finite,   ///< NaN and inf raise ValueError, which names the first bad index
    not_nan,  ///< NaN raises ValueError; inf is kept, since HDR pixels may hold it
    any,      ///< NaN and inf are kept
};

template <typename T>
using ContiguousArray = py::array_t<T, py::array::c_style>;

/// Reports whether an object has an attribute. An attribute that raises is not there, as for
/// `getattr` with a default, but for what ends a program, such as KeyboardInterrupt; Python 3.13
/// would print what `py::hasattr` meets.
bool has_attribute(py::handle object, const char* name);

/// Whether an array is of a type that can hide values, and hides some. Such a type has a mask and
/// the method filled(): numpy.ma.MaskedArray and its subclasses, and the masked arrays of astropy.
/// The attributes are enough to know them, so numpy.ma is not imported.
bool hides_values(py::handle value);

/// The value as an array of numpy, which makes one of lists and tuples. All arguments that take an
/// array are read by this function. Raises TypeError for a masked array that hides values, also in
/// lists and tuples, and ValueError for rows of unequal length.
py::array to_array(py::handle value, const char* name);

/// "(3, 7)".
std::string shape_text(const py::array& array);

/// Raises ValueError unless the array's shape matches the pattern.
void check_shape(const py::array& array, const char* name, std::string_view shape);

/// A C-contiguous array of float or double. If the value is such an array already, the result
/// shares its memory with the caller; so copy it (to_vector) if it must not change after the GIL is
/// released. Finite numbers that float32 cannot hold raise ValueError.
ContiguousArray<float> float_array(py::handle value, const char* name, std::string_view shape,
                                   Values values = Values::finite);
ContiguousArray<double> double_array(py::handle value, const char* name, std::string_view shape,
                                     Values values = Values::finite);

/// Integers from 0 to 2^32 - 1. Floats raise TypeError; numbers outside this range, or not below
/// `limit`, raise IndexError.
ContiguousArray<std::uint32_t> index_array(py::handle value, const char* name,
                                           std::string_view shape,
                                           std::uint64_t limit = std::uint64_t{1} << 32);

/// Pixels, C-contiguous, as uint8, float16 or float32 (float64 becomes float32). Other integers
/// raise TypeError, since only uint8 has a scale (value/255). NaN raises ValueError; +inf and -inf
/// are kept, since HDR photographs hold them where half floats overflowed.
class PixelArray {
public:
    PixelArray(py::array array, DType dtype)
        : array_(std::move(array)), dtype_(dtype),
          data_(static_cast<const std::byte*>(array_.data())),
          bytes_(static_cast<std::size_t>(array_.nbytes())) {}

    const py::array& array() const { return array_; }
    py::ssize_t shape(py::ssize_t axis) const { return array_.shape(axis); }

    // These work without the GIL, unlike the functions of py::array.
    DType dtype() const { return dtype_; }
    const std::byte* data() const { return data_; }
    std::size_t bytes() const { return bytes_; }

private:
    py::array array_;
    DType dtype_;
    const std::byte* data_;
    std::size_t bytes_;
};

/// Numbers of channels: those of a cubemap (1, 3 or 4), or 1 to 4.
enum class Channels { of_cubemap, up_to_four };

/// Pixels of a shape whose last axis is that of the channels.
PixelArray pixel_array(py::handle value, const char* name, std::string_view shape,
                       Values values = Values::not_nan, Channels channels = Channels::of_cubemap);

/// Raises ValueError for a NaN at a place that was found.
[[noreturn]] void refuse_nan(const PixelArray& pixels, const char* name, std::size_t index);

/// Raises ValueError that names the first NaN. The search runs on all cores, since pictures are
/// large.
void check_not_nan(const PixelArray& pixels, const char* name);

template <typename T>
std::vector<T> to_vector(const ContiguousArray<T>& array) {
    return std::vector<T>(array.data(), array.data() + array.size());
}

/// Three or four finite numbers, a (4, 4) matrix in reading order; from lists, tuples or arrays.
glm::dvec3 to_vec3(py::handle value, const char* name);
glm::dvec4 to_vec4(py::handle value, const char* name);
glm::dmat4 to_mat4(py::handle value, const char* name);
/// Three or four numbers; the fourth is 1 where it is not given.
glm::dvec4 to_color(py::handle value, const char* name);

/// A read-only view of memory that `owner` keeps alive as long as the array or a slice of it
/// exists.
py::array readonly_view(py::dtype dtype, std::vector<py::ssize_t> shape, const void* data,
                        std::shared_ptr<const void> owner);
/// The numpy type of pixels, and of an output's values.
py::dtype numpy_dtype(DType dtype);
py::dtype numpy_dtype(OutputType type);
namespace bindings {

/// Calls a function with an object of the type that signatures show for an output's array.
template <class Function>
void with_array_type(OutputType type, Function function) {
    switch (type) {
        case OutputType::float32: return function(OneOf<py::array_t<float>>());
        case OutputType::int32: return function(OneOf<py::array_t<std::int32_t>>());
        case OutputType::uint8: return function(OneOf<py::array_t<std::uint8_t>>());
    }
}

}  // namespace bindings

/// uint8, float16 or float32 from any form that numpy reads as a dtype; None gives `otherwise`.
DType to_dtype(py::handle value, DType otherwise);

template <typename T, typename Allocator>
py::array readonly_view(std::shared_ptr<const std::vector<T, Allocator>> values,
                        std::vector<py::ssize_t> shape) {
    const void* data = values->data();
    return readonly_view(py::dtype::of<T>(), std::move(shape), data, std::move(values));
}

/// A writable array that takes over a vector's memory, without a copy.
template <typename T, typename Allocator>
py::array owned_array(std::vector<T, Allocator> values, std::vector<py::ssize_t> shape) {
    auto* kept = new std::vector<T, Allocator>(std::move(values));
    py::capsule owner(kept, [](void* at) { delete static_cast<std::vector<T, Allocator>*>(at); });
    return py::array(py::dtype::of<T>(), std::move(shape), kept->data(), owner);
}
/// A writable array that takes over the memory of raw pixels of a dtype.
py::array owned_pixels(PixelBuffer pixels, DType dtype, std::vector<py::ssize_t> shape);
/// A writable array that takes over pixels which no one else holds.
py::array owned_pixels(std::shared_ptr<PixelBuffer> pixels, py::dtype dtype,
                       std::vector<py::ssize_t> shape);

/// Read-only copies, so that `node.position[1] = 3` raises an error instead of changing only a
/// copy.
py::array readonly_array(const glm::dvec3& value);
py::array readonly_array(const glm::dvec4& value);
py::array readonly_array(const glm::dmat4& value);

}  // namespace cubecam
