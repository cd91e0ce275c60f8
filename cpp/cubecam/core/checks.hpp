#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

/// Words for messages, and the checks that use them: "expected ..., got ...".
namespace cubecam {

/// Returns the shortest decimal number that reads back as the same value: "0.2" for 0.2f.
template <class Real>
std::string describe(Real value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

inline std::string describe(const glm::dvec3& v) {
    return "(" + describe(v.x) + ", " + describe(v.y) + ", " + describe(v.z) + ")";
}

inline std::string describe(const glm::vec4& v) {
    return "(" + describe(v.x) + ", " + describe(v.y) + ", " + describe(v.z) + ", " +
           describe(v.w) + ")";
}

/// @throws std::invalid_argument "expected EXPECTED, got GOT" unless `condition` holds.
inline void expect(bool condition, std::string_view expected, std::string_view got) {
    if (condition) return;
    std::string text = "expected ";
    text.append(expected).append(", got ").append(got);
    throw std::invalid_argument(text);
}

/// Whether a float32, the type that the GPU gets, can hold the value. NaN and infinities do not
/// pass.
inline bool fits_float(double value) { return std::abs(value) <= 3.4e38; }

inline bool fits_float(const glm::dvec3& v) {
    return fits_float(v.x) && fits_float(v.y) && fits_float(v.z);
}

inline void expect_finite(double value, std::string_view name) {
    if (!fits_float(value))
        expect(false, std::string(name).append(" finite and within float32's range"),
               describe(value));
}

inline void expect_finite(const glm::dvec3& value, std::string_view name) {
    if (!fits_float(value)) {
        expect(false, std::string(name).append(" of 3 finite numbers within float32's range"),
               describe(value));
    }
}

inline void expect_not_negative(double value, std::string_view name) {
    if (!(value >= 0.0 && fits_float(value))) {
        expect(false, std::string(name).append(" finite and not negative"), describe(value));
    }
}

inline void expect_share(float value, std::string_view name) {
    if (!(value >= 0.0F && value <= 1.0F)) {
        expect(false, std::string(name).append(" from 0 to 1"), describe(value));
    }
}

inline void expect_positive(double value, std::string_view name) {
    if (!(value > 0.0 && fits_float(value))) {
        expect(false, std::string(name).append(" finite and above 0"), describe(value));
    }
}

/// A linear RGBA colour: red, green and blue are any finite numbers (an unlit colour may also store
/// a direction), alpha is from 0 to 1.
inline void expect_color(const glm::vec4& color, std::string_view name) {
    bool right = color.a >= 0.0F && color.a <= 1.0F;
    for (int i = 0; i < 3; ++i) right = right && std::isfinite(color[i]);
    if (!right) {
        expect(false, std::string(name).append(" finite, with an alpha from 0 to 1"),
               describe(color));
    }
}

}  // namespace cubecam
