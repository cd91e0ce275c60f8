#include "arrays.hpp"

#include "numbers.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/core/parallel.hpp"
#include "cubecam/core/parse_name.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

namespace cubecam {

namespace {

std::string dtype_text(const py::array& array) {
    return py::str(array.dtype()).cast<std::string>();
}

/// "(N, N)" to {"N", "N"}.
std::vector<std::string> split_shape(std::string_view pattern) {
    std::vector<std::string> axes;
    std::string axis;
    for (const char c : pattern) {
        if (c == ',' || c == ')') {
            if (!axis.empty()) axes.push_back(axis);
            axis.clear();
        } else if (c != '(' && c != ' ') {
            axis += c;
        }
    }
    return axes;
}

bool shape_matches(const py::array& array, std::string_view pattern) {
    std::vector<std::string> axes = split_shape(pattern);
    const auto ndim = static_cast<std::size_t>(array.ndim());
    std::size_t skipped = 0;
    if (!axes.empty() && axes.front() == "...") {
        axes.erase(axes.begin());
        if (ndim < axes.size()) return false;
        skipped = ndim - axes.size();
    }
    if (ndim - skipped != axes.size()) return false;
    std::map<std::string, py::ssize_t> letters;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const py::ssize_t length = array.shape(static_cast<py::ssize_t>(skipped + i));
        const std::string& axis = axes[i];
        const py::ssize_t expected = axis[0] >= '0' && axis[0] <= '9'
                                         ? std::stol(axis)
                                         : letters.try_emplace(axis, length).first->second;
        if (length != expected) return false;
    }
    return true;
}

/// Raises TypeError for an array that hides values; lists and tuples are searched as deep as numpy
/// reads them.
void check_nothing_hidden(py::handle value, const char* name, int depth = 64) {
    if (hides_values(value)) {
        throw py::type_error(std::string(name) +
                             ": expected an array without hidden values, got a masked array; fill "
                             "them with .filled(value)");
    }
    if (depth == 0) return;
    const bool list = PyList_Check(value.ptr()) != 0;
    if (!list && PyTuple_Check(value.ptr()) == 0) return;
    const auto length = [&] {
        return list ? PyList_GET_SIZE(value.ptr()) : PyTuple_GET_SIZE(value.ptr());
    };
    for (Py_ssize_t i = 0; i < length(); ++i) {
        PyObject* item = list ? PyList_GET_ITEM(value.ptr(), i) : PyTuple_GET_ITEM(value.ptr(), i);
        if (PyFloat_CheckExact(item) || PyLong_CheckExact(item)) continue;
        // The attributes of an array may run Python code, which may change the list.
        check_nothing_hidden(py::reinterpret_borrow<py::object>(item), name, depth - 1);
    }
}

/// The value as an array of real numbers. Raises TypeError for other types.
py::array real_array(py::handle value, const char* name) {
    const py::array array = to_array(value, name);
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u') {
        throw py::type_error(std::string(name) + ": expected real numbers, got dtype " +
                             dtype_text(array));
    }
    return array;
}

std::string index_text(const py::array& array, std::size_t flat) {
    std::string text;
    for (py::ssize_t axis = array.ndim(); axis-- > 0;) {
        const auto length = static_cast<std::size_t>(array.shape(axis));
        text = std::to_string(flat % length) + (text.empty() ? "" : ", ") + text;
        flat /= length;
    }
    return "[" + text + "]";
}

/// The index of the first value that `values` does not allow.
template <typename T>
std::optional<std::size_t> first_bad(const T* data, std::size_t count, Values values) {
    if (values == Values::any) return std::nullopt;
    const T limit = values == Values::finite ? std::numeric_limits<T>::max()
                                             : std::numeric_limits<T>::infinity();
    constexpr std::size_t block = 4096;  // a block has no branch, so that the compiler can use SIMD
    for (std::size_t begin = 0; begin < count; begin += block) {
        const std::size_t end = std::min(count, begin + block);
        bool good = true;
        for (std::size_t i = begin; i < end; ++i) good &= std::abs(data[i]) <= limit;
        if (good) continue;
        for (std::size_t i = begin; i < end; ++i) {
            if (!(std::abs(data[i]) <= limit)) return i;
        }
    }
    return std::nullopt;
}

