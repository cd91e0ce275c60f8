/// Names that arguments may have as their value. A table of names is a constexpr array of names in
/// the order of an enum, or of pairs (name, value). The bindings show every table as a
/// `typing.Literal` (cpp/bindings/choice.hpp), so that a name is written in one place.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace cubecam {

template <class Value, std::size_t N>
using NameTable = std::array<std::pair<std::string_view, Value>, N>;

constexpr std::string_view name_of(std::string_view entry) { return entry; }

template <class Value>
constexpr std::string_view name_of(const std::pair<std::string_view, Value>& entry) {
    return entry.first;
}

/// A text in a message: its beginning, if it is long, cut where a letter of UTF-8 begins.
inline std::string shortened(std::string_view text) {
    constexpr std::size_t most = 60;
    if (text.size() <= most) return std::string(text);
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
    return std::string(text.substr(0, end)) + "...";
}

/// Returns "'a', 'b' or 'c'".
template <class Table>
std::string quoted_names(const Table& table) {
    std::string text;
    for (std::size_t i = 0; i < table.size(); ++i) {
        text += i == 0 ? "'" : i + 1 == table.size() ? " or '" : ", '";
        text += std::string(name_of(table[i])) + "'";
    }
    return text;
}

/// Returns the place of a name in a table, the table's size if there is none.
template <class Table>
constexpr std::size_t place_of_name(const Table& table, std::string_view name) {
    std::size_t place = 0;
    while (place < table.size() && name_of(table[place]) != name) ++place;
    return place;
}

/// Returns the value that `name` stands for. `what` is the argument that has this name as its
/// value.
/// @throws std::invalid_argument that lists the known names.
template <class Value, std::size_t N>
Value parse_name(std::string_view what, std::string_view name, const NameTable<Value, N>& known) {
    std::string expected;
    for (const auto& [text, value] : known) {
        if (text == name) return value;
        expected += (expected.empty() ? "\"" : ", \"") + std::string(text) + "\"";
    }
    throw std::invalid_argument(std::string(what) + ": expected " + expected + ", got \"" +
                                shortened(name) + "\"");
}

}  // namespace cubecam
