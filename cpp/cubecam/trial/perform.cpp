#include "cubecam/trial/perform.hpp"

#include "cubecam/gl/objects.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace cubecam::trial {
namespace {

constexpr int odd_side = 5;   // of a texture whose sides are no powers of two
constexpr int even_side = 4;  // of one whose sides are

bool compiles(const GladGLContext& gl, GLuint shader, const std::string& text) {
    const char* begin = text.data();
    const auto length = static_cast<GLint>(text.size());
    gl.ShaderSource(shader, 1, &begin, &length);
    gl.CompileShader(shader);
    GLint ok = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    return ok != 0;
}

GLuint name_of_new_texture(const GladGLContext& gl, GLenum target) {
    GLuint id = 0;
    gl.CreateTextures(target, 1, &id);
    return id;
}

/// Makes a texture of any kind; the numbers in it do not matter.
gl::Texture make_texture(const GladGLContext& gl, GLenum target, GLenum format, int width,
                         int height, int levels, int samples) {
    gl::Texture texture(gl, name_of_new_texture(gl, target));
    const GLuint id = texture.id();
    switch (target) {
        case GL_TEXTURE_2D:
        case GL_TEXTURE_CUBE_MAP: gl.TextureStorage2D(id, levels, format, width, height); break;
        case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
            gl.TextureStorage3DMultisample(id, samples, format, width, height, 1, GL_TRUE);
            break;
        default: {
            const int layers = target == GL_TEXTURE_CUBE_MAP_ARRAY ? 6 : 1;
            gl.TextureStorage3D(id, levels, format, width, height, layers);
        }
    }
    gl::check_gl(gl, "a texture of a trial");
    return texture;
}

gl::Texture make_looked_up(const GladGLContext& gl, const Texture& texture) {
    int width = (texture.sides & 1U) != 0 ? odd_side : even_side;
    int height = (texture.sides & 2U) != 0 ? odd_side : even_side;
    if (texture.target == GL_TEXTURE_CUBE_MAP) height = width;
    gl::Texture made = make_texture(gl, texture.target, texture.format, width, height,
                                    static_cast<int>(texture.levels), 1);
    const auto set = [&](GLenum name, std::uint32_t value) {
        gl.TextureParameteri(made.id(), name, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MIN_FILTER, texture.min_filter);
    set(GL_TEXTURE_MAG_FILTER, texture.mag_filter);
    set(GL_TEXTURE_WRAP_S, texture.wrap[0]);
    set(GL_TEXTURE_WRAP_T, texture.wrap[1]);
    set(GL_TEXTURE_WRAP_R, texture.wrap[2]);
    set(GL_TEXTURE_SWIZZLE_R, texture.swizzle[0]);
    set(GL_TEXTURE_SWIZZLE_G, texture.swizzle[1]);
    set(GL_TEXTURE_SWIZZLE_B, texture.swizzle[2]);
    set(GL_TEXTURE_SWIZZLE_A, texture.swizzle[3]);
    set(GL_TEXTURE_COMPARE_MODE, texture.compare);
    gl::check_gl(gl, "a texture of a trial");
    gl.BindTextureUnit(texture.unit, made.id());
    return made;
}

GLenum depth_point(GLenum format) {
    switch (format) {
        case GL_DEPTH24_STENCIL8:
        case GL_DEPTH32F_STENCIL8: return GL_DEPTH_STENCIL_ATTACHMENT;
        case GL_STENCIL_INDEX8: return GL_STENCIL_ATTACHMENT;
        default: return GL_DEPTH_ATTACHMENT;
    }
}

/// A framebuffer of one pixel with the attachments of the state.
class OnePixel {
public:
    OnePixel(const GladGLContext& gl, const State& state)
        : gl_(gl), framebuffer_(gl::create_framebuffer(gl)) {
        std::vector<GLenum> buffers;
        for (std::size_t i = 0; i < most_outputs; ++i) {
            const auto point = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
            const bool used = state.color_formats[i] != 0;
            if (used) attach(point, state.color_formats[i], state);
            buffers.push_back(used ? point : GLenum{GL_NONE});
        }
        if (state.depth_format != 0) {
            attach(depth_point(state.depth_format), state.depth_format, state);
        }
        gl.NamedFramebufferDrawBuffers(framebuffer_.id(), static_cast<GLsizei>(buffers.size()),
                                       buffers.data());
        gl::check_framebuffer(gl, framebuffer_, "a framebuffer of a trial");
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    }

private:
    void attach(GLenum point, GLenum format, const State& state) {
        const GLenum target = state.target == 0 ? GLenum{GL_TEXTURE_2D_ARRAY} : state.target;
        textures_.push_back(
            make_texture(gl_, target, format, 1, 1, 1, static_cast<int>(state.samples)));
        const GLuint id = textures_.back().id();
        if (state.layered != 0) {
            gl_.NamedFramebufferTexture(framebuffer_.id(), point, id, 0);
        } else {
            gl_.NamedFramebufferTextureLayer(framebuffer_.id(), point, id, 0, 0);
        }
    }

    const GladGLContext& gl_;
    gl::Framebuffer framebuffer_;
    std::vector<gl::Texture> textures_;
};

void enable(const GladGLContext& gl, GLenum capability, bool on) {
    if (on) {
        gl.Enable(capability);
    } else {
        gl.Disable(capability);
    }
}

void set_state(const GladGLContext& gl, const State& state) {
    gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    gl.Disable(GL_DITHER);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.Viewport(0, 0, 1, 1);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, 1, 1);
    gl.Disable(GL_CULL_FACE);  // which side the triangle shows must not matter
    gl.Disable(GL_BLEND);
    if (state.blend != 0) {
        gl.Enablei(GL_BLEND, 0);
        gl.BlendEquationSeparate(state.blend_equation, state.blend_equation_alpha);
        gl.BlendFuncSeparate(state.blend_source, state.blend_target, state.blend_source_alpha,
                             state.blend_target_alpha);
    }
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (GLuint i = 0; i < most_outputs; ++i) {
        if (state.color_formats[i] == 0) continue;
        const auto on = [&](unsigned channel) {
            return static_cast<GLboolean>((state.color_masks[i] >> channel & 1U) != 0 ? GL_TRUE
                                                                                      : GL_FALSE);
        };
        gl.ColorMaski(i, on(0), on(1), on(2), on(3));
    }
    enable(gl, GL_DEPTH_TEST, state.depth_test != 0);
    if (state.depth_test != 0) {
        gl.DepthFunc(state.depth_func);
        gl.DepthMask(state.depth_mask != 0 ? GL_TRUE : GL_FALSE);
    }
    enable(gl, GL_CLIP_DISTANCE0, state.clip_distance != 0);
    enable(gl, GL_STENCIL_TEST, state.stencil_test != 0);
    if (state.stencil_test != 0) {
        gl.StencilFunc(state.stencil_func, static_cast<GLint>(state.stencil_reference),
                       state.stencil_read_mask);
        gl.StencilMask(state.stencil_write_mask);
        gl.StencilOp(state.stencil_fail, state.stencil_depth_fail, state.stencil_depth_pass);
    }
}

/// Clears depth so that the triangle, which lies at depth 0.5, passes the test.
void clear_depth(const GladGLContext& gl, const State& state) {
    if (state.depth_format == 0 || state.depth_format == GL_STENCIL_INDEX8) return;
    const bool reversed = state.depth_func == GL_GREATER || state.depth_func == GL_GEQUAL;
    const GLfloat behind = reversed ? 0.0F : 1.0F;
    gl.DepthMask(GL_TRUE);
    gl.ClearBufferfv(GL_DEPTH, 0, &behind);
    if (state.depth_test != 0) gl.DepthMask(state.depth_mask != 0 ? GL_TRUE : GL_FALSE);
}

/// The vertices of a triangle that covers the picture, and one instance whose matrix changes
/// nothing. Attribute 0 is the position; attributes 4 to 7 are the columns of a matrix if they are
/// those of an instance.
class Vertices {
public:
    Vertices(const GladGLContext& gl, const State& state) : array_(gl::create_vertex_array(gl)) {
        const GLuint array = array_.id();
        std::map<std::uint32_t, std::vector<float>> numbers;  // by binding
        for (GLuint i = 0; i < most_attributes; ++i) {
            const Attribute& attribute = state.attributes[i];
            if (attribute.components == 0) continue;
            const auto size = static_cast<GLint>(attribute.components);
            gl.EnableVertexArrayAttrib(array, i);
            if (attribute.integer != 0) {
                gl.VertexArrayAttribIFormat(array, i, size, attribute.type, attribute.offset);
            } else {
                gl.VertexArrayAttribFormat(array, i, size, attribute.type, GL_FALSE,
                                           attribute.offset);
            }
            gl.VertexArrayAttribBinding(array, i, attribute.binding);
            gl.VertexArrayBindingDivisor(array, attribute.binding, attribute.divisor);
            fill(i, attribute, numbers[attribute.binding]);
        }
        for (const auto& [binding, values] : numbers) {
            const auto uses = [&](const Attribute& attribute) {
                return attribute.components != 0 && attribute.binding == binding;
            };
            const auto* user = std::find_if(state.attributes.begin(), state.attributes.end(), uses);
            buffers_.push_back(gl::create_buffer(gl, std::span<const float>(values)));
            gl.VertexArrayVertexBuffer(array, binding, buffers_.back().id(), 0,
                                       static_cast<GLsizei>(user->stride));
            gl::settle_vertex_array(gl, array, binding, buffers_.back().id(), user->stride);
        }
        gl.BindVertexArray(array);
    }

private:
    static void fill(GLuint index, const Attribute& attribute, std::vector<float>& numbers) {
        constexpr std::size_t least = 256;
        constexpr std::array<float, 9> corners = {-1, -1, 0.5F, 3, -1, 0.5F, -1, 3, 0.5F};
        const std::size_t begin = attribute.offset / sizeof(float);
        const std::size_t step = attribute.stride / sizeof(float);
        numbers.resize(std::max({numbers.size(), least, begin + 3 * step + 4}), 0.5F);
        const bool column = index >= 4 && index < 8 && attribute.divisor != 0;
        for (std::size_t i = 0; column && i < 4; ++i) numbers[begin + i] = i == index - 4 ? 1 : 0;
        for (std::size_t i = 0; index == 0 && i < corners.size(); ++i) {
            numbers[begin + i / 3 * step + i % 3] = corners[i];
        }
    }