template <typename T>
void check_values(const py::array_t<T, py::array::c_style>& array, const char* name,
                  Values values) {
    const auto bad = first_bad(array.data(), static_cast<std::size_t>(array.size()), values);
    if (!bad) return;
    const T value = array.data()[*bad];
    throw py::value_error(std::string(name) + ": expected " +
                          (values == Values::finite ? "finite numbers, got " : "no NaN, got ") +
                          (std::isnan(value) ? "nan"
                           : value > 0       ? "inf"
                                             : "-inf") +
                          " at " + index_text(array, *bad));
}

/// Raises ValueError for an array whose copy the memory cannot hold.
void check_copy(const py::array& array, std::size_t item, const char* name) {
    const double bytes = static_cast<double>(array.size()) * static_cast<double>(item);
    try {
        check_memory(bytes, "numbers of shape " + shape_text(array));
    } catch (const std::invalid_argument& error) {
        // The message begins with "size:", which is no argument here.
        const std::string_view text = error.what();
        throw py::value_error(name + std::string(text.substr(text.find(':'))));
    }
}

template <typename T>
ContiguousArray<T> contiguous(const py::array& array, const char* name) {
    // An array of strides 0 is larger than its memory.
    const bool same = py::isinstance<ContiguousArray<T>>(array);
    if (!same) check_copy(array, sizeof(T), name);
    auto result = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!result) throw std::bad_alloc();
    return py::reinterpret_steal<ContiguousArray<T>>(result.release());
}

/// Converts float64 to float32. A number that float32 cannot hold raises ValueError; numpy would
/// only warn.
ContiguousArray<float> narrow(const py::array& array, const char* name) {
    const ContiguousArray<double> from = contiguous<double>(array, name);
    ContiguousArray<float> to(std::vector<py::ssize_t>(from.shape(), from.shape() + from.ndim()));
    const double* source = from.data();
    float* target = to.mutable_data();
    const auto count = static_cast<std::size_t>(from.size());
    for (std::size_t i = 0; i < count; ++i) {
        target[i] = static_cast<float>(source[i]);
        if (std::isinf(target[i]) && !std::isinf(source[i])) {
            throw py::value_error(
                std::string(name) + ": expected numbers that float32 can hold, got " +
                py::repr(py::float_(source[i])).cast<std::string>() + " at " + index_text(to, i));
        }
    }
    return to;
}

ContiguousArray<float> to_float32(const py::array& array, const char* name) {
    const bool wide = array.dtype().kind() == 'f' && array.itemsize() > 4;
    return wide ? narrow(array, name) : contiguous<float>(array, name);
}

template <typename Vector>
py::array readonly_values(const Vector& value, std::vector<py::ssize_t> shape) {
    py::array_t<double> array(std::move(shape));
    for (py::ssize_t i = 0; i < array.size(); ++i) array.mutable_data()[i] = value(i);
    array.attr("flags").attr("writeable") = false;
    return array;
}

}  // namespace

bool has_attribute(py::handle object, const char* name) {
    const auto found =
        py::reinterpret_steal<py::object>(PyObject_GetAttrString(object.ptr(), name));
    if (found) return true;
    if (!PyErr_ExceptionMatches(PyExc_Exception)) throw py::error_already_set();
    PyErr_Clear();
    return false;
}

bool hides_values(py::handle value) {
    // Plain arrays, which most callers pass, have no mask.
    if (Py_TYPE(value.ptr()) == py::detail::npy_api::get().PyArray_Type_) return false;
    if (!py::isinstance<py::array>(value)) return false;
    if (!has_attribute(value, "mask") || !has_attribute(value, "filled")) return false;
    return py::bool_(py::module_::import("numpy").attr("any")(value.attr("mask")));
}

py::array to_array(py::handle value, const char* name) {
    check_nothing_hidden(value, name);
    if (py::isinstance<py::array>(value)) return py::reinterpret_borrow<py::array>(value);
    try {
        // Of an object that gives a masked array to numpy, asarray would return the hidden values.
        const py::object array = py::module_::import("numpy").attr("asanyarray")(value);
        check_nothing_hidden(array, name);
        return py::module_::import("numpy").attr("asarray")(array);
    } catch (py::error_already_set& error) {
        if (error.matches(PyExc_ValueError)) {
            throw py::value_error(std::string(name) +
                                  ": expected an array of numbers, got rows of unequal length");
        }
        // KeyboardInterrupt and MemoryError are nobody's mistake; the rest comes from the value.
        if (!error.matches(PyExc_Exception) || error.matches(PyExc_MemoryError)) throw;
        const std::string text =
            std::string(name) + ": expected an array of numbers, got " + text_of(value);
        py::raise_from(error, PyExc_TypeError, text.c_str());
        throw py::error_already_set();
    }
}

