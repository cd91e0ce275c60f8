#pragma once

#include "cubecam/gl/program.hpp"
#include "cubecam/materials/user_shader.hpp"
#include "cubecam/render/passes/draw_conditions.hpp"
#include "cubecam/render/passes/user_interface.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/trial/trial.hpp"

#include <cstddef>
#include <initializer_list>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cubecam {

/// A program with a user's source in it, and the uniforms that the source declares.
class UserProgram {
public:
    /// `texts` are all that the user wrote: an input that occurs in them but is not among the
    /// uniforms was optimised away, which is no error.
    UserProgram(gl::Program program, std::vector<WrittenText> texts);

    const gl::Program& program() const { return program_; }

    /// Sets every uniform that the user declared, and binds the textures, which are in the order of
    /// `inputs.textures`. Uniforms without a value get the initial value of the source.
    /// @throws std::invalid_argument for an input that the source does not contain, for one of
    /// another shape or kind, or for a missing texture.
    void use(const ShaderInputs& inputs, std::span<const BoundTexture> textures);

    /// The keys of the conditions in which the driver survived the program.
    std::set<std::string, std::less<>> survived;

private:
    struct Uniform {
        std::string name;  ///< without the [0] of an array
        GLenum type;
        int count;  ///< elements of an array in use; otherwise 1
        bool array;
        GLint location;
        std::vector<double> initial;
        std::vector<double> current;
    };

    void find_uniforms();
    std::vector<double> initial_of(const Uniform& uniform) const;
    std::string place_of(const std::string& name) const;
    void check_known(const std::string& name) const;
    void set(Uniform& uniform, const std::vector<double>& numbers);

    gl::Program program_;
    std::vector<WrittenText> texts_;
    std::vector<Uniform> uniforms_;  // with the samplers
};

/// A text and the file of shaders/ that it replaces.
struct ShaderPart {
    std::string_view file;
    const UserSource* source;
    std::optional<UserStage> stage = {};  ///< of a text that a user wrote
    const UserSource* written = nullptr;  ///< the text as the user wrote it, if `source` is another
};

/// Returns the files of shaders/ with some of them replaced by the parts.
std::vector<gl::ShaderSource> substituted(std::span<const ShaderPart> parts);

/// A cache of the programs of users' sources, which drops the least recently used one: a source
/// that is edited while it is drawn leaves many old programs.
///
/// With a trial, a program is tried in another process before it is compiled here, and again before
/// it is drawn in conditions that are new.
class UserPrograms {
public:
    void set_trial(std::unique_ptr<trial::Trial> trial) { trial_ = std::move(trial); }
    bool tries() const { return trial_ != nullptr; }

    /// Must be called when OpenGL is in the state of the draw call, except for the program and its
    /// textures. `conditions` describe that state; `inputs` are those that the program will use.
    /// @throws ShaderError that names the user's own lines, or says how the trial ended.
    UserProgram& get(const GladGLContext& gl, std::initializer_list<std::string_view> files,
                     const gl::ShaderOptions& options, std::initializer_list<ShaderPart> parts,
                     DrawConditions& conditions, const ShaderInputs& inputs);

private:
    std::unique_ptr<trial::Trial> trial_;  // null: sources are trusted
    TextureKinds kinds_;
    std::list<std::pair<std::string, UserProgram>> programs_;  // most recently used first
};

}  // namespace cubecam