    gl::VertexArray array_;
    std::vector<gl::Buffer> buffers_;
};

/// Buffers for the program's uniform blocks: matrices change nothing, other floats are 0.5, so that
/// the triangle stays where it is, and integers, such as counts of lights, are 0.
class Blocks {
public:
    Blocks(const GladGLContext& gl, GLuint program) {
        GLint count = 0;
        gl.GetProgramiv(program, GL_ACTIVE_UNIFORM_BLOCKS, &count);
        for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
            const auto parameter = [&](GLenum name) {
                GLint value = 0;
                gl.GetActiveUniformBlockiv(program, i, name, &value);
                return value;
            };
            std::vector<float> numbers(
                static_cast<std::size_t>(parameter(GL_UNIFORM_BLOCK_DATA_SIZE)) / sizeof(float) +
                16);
            std::vector<GLint> members(
                static_cast<std::size_t>(parameter(GL_UNIFORM_BLOCK_ACTIVE_UNIFORMS)));
            gl.GetActiveUniformBlockiv(program, i, GL_UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES,
                                       members.data());
            for (const GLint member : members) {
                fill(gl, program, static_cast<GLuint>(member), numbers);
            }
            buffers_.push_back(gl::create_buffer(gl, std::span<const float>(numbers)));
            gl.BindBufferBase(GL_UNIFORM_BUFFER,
                              static_cast<GLuint>(parameter(GL_UNIFORM_BLOCK_BINDING)),
                              buffers_.back().id());
        }
    }

private:
    static void fill(const GladGLContext& gl, GLuint program, GLuint member,
                     std::vector<float>& numbers) {
        const auto parameter = [&](GLenum name) {
            GLint value = 0;
            gl.GetActiveUniformsiv(program, 1, &member, name, &value);
            return value;
        };
        const auto type = static_cast<GLenum>(parameter(GL_UNIFORM_TYPE));
        const auto put = [&](GLint byte, float number) {
            const auto at = static_cast<std::size_t>(byte) / sizeof(float);
            if (at < numbers.size()) numbers[at] = number;
        };
        const GLint begin = parameter(GL_UNIFORM_OFFSET);
        const GLint elements = parameter(GL_UNIFORM_SIZE);
        const GLint step = std::max(parameter(GL_UNIFORM_ARRAY_STRIDE), 16);
        for (GLint element = 0; element < elements; ++element) {
            const GLint at = begin + element * step;
            if (type == GL_FLOAT_MAT4 || type == GL_FLOAT_MAT3) {
                const GLint column = parameter(GL_UNIFORM_MATRIX_STRIDE);
                for (GLint i = 0; i < (type == GL_FLOAT_MAT4 ? 4 : 3); ++i) {
                    put(at + i * column + i * 4, 1.0F);
                }
                continue;
            }
            const int components = type == GL_FLOAT        ? 1
                                   : type == GL_FLOAT_VEC2 ? 2
                                   : type == GL_FLOAT_VEC3 ? 3
                                   : type == GL_FLOAT_VEC4 ? 4
                                                           : 0;
            for (int i = 0; i < components; ++i) put(at + i * 4, 0.5F);
        }
    }

