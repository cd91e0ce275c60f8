#pragma once

#include "cubecam/gl/program.hpp"
#include "cubecam/materials/user_shader.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <cstddef>
#include <initializer_list>
#include <list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cubecam {

/// A program with a user's source in it, and what that source declares of uniforms.
class UserProgram {
public:
    /// `text` is all that the user wrote: an input that is declared nowhere but named there was
    /// optimised away, and is no mistake.
    UserProgram(gl::Program program, std::string text);

    const gl::Program& program() const { return program_; }

    /// Sets every uniform that the user declared, those without a value to what the source
    /// says, and binds the textures, which come in the order of `inputs.textures`.
    /// @throws std::invalid_argument for an input that the source does not know, of another shape
    /// or kind, or for a texture that it wants and does not get.
    void use(const ShaderInputs& inputs, std::span<const BoundTexture> textures);

private:
    struct Uniform {
        std::string name;  ///< an array's without [0]
        GLenum type;
        int count;  ///< of an array's elements in use
        bool array;
        GLint location;
        std::vector<double> initial;
        std::vector<double> current;
    };

    void find_uniforms();
    std::vector<double> initial_of(const Uniform& uniform) const;
    void check_known(const std::string& name) const;
    void set(Uniform& uniform, const std::vector<double>& numbers);

    gl::Program program_;
    std::string text_;
    std::vector<Uniform> uniforms_;  // samplers, too
};

/// A text and the file of shaders/ that it stands for. `title` is what messages call a user's text
/// that was read from no file; it is empty for a text that is not a user's.
struct ShaderPart {
    std::string_view file;
    std::string_view title;
    const UserSource* source;
};

/// The files of shaders/, those that parts stand for replaced by them.
std::vector<gl::ShaderSource> substituted(std::initializer_list<ShaderPart> parts);

/// The programs of users' sources, the least recently used given up: sources that are edited while
/// they are drawn leave many behind.
class UserPrograms {
public:
    UserProgram& get(const GladGLContext& gl, std::initializer_list<std::string_view> files,
                     const gl::ShaderOptions& options, std::initializer_list<ShaderPart> parts);

private:
    std::list<std::pair<std::string, UserProgram>> programs_;  // most recently used first
};

}  // namespace cubecam
