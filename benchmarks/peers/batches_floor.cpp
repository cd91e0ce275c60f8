// Cubemaps of a field by OpenGL calls alone: what a loop in C++ takes, with nothing between it and the driver.
// It draws as batches_moderngl.py does, which calls it with arrays.

#include <glad/egl.h>
#include <glad/gl.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Mesh {
    const float* vertices;  // position and normal, 6 numbers each
    std::int32_t vertex_count;
    const std::uint32_t* indices;
    std::int32_t index_count;
};

}  // namespace

// As in batches_floor.py.
struct Plan {
    const char* vertex_source;
    const char* fragment_source;
    std::int32_t size;
    std::int32_t samples;
    std::int32_t float_colors;
    std::int32_t output_count;
    const std::int32_t* channels;  // read of each output: 1 or 3
    const float* clears;           // of the colour, then of each output, 4 numbers each
    Mesh mesh;
    Mesh ground;
    std::int32_t nodes;
    const float* models;   // 16 numbers each, by columns
    const float* colors;   // 3 numbers each; the last is that of the ground
    const double* places;  // 3 numbers each
    double reach;          // of a bounding sphere, times the root of 2
    const float* lights;   // 4 numbers each
    std::int32_t light_count;
    const float* weights;     // 4 numbers
    const double* turned;     // of each face: projection times rotation, 16 numbers by columns
    const double* forwards;   // of each face, 3 numbers
};

namespace {

void check(bool ok, const char* what) {
    if (!ok) throw std::runtime_error(what);
}

struct Array {
    GLuint id = 0;
    GLsizei count = 0;
};

class Floor {
public:
    explicit Floor(const Plan& plan) : plan_(plan) {
        make_context();
        make_program();
        mesh_ = make_array(plan.mesh);
        ground_ = make_array(plan.ground);
        target_ = make_target(plan.samples > 1 ? plan.samples : 0);
        if (plan.samples > 1) resolved_ = make_target(0);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        check(glGetError() == GL_NO_ERROR, "an OpenGL call failed");
    }

