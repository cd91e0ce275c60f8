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

/// Where the values of an output come from.
enum class OutputSource : std::uint8_t {
    shader,   ///< the variable `o_<name>` of surface.frag, written by opaque nodes alone
    depth,    ///< what the depth buffer holds in the end
    stencil,  ///< what the stencil buffer holds in the end
};

/// One kind of output: everything that drawing, clearing, reading and the bindings know of it.
struct OutputRow {
    std::string_view name;
    OutputSource source;
    int channels;
    OutputType type;
    float clear;  ///< where nothing was drawn
    std::string_view meaning;
};

/// All outputs besides colour. A new one is a row here and, where its source is the shader, a line
/// of surface.frag.
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
              "``Node.id`` of what is seen; 0 background"},
    OutputRow{"depth", OutputSource::depth, 1, OutputType::float32, 1.0F,
              "OpenGL's window-space z, 0 at the near plane, 1 at the far plane and where nothing "
              "is, as fine as ``depth_format`` keeps it"},
    OutputRow{"stencil", OutputSource::stencil, 1, OutputType::uint8, 0.0F,
              "what the stencil buffer holds in the end; 0 background"},
};

/// An output that a user's own GLSL declares: `out vec3 heat;` has three channels. All are float32,
/// and 0 where nothing wrote them.
struct NamedOutput {
    std::string name;
    int channels;

    auto operator<=>(const NamedOutput&) const = default;
};

/// An output that a fragment shader writes, and the number of its colour attachment and draw
/// buffer; colour itself has number 0.
struct ShadedOutput {
    std::string_view name;
    std::size_t slot;
    int channels;
    OutputType type;
    float clear;
};

/// Which outputs a picture holds.
class Outputs {
public:
    void add(std::size_t row) { rows_ |= 1U << row; }
    /// One that a user's GLSL declares; adding it twice is no mistake.
    void add(const NamedOutput& output);

    bool has(std::size_t row) const { return (rows_ >> row & 1U) != 0; }
    bool has(OutputSource source) const;
    /// Whether fragment shaders write any.
    bool shaded() const { return has(OutputSource::shader) || !named_.empty(); }
    /// Whether any is read from the depth and stencil buffer.
    bool buffered() const { return has(OutputSource::depth) || has(OutputSource::stencil); }
    bool any() const { return rows_ != 0 || !named_.empty(); }

    const std::vector<NamedOutput>& named() const { return named_; }
    /// Those that fragment shaders write, in the order of their slots: 1, 2, ...
    std::vector<ShadedOutput> by_slot() const;
    /// The same set without those that are read from the depth and stencil buffer.
    Outputs without_buffered() const;

    auto operator<=>(const Outputs&) const = default;

private:
    std::uint32_t rows_ = 0;
    std::vector<NamedOutput> named_;  // by name
};

/// What the GLSL of an output is declared as: "float", "vec3", "int".
std::string_view glsl_type(int channels, OutputType type);

/// Names as a user gave them: rows of the table, and others, which a shader may declare.
struct RequestedOutputs {
    Outputs outputs;
    std::vector<std::string> others;  ///< in the order of the request

    bool any() const { return outputs.any() || !others.empty(); }
};
RequestedOutputs parse_outputs(const std::vector<std::string>& names);

/// `"color", "distance", ...` for messages.
std::string known_outputs();

}  // namespace cubecam