std::string shape_text(const py::array& array) {
    std::string text = "(";
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
        text += (axis ? ", " : "") + std::to_string(array.shape(axis));
    }
    return text + (array.ndim() == 1 ? ",)" : ")");
}

void check_shape(const py::array& array, const char* name, std::string_view shape) {
    if (shape_matches(array, shape)) return;
    throw py::value_error(std::string(name) + ": expected shape " + std::string(shape) + ", got " +
                          shape_text(array));
}

ContiguousArray<float> float_array(py::handle value, const char* name, std::string_view shape,
                                   Values values) {
    const py::array array = real_array(value, name);
    check_shape(array, name, shape);
    auto result = to_float32(array, name);
    check_values(result, name, values);
    return result;
}

ContiguousArray<double> double_array(py::handle value, const char* name, std::string_view shape,
                                     Values values) {
    const py::array array = real_array(value, name);
    check_shape(array, name, shape);
    auto result = contiguous<double>(array, name);
    check_values(result, name, values);
    return result;
}

ContiguousArray<std::uint32_t> index_array(py::handle value, const char* name,
                                           std::string_view shape, std::uint64_t limit) {
    const py::array array = real_array(value, name);
    const char kind = array.dtype().kind();
    // numpy gives an empty list the dtype float64; an empty array of indices is allowed all the
    // same.
    if (kind == 'f' && array.size() != 0) {
        throw py::type_error(std::string(name) + ": expected integers, got dtype " +
                             dtype_text(array));
    }
    check_shape(array, name, shape);
    limit = std::min(limit, std::uint64_t{1} << 32);

    const auto check = [&](const auto& wide) {
        ContiguousArray<std::uint32_t> result(
            std::vector<py::ssize_t>(wide.shape(), wide.shape() + wide.ndim()));
        std::uint32_t* target = result.mutable_data();
        const auto count = static_cast<std::size_t>(wide.size());
        for (std::size_t i = 0; i < count; ++i) {
            const auto index = wide.data()[i];
            // The cast turns a negative number into one far above every limit.
            if (static_cast<std::uint64_t>(index) >= limit) {
                throw py::index_error(std::string(name) + ": expected indices from 0 to " +
                                      std::to_string(limit) + " - 1, got " + std::to_string(index) +
                                      " at " + index_text(result, i));
            }
            target[i] = static_cast<std::uint32_t>(index);
        }
        return result;
    };
    return kind == 'u' ? check(contiguous<std::uint64_t>(array, name))
                       : check(contiguous<std::int64_t>(array, name));
}

py::dtype numpy_dtype(DType dtype) {
    return dtype == DType::uint8     ? py::dtype::of<std::uint8_t>()
           : dtype == DType::float16 ? py::dtype("float16")
                                     : py::dtype::of<float>();
}

py::dtype numpy_dtype(OutputType type) { return py::dtype(output_type_name(type)); }

DType to_dtype(py::handle value, DType otherwise) {
    if (value.is_none()) return otherwise;
    const std::string expected = "dtype: expected uint8, float16 or float32, got ";
    std::optional<py::dtype> given;
    try {
        given = py::dtype::from_args(py::reinterpret_borrow<py::object>(value));
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_Exception)) throw;
        py::raise_from(error, PyExc_TypeError, (expected + text_of(value)).c_str());
        throw py::error_already_set();
    }
    for (const DType dtype : {DType::uint8, DType::float16, DType::float32}) {
        if (given->equal(numpy_dtype(dtype))) return dtype;
    }
    throw py::value_error(expected + shortened(py::str(*given).cast<std::string>()));
}

PixelArray pixel_array(py::handle value, const char* name, std::string_view shape, Values values,
                       Channels counts) {
    const py::array array = real_array(value, name);
    const char kind = array.dtype().kind();
    if (kind != 'f' && !(kind == 'u' && array.itemsize() == 1)) {
        throw py::type_error(
            std::string(name) + ": expected pixels as uint8, float16, float32 or float64, got " +
            dtype_text(array) +
            (kind == 'u' && array.itemsize() == 2 ? "; divide by 65535 to get floats"
                                                  : "; only uint8 stands for value/255, convert "
                                                    "other integers to float32 with a scale"));
    }
    check_shape(array, name, shape);
    const py::ssize_t channels = array.ndim() > 0 ? array.shape(array.ndim() - 1) : 0;
    const bool two = counts == Channels::up_to_four;
    if (channels < 1 || channels > 4 || (channels == 2 && !two)) {
        throw py::value_error(std::string(name) + ": expected " + (two ? "1 to 4" : "1, 3 or 4") +
                              " channels on the last axis, got " + std::to_string(channels) +
                              " (shape " + shape_text(array) + ")");
    }

    const auto checked = [&]() -> PixelArray {
        if (kind == 'u') return {contiguous<std::uint8_t>(array, name), DType::uint8};
        if (array.itemsize() > 2) return {to_float32(array, name), DType::float32};
        return {py::module_::import("numpy").attr("ascontiguousarray")(array,
                                                                       numpy_dtype(DType::float16)),
                DType::float16};
    };
    PixelArray result = checked();
    if (values != Values::any) check_not_nan(result, name);
    return result;
}

