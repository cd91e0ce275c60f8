#pragma once

#include "cubecam/core/error.hpp"
#include "cubecam/gl/embedded.hpp"
#include "cubecam/gl/handle.hpp"

#include <glm/fwd.hpp>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cubecam::gl {

/// Lines that are put before the source of each stage, after `#version 450 core`.
struct ShaderOptions {
    std::vector<std::string> extensions;  ///< `#extension <name> : require`
    std::vector<std::pair<std::string, std::string>>
        defines;  ///< `#define <name> <value>`, in this order
};

/// A stage's source with its includes resolved, and the origin of each of its lines. The lines are
/// numbered from the first to the last without `#line`: Mesa reports the string number 0 for every
/// expression, so that an error in an included file would name the wrong file.
struct ExpandedShader {
    /// Used as the number of the file for a line that was put before the source.
    static constexpr std::size_t ahead = static_cast<std::size_t>(-1);

    struct Line {
        std::size_t file;    ///< index into `files`, or `ahead`
        std::size_t number;  ///< from 1
        bool after = false;  ///< added behind the file's text; `number` is the last line
    };

    std::string text;
    std::vector<ShaderSource> files;
    std::vector<Line> lines;
};

/// The stage of a file by the ending of its name, see Program.
GLenum stage_of(std::string_view name);

/// Resolves `#include "x.glsl"` (each file once in a stage, with names as in `sources`) and puts
/// the lines of the options before the source. A `#version` line in a file is refused, since this
/// function writes it. Throws ShaderError for a missing file; it names the file and line of the
/// include.
ExpandedShader expand_shader(std::string_view name, const ShaderOptions& options,
                             std::span<const ShaderSource> sources);

/// Returns the driver's log with file names in place of string numbers, and with the numbered
/// source lines around each error.
std::string explain_shader_log(std::string_view log, const ExpandedShader& shader);

/// Returns the driver's log of linking with the lines of the users' own texts: those that the log
/// gives as numbers, and those of the names that it quotes.
std::string explain_link_log(std::string_view log, std::span<const ExpandedShader> shaders);

/// The names of the users' own texts in a program, or of its files: "fragment + vertex".
std::string shown_names(std::span<const ExpandedShader> shaders);

/// The error "<title> does not compile: <title>:<line>: <message>", with the lines round that one.
ShaderError source_error(const ShaderSource& source, std::size_t line, const std::string& message);

/// The line where a word of GLSL is declared, else where it first occurs outside of comments.
std::optional<std::size_t> line_of_word(std::string_view text, std::string_view word);

/// A linked program. Uniforms are set without binding it (glProgramUniform*).
class Program {
public:
    Program() noexcept = default;

    /// Compiles and links the named files. The ending of a name determines its stage: .vert .tesc
    /// .tese .geom .frag .comp. Throws ShaderError with the log and source lines.
    Program(const GladGLContext& gl, std::initializer_list<std::string_view> files,
            const ShaderOptions& options = {},
            std::span<const ShaderSource> sources = embedded_shaders());
    Program(const GladGLContext& gl, std::span<const std::string_view> files,
            const ShaderOptions& options = {},
            std::span<const ShaderSource> sources = embedded_shaders());

    GLuint id() const noexcept { return handle_.id(); }
    const GladGLContext& gl() const noexcept { return handle_.gl(); }
    explicit operator bool() const noexcept { return bool(handle_); }
    void use() const { handle_.gl().UseProgram(id()); }
    void abandon() noexcept { handle_.abandon(); }

    /// The location of a uniform, looked up once; -1 if the program does not have or does not use
    /// it.
    GLint location(std::string_view name) const;

    /// Setting a uniform that the program does not use does nothing, so one caller serves variants
    /// that are compiled with other defines.
    void set(std::string_view name, int value) const;
    void set(std::string_view name, unsigned value) const;
    void set(std::string_view name, float value) const;
    void set(std::string_view name, const glm::vec2& value) const;
    void set(std::string_view name, const glm::vec3& value) const;
    void set(std::string_view name, const glm::vec4& value) const;
    void set(std::string_view name, const glm::ivec2& value) const;
    void set(std::string_view name, const glm::mat3& value) const;
    void set(std::string_view name, const glm::mat4& value) const;

private:
    ProgramHandle handle_;
    mutable std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace cubecam::gl
