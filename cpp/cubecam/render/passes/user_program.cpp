#include "cubecam/render/passes/user_program.hpp"

#include "cubecam/gl/glsl_text.hpp"
#include "cubecam/render/passes/shader_names.hpp"
#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/trial/capture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace cubecam {
namespace {

constexpr std::size_t most_programs = 64;

/// A GLSL type of `rows` x `columns` numbers.
struct Shape {
    GLenum type;
    const char* name;
    int rows;     ///< components of a vector
    int columns;  ///< 1 except for matrices
    enum class Scalar { real, whole, natural, truth } scalar;
};

constexpr Shape shapes[] = {
    {GL_FLOAT, "float", 1, 1, Shape::Scalar::real},
    {GL_FLOAT_VEC2, "vec2", 2, 1, Shape::Scalar::real},
    {GL_FLOAT_VEC3, "vec3", 3, 1, Shape::Scalar::real},
    {GL_FLOAT_VEC4, "vec4", 4, 1, Shape::Scalar::real},
    {GL_FLOAT_MAT2, "mat2", 2, 2, Shape::Scalar::real},
    {GL_FLOAT_MAT3, "mat3", 3, 3, Shape::Scalar::real},
    {GL_FLOAT_MAT4, "mat4", 4, 4, Shape::Scalar::real},
    {GL_INT, "int", 1, 1, Shape::Scalar::whole},
    {GL_INT_VEC2, "ivec2", 2, 1, Shape::Scalar::whole},
    {GL_INT_VEC3, "ivec3", 3, 1, Shape::Scalar::whole},
    {GL_INT_VEC4, "ivec4", 4, 1, Shape::Scalar::whole},
    {GL_UNSIGNED_INT, "uint", 1, 1, Shape::Scalar::natural},
    {GL_UNSIGNED_INT_VEC2, "uvec2", 2, 1, Shape::Scalar::natural},
    {GL_UNSIGNED_INT_VEC3, "uvec3", 3, 1, Shape::Scalar::natural},
    {GL_UNSIGNED_INT_VEC4, "uvec4", 4, 1, Shape::Scalar::natural},
    {GL_BOOL, "bool", 1, 1, Shape::Scalar::truth},
    {GL_BOOL_VEC2, "bvec2", 2, 1, Shape::Scalar::truth},
    {GL_BOOL_VEC3, "bvec3", 3, 1, Shape::Scalar::truth},
    {GL_BOOL_VEC4, "bvec4", 4, 1, Shape::Scalar::truth},
};

/// Returns null for a type that holds no numbers.
const Shape* find_shape(GLenum type) {
    const auto* found = std::find_if(std::begin(shapes), std::end(shapes),
                                     [type](const Shape& shape) { return shape.type == type; });
    return found == std::end(shapes) ? nullptr : found;
}

/// Returns the shape of a type that holds numbers.
const Shape& shape_of(GLenum type) {
    const Shape* shape = find_shape(type);
    return shape == nullptr ? shapes[0] : *shape;
}

const char* sampler_name(GLenum type) {
    if (type == GL_SAMPLER_2D) return "sampler2D";
    if (type == GL_SAMPLER_CUBE) return "samplerCube";
    return nullptr;
}

[[noreturn]] void refuse(const std::string& name, const std::string& expected,
                         const std::string& got) {
    throw std::invalid_argument(name + ": expected " + expected + ", got " + got);
}

std::string text_of(const std::vector<int>& shape) {
    if (shape.empty()) return "a number";
    std::string text = "shape (";
    for (const int length : shape) text += std::to_string(length) + ", ";
    text.resize(text.size() - (shape.size() == 1 ? 1 : 2));
    return text + ")";
}

/// Returns the value's numbers. Their shape must be that of the declared type: (), (rows,) or
/// (rows, columns), for an array with the number of elements in front.
std::vector<double> fitted(const std::string& name, const UniformValue& value, const Shape& shape,
                           bool array, int count) {
    std::vector<int> wanted;
    if (shape.rows > 1) wanted.push_back(shape.rows);
    if (shape.columns > 1) wanted.push_back(shape.columns);
    std::vector<int> got = value.shape;
    bool enough = true;
    if (array) {
        enough = !got.empty() && got.front() >= count;
        if (!got.empty()) got.erase(got.begin());
    } else if (wanted.empty() && got == std::vector<int>{1}) {
        got.clear();  // one number in brackets
    }
    if (!enough || got != wanted) {
        std::vector<int> whole = wanted;
        if (array) whole.insert(whole.begin(), count);
        refuse("uniform " + name,
               text_of(whole) + " for a " + shape.name +
                   (array ? "[" + std::to_string(count) + "]" : ""),
               text_of(value.shape));
    }
    for (const double number : value.numbers) {
        if (shape.scalar == Shape::Scalar::real || shape.scalar == Shape::Scalar::truth) continue;
        const double least = shape.scalar == Shape::Scalar::natural ? 0.0 : -2147483648.0;
        const double most = shape.scalar == Shape::Scalar::natural ? 4294967295.0 : 2147483647.0;
        if (number == std::floor(number) && number >= least && number <= most) continue;
        refuse("uniform " + name, std::string("whole numbers for an ") + shape.name,
               std::to_string(number));
    }
    std::vector<double> numbers = value.numbers;
    if (array) numbers.resize(static_cast<std::size_t>(count * shape.rows * shape.columns));
    return numbers;
}

}  // namespace

