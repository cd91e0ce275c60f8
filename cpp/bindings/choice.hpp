/// Arguments and attributes whose value is one of a list of names, or one of a few numbers.
#pragma once

#include "values.hpp"

#include "cubecam/core/parse_name.hpp"

#include <pybind11/pybind11.h>

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace cubecam::bindings {

namespace py = pybind11;

/// A str of which signatures show the names in a table, as `typing.Literal["gl", "inside"]`. The
/// function that looks up the name raises the error for a name that is not in the table.
template <const auto& table>
class Choice {
public:
    Choice() = default;
    template <std::convertible_to<std::string_view> Text>
    Choice(Text name) : name_(std::string_view(name)) {}

    operator std::string_view() const { return name_; }

private:
    std::string name_;
};

/// An int of which signatures show the numbers in a table, as `typing.Literal[6, 14]`. What takes
/// the number raises the error for one that is not in the table.
template <const auto& table>
class NumberChoice {
public:
    NumberChoice() = default;
    NumberChoice(int number) : number_(number) {}

    operator int() const { return number_; }

private:
    int number_ = 0;
};

}  // namespace cubecam::bindings

namespace pybind11::detail {

/// Writes "typing.Literal[", the entries with commas between them, each by `entry(place)`, and "]".
template <class Write, class Entry>
constexpr void write_literal(Write write, std::size_t count, Entry entry) {
    const auto plain = [&](std::string_view text) {
        for (const char letter : text) write(letter);
    };
    plain("typing.Literal[");
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) plain(", ");
        entry(i);
    }
    plain("]");
}

/// The names of a table as pybind11 writes them in a signature, where '!' stands before the letters
/// that have a meaning of their own.
template <const auto& table>
struct LiteralNames {
    template <class Write>
    static constexpr void each_letter(Write write) {
        write_literal(write, table.size(), [&](std::size_t place) {
            write('"');
            for (const char letter : cubecam::name_of(table[place])) {
                if (std::string_view("!@%{}-").find(letter) != std::string_view::npos) write('!');
                write(letter);
            }
            write('"');
        });
    }
};

/// The same of a table of numbers, of which none is negative.
template <const auto& table>
struct LiteralNumbers {
    template <class Write>
    static constexpr void each_letter(Write write) {
        write_literal(write, table.size(), [&](std::size_t place) {
            int power = 1;
            while (table[place] / power >= 10) power *= 10;
            for (; power > 0; power /= 10) {
                write(static_cast<char>('0' + table[place] / power % 10));
            }
        });
    }
};

/// The type whose letters `Literal::each_letter` writes.
template <class Literal>
class LiteralText {
    static constexpr std::size_t count() {
        std::size_t letters = 0;
        Literal::each_letter([&letters](char) { ++letters; });
        return letters;
    }

    struct Letters {
        char text[count() + 1] = {};
    };

    static constexpr Letters letters() {
        Letters made;
        std::size_t at = 0;
        Literal::each_letter([&](char letter) { made.text[at++] = letter; });
        return made;
    }

public:
    static constexpr auto name = const_name(letters().text);
};

template <const auto& table>
struct type_caster<cubecam::bindings::Choice<table>> {
    using Value = cubecam::bindings::Choice<table>;
    PYBIND11_TYPE_CASTER(Value, LiteralText<LiteralNames<table>>::name);

    bool load(handle from, bool convert) {
        if (!from || PyUnicode_Check(from.ptr()) == 0) return false;  // bytes are no name
        make_caster<std::string> text;
        if (!text.load(from, convert)) return false;
        value = Value(std::string_view(cast_op<std::string&>(text)));
        return true;
    }

    static handle cast(const Value& from, return_value_policy policy, handle parent) {
        return make_caster<std::string_view>::cast(from, policy, parent);
    }
};

template <const auto& table>
struct type_caster<cubecam::bindings::NumberChoice<table>> {
    using Value = cubecam::bindings::NumberChoice<table>;
    PYBIND11_TYPE_CASTER(Value, LiteralText<LiteralNumbers<table>>::name);

    bool load(handle from, bool) {
        const auto read = cubecam::bindings::read_strict<int>(from);
        if (!read) return false;
        value = Value(*read);
        return true;
    }

    static handle cast(const Value& from, return_value_policy policy, handle parent) {
        return make_caster<int>::cast(static_cast<int>(from), policy, parent);
    }
};

}  // namespace pybind11::detail
