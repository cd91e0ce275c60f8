#include "cubecam/gl/program.hpp"

#include "cubecam/core/error.hpp"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

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
    // A text that a user wrote has a name, which the user looks for in the message.
    throw ShaderError(
        shown_names({&source, 1}) + " does not compile:\n" + explain_shader_log(log, source), log);
}

}  // namespace

Program::Program(const GladGLContext& gl, std::initializer_list<std::string_view> files,
                 const ShaderOptions& options, std::span<const ShaderSource> sources)
    : Program(gl, std::span(files.begin(), files.size()), options, sources) {}

Program::Program(const GladGLContext& gl, std::span<const std::string_view> files,
                 const ShaderOptions& options, std::span<const ShaderSource> sources)
    : handle_(gl, gl.CreateProgram()) {
    std::vector<ShaderHandle> shaders;
    std::vector<ExpandedShader> texts;
    for (const std::string_view file : files) {
        texts.push_back(expand_shader(file, options, sources));
        shaders.push_back(compile(gl, file, texts.back()));
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
    const std::string names = shown_names(texts);
    const char* verb =
        names.find(" + ") == std::string::npos ? " does not link:\n" : " do not link:\n";
    throw ShaderError(names + verb + explain_link_log(log, texts), log);
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
