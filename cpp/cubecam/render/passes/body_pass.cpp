#include "cubecam/render/passes/body_pass.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/math/cube_face.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/resources/sampler.hpp"
#include "cubecam/render/resources/view_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cubecam {

namespace {

constexpr int bordered = body_size + 2;

/// Half of the extent; that of a flat mesh is no 0, by which shaders divide.
glm::vec3 half_extent(const Bounds& bounds) {
    const glm::dvec3 half = 0.5 * bounds.extent();
    const double largest = std::max({half.x, half.y, half.z});
    return glm::vec3(largest > 0.0 ? glm::max(half, 1e-6 * largest) : glm::dvec3(1.0));
}

}  // namespace

double winding_number(const MeshData& mesh, const glm::dvec3& point) {
    const std::vector<glm::vec3>& positions = *mesh.positions();
    double sum = 0.0;
    for (const glm::uvec3& triangle : *mesh.triangles()) {
        const glm::dvec3 a = glm::dvec3(positions[triangle.x]) - point;
        const glm::dvec3 b = glm::dvec3(positions[triangle.y]) - point;
        const glm::dvec3 c = glm::dvec3(positions[triangle.z]) - point;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        sum += std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                             glm::dot(a, c) * lb +
                                                             glm::dot(b, c) * la);
    }
    return 2.0 * sum / (4.0 * std::numbers::pi);
}

BodyPass::BodyPass(const gl::Context& context, GpuCache& cache, Programs& programs)
    : context_(&context), cache_(&cache), programs_(&programs) {}

BodyPass::Body BodyPass::make() const {
    const GladGLContext& gl = context_->gl();
    Body body;
    body.nearness = gl::create_texture_2d(gl, GL_RG32F, body_width, body_height);
    body.normals = gl::create_texture_2d_array(gl, GL_RGBA16F, body_width, body_height, 2);
    set_sampler(gl, body.nearness.id(), clamped_linear);
    set_sampler(gl, body.normals.id(), clamped_linear);
    body.lookup.nearness = body.nearness.id();
    body.lookup.normals = body.normals.id();
    return body;
}

BodyLookup BodyPass::get(const MeshData& mesh, Stats& stats) {
    Body& body = bodies_.get(mesh.identity(), [this] { return make(); });
    if (body.positions_revision == mesh.position_stream().revision &&
        body.normals_revision == mesh.normal_stream().revision) {
        return body.lookup;
    }
    // A look for interrupts may end the drawing in its middle.
    body.positions_revision = 0;
    const glm::dvec3 middle = mesh.bounds().center();
    body.lookup.middle = glm::vec3(middle);
    body.lookup.half = half_extent(mesh.bounds());
    body.lookup.outside = winding_number(mesh, middle) < 0.5;
    draw(mesh, body, stats);
    body.positions_revision = mesh.position_stream().revision;
    body.normals_revision = mesh.normal_stream().revision;
    return body.lookup;
}

void BodyPass::close_rim(const Body& body, Stats& stats) {
    const GladGLContext& gl = context_->gl();
    gl.NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, body.nearness.id(), 0);
    gl.Viewport(0, 0, body_width, body_height);
    gl.Scissor(0, 0, body_width, body_height);
    set_full_screen_state(gl);
    gl.ColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.BindTextureUnit(0, open_.id());
    programs_->body_rim().use();
    draw_full_screen(gl, *cache_, {}, stats);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void BodyPass::draw(const MeshData& mesh, const Body& body, Stats& stats) {
    const GladGLContext& gl = context_->gl();
    if (!framebuffer_) {
        depth_ = gl::create_texture_2d(gl, GL_DEPTH_COMPONENT32F, body_width, body_height);
        framebuffer_ = gl::create_framebuffer(gl);
        gl.NamedFramebufferTexture(framebuffer_.id(), GL_DEPTH_ATTACHMENT, depth_.id(), 0);
        constexpr std::array<GLenum, 2> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        gl.NamedFramebufferDrawBuffers(framebuffer_.id(), 2, outputs.data());
        record_ = gl::create_buffer(gl, sizeof(ViewRecord));
    }
    const bool outside = body.lookup.outside;
    if (outside && !open_) open_ = gl::create_texture_2d(gl, GL_RG32F, body_width, body_height);
    const GLuint drawn = outside ? open_.id() : body.nearness.id();
    gl.NamedFramebufferTexture(framebuffer_.id(), GL_COLOR_ATTACHMENT0, drawn, 0);
    const GpuMesh& gpu_mesh = cache_->mesh(mesh);
    const GLuint array = gpu_mesh.array.id();
    gl.VertexArrayVertexBuffer(array, vertex_buffer::records, record_.id(), 0, sizeof(ViewRecord));
    gl.BindVertexArray(array);

    const gl::Program& program = programs_->body();
    program.use();
    program.set("u_edge", static_cast<float>(body_size) / static_cast<float>(bordered));
    program.set("u_body_middle", body.lookup.middle);
    program.set("u_body_half", body.lookup.half);

    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl.Enable(GL_SCISSOR_TEST);
    gl.Enable(GL_DEPTH_TEST);
    gl.Enable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_STENCIL_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.DepthMask(GL_TRUE);
    gl.FrontFace(GL_CCW);
    constexpr std::array<float, 4> nothing{};
    for (int side = 0; side < (outside ? 2 : 1); ++side) {
        gl.NamedFramebufferTextureLayer(framebuffer_.id(), GL_COLOR_ATTACHMENT1, body.normals.id(),
                                        0, side);
        if (side == 0) gl::check_framebuffer(gl, framebuffer_, "drawing the inside of a body");
        gl.Scissor(0, 0, body_width, body_height);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        if (side == 0) gl.ClearBufferfv(GL_COLOR, 0, nothing.data());
        gl.ClearBufferfv(GL_COLOR, 1, nothing.data());
        gl.ClearBufferfv(GL_DEPTH, 0, nothing.data());
        gl.CullFace(side == 0 ? GL_FRONT : GL_BACK);
        gl.ColorMaski(0, side == 0 ? GL_TRUE : GL_FALSE, side == 0 ? GL_FALSE : GL_TRUE, GL_FALSE,
                      GL_FALSE);
        for (int face = 0; face < face_count; ++face) {
            poll_interrupts();
            const int x = face / 2 * bordered;
            const int y = face % 2 * bordered;
            gl.Viewport(x, y, bordered, bordered);
            gl.Scissor(x, y, bordered, bordered);
            program.set("u_face", face);
            gl.DrawElements(GL_TRIANGLES, gpu_mesh.index_count, gpu_mesh.index_type, nullptr);
            ++stats.draw_calls;
            stats.triangles += gpu_mesh.index_count / 3;
        }
        context_->pace().submitted(gl, static_cast<double>(body_width) * body_height);
    }
    gl.CullFace(GL_BACK);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (outside) close_rim(body, stats);
    gl::check_gl(gl, "drawing the inside of a body");
}

}  // namespace cubecam
