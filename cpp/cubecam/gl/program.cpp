#include "cubecam/gl/program.hpp"

#include "cubecam/core/error.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <stdexcept>

namespace cubecam::gl {

GLenum stage_of(std::string_view name) {
    if (name.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (name.ends_with(".tesc")) return GL_TESS_CONTROL_SHADER;
    if (name.ends_with(".tese")) return GL_TESS_EVALUATION_SHADER;
    if (name.ends_with(".geom")) return GL_GEOMETRY_SHADER;
    if (name.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    if (name.ends_with(".comp")) return GL_COMPUTE_SHADER;
    throw std::invalid_argument("shader file: expected a name ending in .vert, .tesc, .tese, "
                                ".geom, .frag or .comp, got \"" +
                                std::string(name) + "\"");
}

namespace {

ShaderHandle compile(const GladGLContext& gl, std::string_view name, const ExpandedShader& source) {
    ShaderHandle shader(gl, gl.CreateShader(stage_of(name)));
    const char* text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    gl.ShaderSource(shader.id(), 1, &text, &length);
    gl.CompileShader(shader.id());
    GLint ok = 0;
    gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok != 0) return shader;

    GLint log_length = 0;
    gl.GetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &log_length);
    std::string log(static_cast<std::size_t>(log_length), '\0');
    GLsizei written = 0;
    gl.GetShaderInfoLog(shader.id(), log_length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    const std::string explained = explain_shader_log(log, source);
    // A source with a title was written by the user, who looks for this name in the message.
    const auto own = std::find_if(
        source.files.begin(), source.files.end(), [&explained](const ShaderSource& file) {
            return !file.title.empty() && explained.starts_with(std::string(file.title) + ":");
        });
    throw ShaderError(std::string(own == source.files.end() ? name : own->title) +
                          " does not compile:\n" + explained,
                      log);
}

std::string joined(std::span<const std::string_view> files) {
    std::string text;
    for (const std::string_view file : files) text.append(text.empty() ? "" : " + ").append(file);
    return text;
}

}  // namespace

Program::Program(const GladGLContext& gl, std::initializer_list<std::string_view> files,
                 const ShaderOptions& options, std::span<const ShaderSource> sources)
    : Program(gl, std::span(files.begin(), files.size()), options, sources) {}

Program::Program(const GladGLContext& gl, std::span<const std::string_view> files,
                 const ShaderOptions& options, std::span<const ShaderSource> sources)
    : handle_(gl, gl.CreateProgram()) {
    std::vector<ShaderHandle> shaders;
    for (const std::string_view file : files) {
        shaders.push_back(compile(gl, file, expand_shader(file, options, sources)));
        gl.AttachShader(id(), shaders.back().id());
    }
    gl.LinkProgram(id());
    for (const ShaderHandle& shader : shaders) gl.DetachShader(id(), shader.id());
    GLint ok = 0;
    gl.GetProgramiv(id(), GL_LINK_STATUS, &ok);
    if (ok != 0) return;

    GLint log_length = 0;
    gl.GetProgramiv(id(), GL_INFO_LOG_LENGTH, &log_length);
    std::string log(static_cast<std::size_t>(log_length), '\0');
    GLsizei written = 0;
    gl.GetProgramInfoLog(id(), log_length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    while (log.ends_with('\n')) log.pop_back();
    throw ShaderError(joined(files) + " do not link:\n" + log, log);
}

GLint Program::location(std::string_view name) const {
    const auto found = locations_.find(name);
    if (found != locations_.end()) return found->second;
    std::string key(name);
    const GLint place = handle_.gl().GetUniformLocation(id(), key.c_str());
    locations_.emplace(std::move(key), place);
    return place;
}

// OpenGL ignores location -1 (GL 4.5 section 7.6.1).
void Program::set(std::string_view name, int value) const {
    handle_.gl().ProgramUniform1i(id(), location(name), value);
}
void Program::set(std::string_view name, unsigned value) const {
    handle_.gl().ProgramUniform1ui(id(), location(name), value);
}
void Program::set(std::string_view name, float value) const {
    handle_.gl().ProgramUniform1f(id(), location(name), value);
}
void Program::set(std::string_view name, const glm::vec2& value) const {
    handle_.gl().ProgramUniform2fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec3& value) const {
    handle_.gl().ProgramUniform3fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec4& value) const {
    handle_.gl().ProgramUniform4fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::ivec2& value) const {
    handle_.gl().ProgramUniform2iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::mat3& value) const {
    handle_.gl().ProgramUniformMatrix3fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::mat4& value) const {
    handle_.gl().ProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace cubecam::gl