UserProgram::UserProgram(gl::Program program, std::vector<WrittenText> texts)
    : program_(std::move(program)), texts_(std::move(texts)) {
    find_uniforms();
}

/// Returns "fragment:3: " for a name that a text declares in its third line.
std::string UserProgram::place_of(const std::string& name) const {
    const std::string word = name.substr(0, name.find_first_of(".["));
    for (const WrittenText& text : texts_) {
        if (const auto line = gl::line_of_word(text.source.text, word)) {
            return std::string(title_of(text.source, text.stage)) + ":" + std::to_string(*line) +
                   ": ";
        }
    }
    return "";
}

void UserProgram::find_uniforms() {
    const auto& own = shader_names(texts_.front().stage).variables;
    const GladGLContext& gl = program_.gl();
    GLint count = 0;
    GLint longest = 0;
    gl.GetProgramiv(program_.id(), GL_ACTIVE_UNIFORMS, &count);
    gl.GetProgramiv(program_.id(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(std::max(longest, 1)), '\0');
    for (GLint i = 0; i < count; ++i) {
        GLsizei length = 0;
        Uniform uniform{};
        gl.GetActiveUniform(program_.id(), static_cast<GLuint>(i), longest, &length, &uniform.count,
                            &uniform.type, name.data());
        uniform.name = name.substr(0, static_cast<std::size_t>(length));
        uniform.location = gl.GetUniformLocation(program_.id(), uniform.name.c_str());
        if (uniform.location < 0) continue;  // in a block
        uniform.array = uniform.name.ends_with("[0]");
        if (uniform.array) uniform.name.resize(uniform.name.size() - 3);
        if (own.contains(uniform.name)) continue;
        if (find_shape(uniform.type) != nullptr) {
            uniform.initial = initial_of(uniform);
            uniform.current = uniform.initial;
        } else if (sampler_name(uniform.type) == nullptr || uniform.array) {
            refuse(place_of(uniform.name) + "uniform " + uniform.name,
                   "a float, int, uint or bool, a vector or square matrix of them, a sampler2D or "
                   "a samplerCube",
                   "another type, or an array of samplers");
        }
        uniforms_.push_back(std::move(uniform));
    }
}

/// Returns the initial value in the source, as in `uniform float x = 2.0;`; matrices are row by
/// row.
std::vector<double> UserProgram::initial_of(const Uniform& uniform) const {
    const GladGLContext& gl = program_.gl();
    const Shape& shape = shape_of(uniform.type);
    std::vector<double> numbers;
    for (int element = 0; element < uniform.count; ++element) {
        const GLint location =
            uniform.array
                ? gl.GetUniformLocation(
                      program_.id(), (uniform.name + "[" + std::to_string(element) + "]").c_str())
                : uniform.location;
        std::array<double, 16> values{};
        if (location < 0) {
            // The element is not in use and stays 0.
        } else if (shape.scalar == Shape::Scalar::real) {
            std::array<float, 16> read{};
            gl.GetUniformfv(program_.id(), location, read.data());
            std::copy(read.begin(), read.end(), values.begin());
        } else if (shape.scalar == Shape::Scalar::natural) {
            std::array<GLuint, 16> read{};
            gl.GetUniformuiv(program_.id(), location, read.data());
            std::copy(read.begin(), read.end(), values.begin());
        } else {
            std::array<GLint, 16> read{};
            gl.GetUniformiv(program_.id(), location, read.data());
            std::copy(read.begin(), read.end(), values.begin());
        }
        for (int row = 0; row < shape.rows; ++row) {
            for (int column = 0; column < shape.columns; ++column) {
                numbers.push_back(values[static_cast<std::size_t>(column * shape.rows + row)]);
            }
        }
    }
    return numbers;
}

void UserProgram::check_known(const std::string& name) const {
    // "lamps[2].color" is known if the source mentions "lamps".
    const std::string word = name.substr(0, name.find_first_of(".["));
    for (const WrittenText& text : texts_) {
        if (mentions(text.source.text, word)) return;
    }
    std::string known;
    for (const Uniform& uniform : uniforms_) known += (known.empty() ? "" : ", ") + uniform.name;
    refuse("uniform " + name,
           known.empty() ? "none, since the source declares none" : "one of " + known,
           "a name that the source does not know");
}

void UserProgram::use(const ShaderInputs& inputs, std::span<const BoundTexture> textures) {
    const GladGLContext& gl = program_.gl();
    for (const auto& [name, value] : inputs.uniforms) check_known(name);
    for (const auto& [name, source] : inputs.textures) check_known(name);
    for (Uniform& uniform : uniforms_) {
        if (const char* sampler = sampler_name(uniform.type)) {
            const auto found = inputs.textures.find(uniform.name);
            if (found == inputs.textures.end()) {
                refuse("texture " + uniform.name, std::string("one for the ") + sampler, "none");
            }
            const bool cube = std::holds_alternative<CubeSource>(found->second);
            if (cube != (uniform.type == GL_SAMPLER_CUBE)) {
                refuse("texture " + uniform.name,
                       cube ? "an Image for the sampler2D"
                            : "a CubeMap or Probe for the samplerCube",
                       cube ? "a cubemap" : "an Image");
            }
            const auto index =
                static_cast<std::size_t>(std::distance(inputs.textures.begin(), found));
            const GLuint unit = texture_unit::first_of_material + static_cast<GLuint>(index);
            gl.ProgramUniform1i(program_.id(), uniform.location, static_cast<GLint>(unit));
            gl.BindTextureUnit(unit, textures[index].texture);
            continue;
        }
        const auto found = inputs.uniforms.find(uniform.name);
        if (found == inputs.uniforms.end()) {
            set(uniform, uniform.initial);
        } else {
            set(uniform, fitted(uniform.name, found->second, shape_of(uniform.type), uniform.array,
                                uniform.count));
        }
    }
}

void UserProgram::set(Uniform& uniform, const std::vector<double>& numbers) {
    if (numbers == uniform.current) return;
    const GladGLContext& gl = program_.gl();
    const Shape& shape = shape_of(uniform.type);
    const GLuint id = program_.id();
    const GLint at = uniform.location;
    const GLsizei n = uniform.count;
    if (shape.scalar == Shape::Scalar::real) {
        const std::vector<float> values(numbers.begin(), numbers.end());
        const float* v = values.data();
        switch (uniform.type) {
            case GL_FLOAT: gl.ProgramUniform1fv(id, at, n, v); break;
            case GL_FLOAT_VEC2: gl.ProgramUniform2fv(id, at, n, v); break;
            case GL_FLOAT_VEC3: gl.ProgramUniform3fv(id, at, n, v); break;
            case GL_FLOAT_VEC4: gl.ProgramUniform4fv(id, at, n, v); break;
            case GL_FLOAT_MAT2: gl.ProgramUniformMatrix2fv(id, at, n, GL_TRUE, v); break;
            case GL_FLOAT_MAT3: gl.ProgramUniformMatrix3fv(id, at, n, GL_TRUE, v); break;
            default: gl.ProgramUniformMatrix4fv(id, at, n, GL_TRUE, v); break;
        }
    } else if (shape.scalar == Shape::Scalar::natural) {
        const std::vector<GLuint> values(numbers.begin(), numbers.end());
        const GLuint* v = values.data();
        switch (shape.rows) {
            case 1: gl.ProgramUniform1uiv(id, at, n, v); break;
            case 2: gl.ProgramUniform2uiv(id, at, n, v); break;
            case 3: gl.ProgramUniform3uiv(id, at, n, v); break;
            default: gl.ProgramUniform4uiv(id, at, n, v); break;
        }
    } else {
        std::vector<GLint> values;
        for (const double number : numbers) {
            values.push_back(shape.scalar == Shape::Scalar::truth ? GLint{number != 0.0}
                                                                  : static_cast<GLint>(number));
        }
        const GLint* v = values.data();
        switch (shape.rows) {
            case 1: gl.ProgramUniform1iv(id, at, n, v); break;
            case 2: gl.ProgramUniform2iv(id, at, n, v); break;
            case 3: gl.ProgramUniform3iv(id, at, n, v); break;
            default: gl.ProgramUniform4iv(id, at, n, v); break;
        }
    }
    uniform.current = numbers;
}

std::vector<gl::ShaderSource> substituted(std::span<const ShaderPart> parts) {
    std::vector<gl::ShaderSource> sources(gl::embedded_shaders().begin(),
                                          gl::embedded_shaders().end());
    for (gl::ShaderSource& source : sources) {
        for (const ShaderPart& part : parts) {
            if (source.name != part.file) continue;
            source.text = part.source->text;
            source.user = part.stage.has_value();
            if (part.stage) source.title = title_of(*part.source, *part.stage);
        }
    }
    return sources;
}

namespace {

constexpr std::size_t most_conditions = 256;  // of one program

/// The texts of a program: as users wrote them, and as they are compiled.
struct ProgramTexts {
    std::vector<WrittenText> written;
    std::list<PreparedText> prepared;
    std::vector<gl::ShaderSource> sources;  ///< which refer to the others
};

/// @throws ShaderError for a text that shall not be compiled
ProgramTexts write_texts(std::span<const ShaderPart> parts) {
    ProgramTexts texts;
    texts.written.reserve(parts.size());  // the sources refer to them
    texts.sources = substituted(parts);
    for (const ShaderPart& part : parts) {
        if (!part.stage || part.source->text.empty()) continue;
        const UserSource& own = part.written == nullptr ? *part.source : *part.written;
        texts.written.push_back({{gl::with_plain_lines(own.text), own.path}, *part.stage});
        check_user_text(texts.written.back().source, *part.stage);
        texts.prepared.push_back(prepare_user_text(
            {gl::with_plain_lines(part.source->text), part.source->path}, *part.stage));
        for (gl::ShaderSource& source : texts.sources) {
            if (source.name != part.file) continue;
            source.text = texts.prepared.back().text;
            source.after = texts.prepared.back().after;
            source.written = texts.written.back().source.text;
        }
    }
    return texts;
}

/// Returns what to try: the program's stages in the present state of OpenGL.
trial::Job make_job(const GladGLContext& gl, std::initializer_list<std::string_view> files,
                    const gl::ShaderOptions& options, std::span<const gl::ShaderSource> sources,
                    std::vector<trial::Texture> textures, const ShaderInputs& inputs) {
    trial::Job job;
    for (const std::string_view file : files) {
        job.stages.push_back({gl::stage_of(file), gl::expand_shader(file, options, sources).text});
    }
    job.state = trial::capture_state(gl);
    job.textures = std::move(textures);
    GLuint unit = texture_unit::first_of_material;
    for (const auto& [name, source] : inputs.textures) job.samplers.push_back({name, unit++});
    return job;
}

/// Returns what messages call the user's texts: "fragment", "water.glsl".
std::string titles_of(std::span<const ShaderPart> parts) {
    std::string titles;
    for (const ShaderPart& part : parts) {
        if (!part.stage || part.source->text.empty()) continue;
        if (!titles.empty()) titles += " and ";
        titles += title_of(*part.source, *part.stage);
    }
    return titles;
}

}  // namespace

UserProgram& UserPrograms::get(const GladGLContext& gl,
                               std::initializer_list<std::string_view> files,
                               const gl::ShaderOptions& options,
                               std::initializer_list<ShaderPart> parts, DrawConditions& conditions,
                               const ShaderInputs& inputs) {
    // The key contains all parts of the program, so that no two programs share one.
    std::string key;
    const auto add = [&key](std::string_view text) { key.append(text).push_back('\0'); };
    for (const std::string_view file : files) add(file);
    for (const std::string& extension : options.extensions) add(extension);
    for (const auto& [name, value] : options.defines) add(name + "=" + value);
    for (const ShaderPart& part : parts) {
        add(part.source->text);
        add(part.source->path);
    }
    const auto found = std::find_if(programs_.begin(), programs_.end(),
                                    [&key](const auto& held) { return held.first == key; });
    std::vector<trial::Texture> textures;
    if (trial_ != nullptr) {
        for (const UnitTexture& texture : conditions.textures) {
            if (texture.texture == 0) continue;
            textures.push_back(kinds_.find(gl, texture));
            conditions.key.append(reinterpret_cast<const char*>(&textures.back()),
                                  sizeof(trial::Texture));
        }
    }
    const bool known = found != programs_.end();
    const bool tried =
        trial_ == nullptr || (known && found->second.survived.contains(conditions.key));
    std::optional<ProgramTexts> texts;
    if (!known || !tried) texts = write_texts(parts);
    if (!tried) {
        trial_->require(make_job(gl, files, options, texts->sources, std::move(textures), inputs),
                        titles_of(parts));
    }
    if (known) {
        programs_.splice(programs_.begin(), programs_, found);
        std::set<std::string, std::less<>>& survived = programs_.front().second.survived;
        if (survived.size() >= most_conditions) survived.clear();
        if (trial_ != nullptr) survived.insert(conditions.key);
        return programs_.front().second;
    }

    gl::Program program(gl, files, options, texts->sources);
    check_interface(gl, program.id(), texts->written);
    UserProgram made(std::move(program), std::move(texts->written));
    if (trial_ != nullptr) made.survived.insert(conditions.key);
    if (programs_.size() == most_programs) programs_.pop_back();
    programs_.emplace_front(std::move(key), std::move(made));
    return programs_.front().second;
}

}  // namespace cubecam
