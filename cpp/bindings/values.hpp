/// Arguments that accept only what their type names: an int is no float and no bool, a bool is no
/// number, a text is no bytes. pybind11's own conversions are wider: they take 2.7 of numpy for 2,
/// nan and "False" for True, and True for 1.
#pragma once

#include "numbers.hpp"

#include <pybind11/pybind11.h>

#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

namespace cubecam::bindings {

/// An argument that becomes a T of C++: bool, a type of whole or real numbers, or std::string.
template <class T>
class Strict {
public:
    Strict() = default;
    template <std::convertible_to<T> U>
    Strict(U&& value) : value_(std::forward<U>(value)) {}

    operator const T&() const { return value_; }
    const T& operator*() const { return value_; }

private:
    T value_{};
};

using Flag = Strict<bool>;
using Int = Strict<int>;
using Real = Strict<double>;
using Text = Strict<std::string>;

template <class T>
struct StrictArgument {
    using Type = Strict<T>;
};

template <class T>
struct StrictArgument<std::optional<T>> {
    using Type = std::optional<Strict<T>>;
};

/// The argument for a field of a type, which may be a std::optional.
template <class T>
using Argument = typename StrictArgument<T>::Type;

/// The value of a field from its argument.
template <class T>
T value_of(const Strict<T>& given) {
    return *given;
}
template <class T>
std::optional<T> value_of(const std::optional<Strict<T>>& given) {
    if (!given) return std::nullopt;
    return **given;
}

/// The value if Python's object is one of the type, else none. A number that T cannot hold is none,
/// too; python/cubecam/_arguments.py says so in the message.
template <class T>
std::optional<T> read_strict(py::handle from) {
    if constexpr (std::same_as<T, bool>) {
        return truth_value(from);
    } else if constexpr (std::integral<T>) {
        const auto number = whole_number(from);
        if (!number || !std::in_range<T>(*number)) return std::nullopt;
        return static_cast<T>(*number);
    } else if constexpr (std::floating_point<T>) {
        const auto number = real_number(from);
        if (!number) return std::nullopt;
        return static_cast<T>(*number);
    } else {
        if (!from || PyUnicode_Check(from.ptr()) == 0) return std::nullopt;
        py::detail::make_caster<T> text;
        if (!text.load(from, false)) return std::nullopt;  // a text that is no Unicode
        return py::detail::cast_op<T&&>(std::move(text));
    }
}

}  // namespace cubecam::bindings

namespace pybind11::detail {

/// The type that signatures show.
template <class T>
constexpr auto strict_name() {
    if constexpr (std::same_as<T, bool>) {
        return const_name("bool");
    } else if constexpr (std::integral<T>) {
        return const_name("typing.SupportsIndex");
    } else if constexpr (std::floating_point<T>) {
        return const_name("typing.SupportsFloat | typing.SupportsIndex");
    } else {
        return const_name("str");
    }
}

template <class T>
struct type_caster<cubecam::bindings::Strict<T>> {
    using Value = cubecam::bindings::Strict<T>;
    PYBIND11_TYPE_CASTER(Value, strict_name<T>());

    bool load(handle from, bool) {
        auto read = cubecam::bindings::read_strict<T>(from);
        if (!read) return false;
        value = Value(std::move(*read));
        return true;
    }

    static handle cast(const Value& from, return_value_policy policy, handle parent) {
        return make_caster<T>::cast(*from, policy, parent);
    }
};

}  // namespace pybind11::detail
