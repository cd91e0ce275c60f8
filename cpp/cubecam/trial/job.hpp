#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The trial of a user's GLSL in a process of its own: docs/adr/0023.
namespace cubecam::trial {

inline constexpr std::size_t most_outputs = 8;
inline constexpr std::size_t most_attributes = 16;

/// A vertex attribute: what a driver needs to know to fetch it.
struct Attribute {
    std::uint32_t components = 0;  ///< 0: the attribute is no array
    std::uint32_t type = 0;
    std::uint32_t integer = 0;
    std::uint32_t divisor = 0;
    std::uint32_t binding = 0;
    std::uint32_t offset = 0;
    std::uint32_t stride = 0;
};

/// The state of OpenGL on which the machine code of a draw call depends. All numbers are those of
/// OpenGL. The struct has no padding, so that its bytes can be compared and sent.
struct State {
    std::array<std::uint32_t, most_outputs> color_formats{};  ///< of draw buffers; 0: none
    std::array<std::uint32_t, most_outputs> color_masks{};    ///< bits 0 to 3: red to alpha
    std::uint32_t depth_format = 0;
    std::uint32_t samples = 0;
    std::uint32_t target = 0;   ///< the kind of texture that is drawn into
    std::uint32_t layered = 0;  ///< whether a draw call reaches all layers
    std::uint32_t blend = 0;
    std::uint32_t blend_source = 0;
    std::uint32_t blend_target = 0;
    std::uint32_t blend_source_alpha = 0;
    std::uint32_t blend_target_alpha = 0;
    std::uint32_t blend_equation = 0;
    std::uint32_t blend_equation_alpha = 0;
    std::uint32_t depth_test = 0;
    std::uint32_t depth_func = 0;
    std::uint32_t depth_mask = 0;
    std::uint32_t stencil_test = 0;
    std::uint32_t stencil_func = 0;
    std::uint32_t stencil_reference = 0;
    std::uint32_t stencil_read_mask = 0;
    std::uint32_t stencil_write_mask = 0;
    std::uint32_t stencil_fail = 0;
    std::uint32_t stencil_depth_fail = 0;
    std::uint32_t stencil_depth_pass = 0;
    std::uint32_t clip_distance = 0;  ///< whether GL_CLIP_DISTANCE0 is enabled
    std::array<Attribute, most_attributes> attributes{};
};

/// A texture that the program looks up, as far as machine code depends on it.
struct Texture {
    std::uint32_t unit = 0;
    std::uint32_t target = 0;
    std::uint32_t format = 0;
    std::uint32_t min_filter = 0;
    std::uint32_t mag_filter = 0;
    std::array<std::uint32_t, 3> wrap{};
    std::array<std::uint32_t, 4> swizzle{};
    std::uint32_t compare = 0;
    std::uint32_t levels = 0;  ///< 1, or 2 for any larger number
    std::uint32_t sides = 0;   ///< bits 0, 1: width and height are no powers of two
};

/// The unit of a sampler that the user declared.
struct Sampler {
    std::string name;
    std::uint32_t unit = 0;
};

struct Stage {
    std::uint32_t type = 0;  ///< GL_VERTEX_SHADER, ...
    std::string text;        ///< with all includes
};

/// One program in one state.
struct Job {
    std::vector<Stage> stages;
    State state;
    std::vector<Texture> textures;
    std::vector<Sampler> samplers;
};

/// The bytes of a job: equal jobs have equal bytes.
std::string encode(const Job& job);
/// @throws std::invalid_argument for bytes that encode() did not make.
Job decode(std::string_view bytes);

}  // namespace cubecam::trial