void check_not_nan(const PixelArray& pixels, const char* name) {
    if (pixels.dtype() == DType::uint8) return;
    const std::size_t count = pixels.bytes() / dtype_size(pixels.dtype());
    std::atomic<std::size_t> first{count};
    const auto note = [&](std::size_t index) {
        std::size_t known = first.load();
        while (index < known && !first.compare_exchange_weak(known, index)) {
        }
    };
    parallel_for(0, count, std::size_t{1} << 19, [&](std::size_t begin, std::size_t end) {
        if (pixels.dtype() == DType::float32) {
            const auto* data = reinterpret_cast<const float*>(pixels.data());
            if (const auto bad = first_bad(data + begin, end - begin, Values::not_nan)) {
                note(begin + *bad);
            }
        } else {
            const auto* data = reinterpret_cast<const std::uint16_t*>(pixels.data());
            for (std::size_t i = begin; i < end; ++i) {
                if ((data[i] & 0x7fffu) > 0x7c00u) return note(i);
            }
        }
    });
    if (first < count) refuse_nan(pixels, name, first);
}

void refuse_nan(const PixelArray& pixels, const char* name, std::size_t index) {
    throw py::value_error(std::string(name) + ": expected no NaN, got nan at " +
                          index_text(pixels.array(), index));
}

glm::dvec3 to_vec3(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(3,)");
    const double* v = array.data();
    return {v[0], v[1], v[2]};
}

glm::dvec4 to_vec4(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(4,)");
    const double* v = array.data();
    return {v[0], v[1], v[2], v[3]};
}

glm::dmat4 to_mat4(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(4, 4)");
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i) matrix[i % 4][i / 4] = array.data()[i];  // GLM: [column][row]
    return matrix;
}

glm::dvec4 to_color(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(C,)");
    if (array.size() != 3 && array.size() != 4) {
        throw py::value_error(std::string(name) + ": expected 3 or 4 numbers, got " +
                              std::to_string(array.size()));
    }
    const double* v = array.data();
    return {v[0], v[1], v[2], array.size() == 4 ? v[3] : 1.0};
}

py::array readonly_view(py::dtype dtype, std::vector<py::ssize_t> shape, const void* data,
                        std::shared_ptr<const void> owner) {
    auto* kept = new std::shared_ptr<const void>(std::move(owner));
    const py::capsule base(kept,
                           [](void* at) { delete static_cast<std::shared_ptr<const void>*>(at); });
    py::array array(std::move(dtype), std::move(shape), data, base);
    array.attr("flags").attr("writeable") = false;
    return array;
}

py::array owned_pixels(PixelBuffer pixels, DType dtype, std::vector<py::ssize_t> shape) {
    return owned_pixels(std::make_shared<PixelBuffer>(std::move(pixels)), numpy_dtype(dtype),
                        std::move(shape));
}

py::array owned_pixels(std::shared_ptr<PixelBuffer> pixels, py::dtype dtype,
                       std::vector<py::ssize_t> shape) {
    void* data = pixels->data();
    auto* kept = new std::shared_ptr<PixelBuffer>(std::move(pixels));
    const py::capsule base(kept,
                           [](void* at) { delete static_cast<std::shared_ptr<PixelBuffer>*>(at); });
    return py::array(std::move(dtype), std::move(shape), data, base);
}

py::array readonly_array(const glm::dvec3& value) {
    return readonly_values([&](py::ssize_t i) { return value[static_cast<int>(i)]; }, {3});
}

py::array readonly_array(const glm::dvec4& value) {
    return readonly_values([&](py::ssize_t i) { return value[static_cast<int>(i)]; }, {4});
}

py::array readonly_array(const glm::dmat4& value) {
    return readonly_values(
        [&](py::ssize_t i) { return value[static_cast<int>(i % 4)][static_cast<int>(i / 4)]; },
        {4, 4});
}

}  // namespace cubecam