    void draw(std::int32_t count, const double* positions, void* const* results) {
        const int n = plan_.size;
        const float depth = 1.0F;
        for (int probe = 0; probe < count; ++probe) {
            const double* place = positions + 3 * probe;
            glBindFramebuffer(GL_FRAMEBUFFER, target_);
            for (int i = 0; i <= plan_.output_count; ++i) {
                glClearBufferfv(GL_COLOR, i, plan_.clears + 4 * i);
            }
            glClearBufferfv(GL_DEPTH, 0, &depth);
            const GLfloat eye[3] = {static_cast<float>(place[0]), static_cast<float>(place[1]),
                                    static_cast<float>(place[2])};
            glUniform3fv(eye_, 1, eye);
            for (int face = 0; face < 6; ++face) draw_face(face, place);
            if (resolved_ != 0) {
                glBlitNamedFramebuffer(target_, resolved_, 0, 0, n, 6 * n, 0, 0, n, 6 * n,
                                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
                glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
            }
            for (int i = 0; i <= plan_.output_count; ++i) read(i, probe, results[i]);
        }
        check(glGetError() == GL_NO_ERROR, "an OpenGL call failed");
    }

private:
    void make_context() {
        check(gladLoaderLoadEGL(nullptr) != 0, "no libEGL");
        const auto get_display = reinterpret_cast<EGLDisplay (*)(EGLenum, void*, const EGLint*)>(
            eglGetProcAddress("eglGetPlatformDisplayEXT"));
        check(get_display != nullptr, "no eglGetPlatformDisplayEXT");
        EGLDisplay display =
            get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        check(eglInitialize(display, nullptr, nullptr) == EGL_TRUE, "eglInitialize failed");
        check(gladLoaderLoadEGL(display) != 0, "no EGL");
        eglBindAPI(EGL_OPENGL_API);
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint found = 0;
        eglChooseConfig(display, wanted, &config, 1, &found);
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
        check(context != EGL_NO_CONTEXT, "eglCreateContext failed");
        check(eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE,
              "eglMakeCurrent failed");
        check(gladLoaderLoadGL() != 0, "no OpenGL");
    }

    static GLuint shader(GLenum kind, const char* source) {
        const GLuint id = glCreateShader(kind);
        glShaderSource(id, 1, &source, nullptr);
        glCompileShader(id);
        GLint compiled = 0;
        glGetShaderiv(id, GL_COMPILE_STATUS, &compiled);
        check(compiled == GL_TRUE, "a shader was refused");
        return id;
    }

    void make_program() {
        const GLuint id = glCreateProgram();
        glAttachShader(id, shader(GL_VERTEX_SHADER, plan_.vertex_source));
        glAttachShader(id, shader(GL_FRAGMENT_SHADER, plan_.fragment_source));
        glBindAttribLocation(id, 0, "in_position");
        glBindAttribLocation(id, 1, "in_normal");
        glLinkProgram(id);
        GLint linked = 0;
        glGetProgramiv(id, GL_LINK_STATUS, &linked);
        check(linked == GL_TRUE, "a program was refused");
        glUseProgram(id);
        const auto at = [id](const char* name) { return glGetUniformLocation(id, name); };
        model_ = at("model");
        color_ = at("color");
        view_projection_ = at("view_projection");
        eye_ = at("eye");
        forward_ = at("forward");
        glUniform4fv(at("weights"), 1, plan_.weights);
        glUniform4fv(at("lights"), plan_.light_count, plan_.lights);
    }

    static Array make_array(const Mesh& mesh) {
        Array made;
        GLuint buffers[2];
        glCreateVertexArrays(1, &made.id);
        glCreateBuffers(2, buffers);
        glNamedBufferStorage(buffers[0], 24 * GLsizeiptr{mesh.vertex_count}, mesh.vertices, 0);
        glNamedBufferStorage(buffers[1], 4 * GLsizeiptr{mesh.index_count}, mesh.indices, 0);
        glVertexArrayVertexBuffer(made.id, 0, buffers[0], 0, 24);
        glVertexArrayElementBuffer(made.id, buffers[1]);
        for (GLuint i = 0; i < 2; ++i) {
            glEnableVertexArrayAttrib(made.id, i);
            glVertexArrayAttribFormat(made.id, i, 3, GL_FLOAT, GL_FALSE, 12 * i);
            glVertexArrayAttribBinding(made.id, i, 0);
        }
        made.count = mesh.index_count;
        return made;
    }

    GLuint make_target(int samples) {
        GLuint target = 0;
        glCreateFramebuffers(1, &target);
        std::vector<GLenum> slots;
        for (int i = 0; i <= plan_.output_count; ++i) {
            const GLenum output = i > 0 && plan_.channels[i - 1] == 1 ? GL_R32F : GL_RGBA32F;
            const GLenum format = i > 0 || plan_.float_colors != 0 ? output : GL_RGBA8;
            slots.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
            glNamedFramebufferRenderbuffer(target, slots.back(), GL_RENDERBUFFER,
                                           storage(format, samples));
        }
        glNamedFramebufferRenderbuffer(target, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                       storage(GL_DEPTH_COMPONENT24, samples));
        glNamedFramebufferDrawBuffers(target, static_cast<GLsizei>(slots.size()), slots.data());
        return target;
    }

    GLuint storage(GLenum format, int samples) const {
        GLuint id = 0;
        glCreateRenderbuffers(1, &id);
        glNamedRenderbufferStorageMultisample(id, samples, format, plan_.size, 6 * plan_.size);
        return id;
    }

    void draw_face(int face, const double* place) {
        glViewport(0, face * plan_.size, plan_.size, plan_.size);
        const double* turned = plan_.turned + 16 * face;
        GLfloat matrix[16];
        for (int row = 0; row < 4; ++row) {
            double moved = turned[12 + row];
            for (int i = 0; i < 3; ++i) {
                matrix[4 * i + row] = static_cast<float>(turned[4 * i + row]);
                moved -= turned[4 * i + row] * place[i];
            }
            matrix[12 + row] = static_cast<float>(moved);
        }
        glUniformMatrix4fv(view_projection_, 1, GL_FALSE, matrix);
        const double* forward = plan_.forwards + 3 * face;
        if (forward_ >= 0) {
            glUniform3f(forward_, static_cast<float>(forward[0]), static_cast<float>(forward[1]),
                        static_cast<float>(forward[2]));
        }
        glBindVertexArray(mesh_.id);
        for (int node = 0; node < plan_.nodes; ++node) {
            double ahead = 0.0;
            double away[3];
            for (int i = 0; i < 3; ++i) {
                away[i] = plan_.places[3 * node + i] - place[i];
                ahead += forward[i] * away[i];
            }
            double beside = 0.0;
            for (int i = 0; i < 3; ++i) {
                if (forward[i] == 0.0) beside = std::fmax(beside, std::fabs(away[i]));
            }
            if (beside - ahead > plan_.reach) continue;
            one(plan_.models + 16 * node, plan_.colors + 3 * node, mesh_);
        }
        constexpr GLfloat unmoved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        if (face == 2 || plan_.nodes == 0) return;  // the ground is below all places
        glBindVertexArray(ground_.id);
        one(unmoved, plan_.colors + 3 * plan_.nodes, ground_);
    }

    void one(const GLfloat* model, const GLfloat* color, const Array& array) {
        glUniformMatrix4fv(model_, 1, GL_FALSE, model);
        glUniform3fv(color_, 1, color);
        glDrawElements(GL_TRIANGLES, array.count, GL_UNSIGNED_INT, nullptr);
    }

    void read(int slot, int probe, void* result) {
        const int n = plan_.size;
        const int channels = slot == 0 ? 4 : plan_.channels[slot - 1];
        const bool bytes = slot == 0 && plan_.float_colors == 0;
        const GLenum format = channels == 4 ? GL_RGBA : channels == 3 ? GL_RGB : GL_RED;
        const std::size_t size = std::size_t{6} * static_cast<std::size_t>(n * n * channels) *
                                 (bytes ? 1 : sizeof(float));
        glReadBuffer(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot));
        glReadPixels(0, 0, n, 6 * n, format, bytes ? GL_UNSIGNED_BYTE : GL_FLOAT,
                     static_cast<char*>(result) + static_cast<std::size_t>(probe) * size);
    }

    const Plan plan_;
    Array mesh_, ground_;
    GLuint target_ = 0, resolved_ = 0;
    GLint model_ = -1, color_ = -1, view_projection_ = -1, eye_ = -1, forward_ = -1;
};

}  // namespace

/// null if it fails; the arrays of `plan` must stay.
extern "C" void* floor_make(const Plan* plan) {
    try {
        return new Floor(*plan);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return nullptr;
    }
}

/// 0 if it fails.
extern "C" int floor_draw(void* made, std::int32_t count, const double* positions,
                          void* const* results) {
    try {
        static_cast<Floor*>(made)->draw(count, positions, results);
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 0;
    }
}
