#pragma once

#include "cubecam/image/output_values.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam {

/// The source of an output's values.
enum class OutputSource : std::uint8_t {
    shader,   ///< the variable `o_<name>` of surface.frag, which only opaque nodes write
    depth,    ///< the depth buffer after all drawing
    stencil,  ///< the stencil buffer after all drawing
};

/// A kind of output: everything that drawing, clearing, reading and the bindings need to know about
/// it.
struct OutputRow {
    std::string_view name;
    OutputSource source;
    int channels;
    OutputType type;
    float clear;  ///< the value where nothing was drawn
    std::string_view meaning;
};

/// All outputs besides colour. A new output needs a row here and, if its source is the shader, a
/// line in surface.frag.
inline constexpr std::array output_table = {
    OutputRow{"distance", OutputSource::shader, 1, OutputType::float32,
              std::numeric_limits<float>::infinity(),
              "length of the ray, world units; +inf background. In an orthographic picture it "
              "counts from the near plane"},
    OutputRow{"z", OutputSource::shader, 1, OutputType::float32,
              std::numeric_limits<float>::infinity(),
              "distance along the camera's axis, or a face's, world units; +inf background"},
    OutputRow{"normal", OutputSource::shader, 3, OutputType::float32, 0.0F,
              "world shading normal, unit length, towards the viewer; 0 background"},
    OutputRow{"position", OutputSource::shader, 3, OutputType::float32,
              std::numeric_limits<float>::quiet_NaN(), "world position; NaN background"},
    OutputRow{"id", OutputSource::shader, 1, OutputType::int32, 0.0F,
              "``Node.id`` of the visible node; 0 background"},
    OutputRow{"label", OutputSource::shader, 1, OutputType::int32, 0.0F,
              "``Node.label`` of the visible node; 0 background"},
    OutputRow{
        "depth", OutputSource::depth, 1, OutputType::float32, 1.0F,
        "OpenGL's window-space z with the precision of ``depth_format``, 0 at the near plane, 1 at "
        "the far plane and in the background"},
    OutputRow{"stencil", OutputSource::stencil, 1, OutputType::uint8, 0.0F,
              "the stencil buffer after all drawing; 0 background"},
};

/// The index of a row of the table.
consteval std::size_t output_row(std::string_view name) {
    std::size_t row = 0;
    while (output_table.at(row).name != name) ++row;
    return row;
}

/// An output that a user's own GLSL declares: `out vec3 heat;` has three channels. These outputs
/// are float32, and 0 where nothing wrote them.
struct NamedOutput {
    std::string name;
    int channels;

    auto operator<=>(const NamedOutput&) const = default;
};

/// An output that a fragment shader writes. `slot` is the number of its colour attachment and draw
/// buffer; colour itself has slot 0.
struct ShadedOutput {
    std::string_view name;
    std::size_t slot;
    int channels;
    OutputType type;
    float clear;
};

/// The set of outputs of a picture.
class Outputs {
public:
    void add(std::size_t row) { rows_ |= 1U << row; }
    /// Adds an output that a user's GLSL declares; adding it twice is allowed.
    void add(const NamedOutput& output);

    bool has(std::size_t row) const { return (rows_ >> row & 1U) != 0; }
    bool has(OutputSource source) const;
    /// Whether fragment shaders write any output of the set.
    bool shaded() const { return has(OutputSource::shader) || !named_.empty(); }
    /// Whether any output is read from the depth and stencil buffer.
    bool buffered() const { return has(OutputSource::depth) || has(OutputSource::stencil); }
    bool any() const { return rows_ != 0 || !named_.empty(); }

    const std::vector<NamedOutput>& named() const { return named_; }
    /// The outputs that fragment shaders write, in the order of their slots: 1, 2, ...
    std::vector<ShadedOutput> by_slot() const;
    /// The set without the outputs that are read from the depth and stencil buffer.
    Outputs without_buffered() const;

    auto operator<=>(const Outputs&) const = default;

private:
    std::uint32_t rows_ = 0;
    std::vector<NamedOutput> named_;  // by name
};

/// The GLSL type of an output: "float", "vec3", "int".
std::string_view glsl_type(int channels, OutputType type);

/// The names in a user's request: rows of the table, and other names, which a shader may declare.
struct RequestedOutputs {
    Outputs outputs;
    std::vector<std::string> others;  ///< in the order of the request

    bool any() const { return outputs.any() || !others.empty(); }
};
RequestedOutputs parse_outputs(const std::vector<std::string>& names);

/// Returns `"color", "distance", ...` for messages.
std::string known_outputs();

}  // namespace cubecam