    std::vector<gl::Buffer> buffers_;
};

/// Sets the units of the samplers that the user declared; the others have theirs in the source.
void set_samplers(const GladGLContext& gl, GLuint program, const Job& job) {
    for (const Sampler& sampler : job.samplers) {
        const GLint location = gl.GetUniformLocation(program, sampler.name.c_str());
        if (location < 0) continue;
        gl.ProgramUniform1i(program, location, static_cast<GLint>(sampler.unit));
    }
}

void draw_pixel(const GladGLContext& gl, GLuint program, const Job& job) {
    const OnePixel pixel(gl, job.state);
    std::vector<gl::Texture> textures;
    for (const Texture& texture : job.textures) textures.push_back(make_looked_up(gl, texture));
    set_samplers(gl, program, job);
    const Blocks blocks(gl, program);
    set_state(gl, job.state);
    clear_depth(gl, job.state);
    const Vertices vertices(gl, job.state);
    gl.UseProgram(program);
    gl::check_gl(gl, "the state of a trial");
    gl.DrawArraysInstanced(GL_TRIANGLES, 0, 3, 1);
    gl.Finish();
    for (const Texture& texture : job.textures) gl.BindTextureUnit(texture.unit, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.UseProgram(0);
    while (gl.GetError() != GL_NO_ERROR) {
    }
}

}  // namespace

void perform(const GladGLContext& gl, const Job& job, const std::function<void(Step)>& begins) {
    begins(Step::compile);
    const gl::ProgramHandle program(gl, gl.CreateProgram());
    std::vector<gl::ShaderHandle> shaders;
    for (const Stage& stage : job.stages) {
        shaders.emplace_back(gl, gl.CreateShader(stage.type));
        if (!compiles(gl, shaders.back().id(), stage.text)) return;
        gl.AttachShader(program.id(), shaders.back().id());
    }
    begins(Step::link);
    gl.LinkProgram(program.id());
    GLint ok = 0;
    gl.GetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (ok == 0) return;
    begins(Step::draw);
    draw_pixel(gl, program.id(), job);
}

}  // namespace cubecam::trial
