#include "cubecam/render/passes/shadow_pass.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/image/flip.hpp"
#include "cubecam/render/resources/node_record.hpp"
#include "cubecam/render/resources/view_record.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

constexpr GLenum map_format = GL_DEPTH_COMPONENT32F;
constexpr DepthState depth_test = depth_state(DepthOrder::nearest);
constexpr float nothing = depth_test.clear;

}  // namespace

ShadowPass::ShadowPass(const gl::Context& context, GpuCache& cache, Programs& programs)
    : context_(&context), gl_(&context.gl()), cache_(&cache), programs_(&programs) {
    const gl::Limits& limits = context.limits();
    largest_ = std::min(
        {limits.max_texture_size, limits.max_framebuffer_width, limits.max_framebuffer_height});
    GLint units = 0;
    gl_->GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    // A surface looks up at least one texture of its own.
    most_ = std::min(max_shadows, static_cast<std::size_t>(std::max(units - 1, 0)));
}

void ShadowPass::check(const SceneSnapshot& scene) const {
    std::size_t count = 0;
    for (const LightSnapshot& light : scene.lights) {
        if (!light.value.shadow) continue;
        ++count;
        const int size = light.value.shadow->size;
        if (size > largest_) {
            throw std::invalid_argument("shadow: expected a size of at most " +
                                        std::to_string(largest_) +
                                        " texels (GL_MAX_TEXTURE_SIZE of " + context_->renderer() +
                                        "), got " + std::to_string(size));
        }
    }
    if (count > most_) {
        throw std::invalid_argument(
            "lights: expected at most " + std::to_string(most_) +
            " with a shadow (each takes one of the GL_MAX_TEXTURE_IMAGE_UNITS of " +
            context_->renderer() + "), got " + std::to_string(count));
    }
}

ShadowMap ShadowPass::make_map(int size, int count) const {
    const double bytes = 4.0 * size * size * count;
    const std::string what = "a shadow map of " + std::to_string(count) + " x " +
                             std::to_string(size) + " x " + std::to_string(size) + " texels";
    if (context_->software()) check_memory(bytes, what);
    ShadowMap map;
    map.depth = gl::create_texture_2d_array(*gl_, map_format, size, size, count);
    const GLuint id = map.depth.id();
    gl_->TextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_->TextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_->TextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_->TextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    map.layers.emplace(*gl_, std::vector<Layers::Attachment>{{GL_DEPTH_ATTACHMENT, id}}, count);
    map.size = size;
    return map;
}

void ShadowPass::draw(const ShadowInput& input, std::size_t layer, ShadowMap& map, Stats& stats) {
    // One call draws all nodes of a mesh, since casters of one mesh differ only in their matrices.
    // Meshes are in the order of their first node.
    std::vector<const MeshData*> meshes;
    std::vector<std::vector<ViewRecord>> nodes;
    std::map<const MeshData*, std::size_t> places;
    std::vector<const NodeSnapshot*> moved;
    const View& from = input.view.views[layer];
    for (const PlannedNode& planned : input.plan.opaque) {
        const auto visibilities = input.plan.visible_in(planned);
        const bool seen =
            std::any_of(visibilities.begin(), visibilities.end(),
                        [layer](const Visibility& visibility) { return visibility.view == layer; });
        if (!seen) continue;
        const NodeSnapshot& node = input.scene.nodes[planned.node];
        if (moves_vertices(node)) {
            moved.push_back(&node);
            continue;
        }
        const auto [place, added] = places.try_emplace(node.mesh.get(), meshes.size());
        if (added) {
            meshes.push_back(node.mesh.get());
            nodes.emplace_back();
        }
        const glm::dmat4 matrix = reverse_depth(from.view_projection * node.world);
        nodes[place->second].push_back(make_view_record(from, matrix, from.position, layer));
    }
    std::vector<ViewRecord> instances;
    for (const auto& of_mesh : nodes) {
        instances.insert(instances.end(), of_mesh.begin(), of_mesh.end());
    }
    instances_ = gl::create_buffer(*gl_, instances.size() * sizeof(ViewRecord), instances.data());

    gl_->BindFramebuffer(GL_FRAMEBUFFER, map.layers->one(static_cast<int>(layer)));
    gl_->Viewport(0, 0, map.size, map.size);
    gl_->Enable(GL_SCISSOR_TEST);
    gl_->Scissor(0, 0, map.size, map.size);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->DepthFunc(depth_test.closer);
    gl_->DepthMask(GL_TRUE);
    gl_->Disable(GL_BLEND);
    gl_->Disable(GL_CULL_FACE);  // a surface stops light from both sides
    gl_->ClearBufferfv(GL_DEPTH, 0, &nothing);
    if (input.view.kind == ShadowView::Kind::parallel) {
        gl_->Scissor(1, 1, map.size - 2, map.size - 2);  // see shadow_view.cpp, empty_border
    }
    programs_->shadow().use();
    GLuint first = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const GpuMesh& mesh = cache_->mesh(*meshes[m]);
        const auto count = static_cast<GLsizei>(nodes[m].size());
        gl_->VertexArrayVertexBuffer(mesh.array.id(), vertex_buffer::records, instances_.id(), 0,
                                     sizeof(ViewRecord));
        gl_->BindVertexArray(mesh.array.id());
        gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, mesh.index_count, mesh.index_type,
                                               nullptr, count, first);
        first += static_cast<GLuint>(count);
        ++stats.draw_calls;
        stats.triangles += std::int64_t{mesh.index_count / 3} * count;
    }
    for (const NodeSnapshot* node : moved) draw_moved(*node, input, layer, stats);
}

void ShadowPass::draw_moved(const NodeSnapshot& node, const ShadowInput& input, std::size_t layer,
                            Stats& stats) {
    const View& from = input.view.views[layer];
    const MaterialTraits& material = node.material.value.traits();
    const glm::dmat4 matrix = glm::translate(from.view_projection, from.position);
    const ViewRecord instance = make_view_record(from, reverse_depth(matrix), from.position, layer);
    const NodeBlock block = make_node_block(node, from.position);
    instances_ = gl::create_buffer(*gl_, sizeof(instance), &instance);
    block_ = gl::create_buffer(*gl_, sizeof(block), &block);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, node_binding, block_.id());
    UserProgram& program = programs_->user_shadow(material, node.mesh->colors() != nullptr);
    const std::vector<BoundTexture> textures = input.look_up(node);
    program.use(*material.user_code->inputs,
                std::span(textures).subspan(material.user_code->first_texture));
    program.program().use();
    const GpuMesh& mesh = cache_->mesh(*node.mesh);
    gl_->VertexArrayVertexBuffer(mesh.array.id(), vertex_buffer::records, instances_.id(), 0,
                                 sizeof(ViewRecord));
    gl_->BindVertexArray(mesh.array.id());
    gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, mesh.index_count, mesh.index_type, nullptr,
                                           1, 0);
    ++stats.draw_calls;
    stats.triangles += mesh.index_count / 3;
}

Buffer<float> ShadowPass::read(const ShadowUse& use) {
    const auto size = static_cast<std::size_t>(use.shadow.size);
    Buffer<float> values(use.view.views.size() * size * size);
    gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
    for (std::size_t layer = 0; layer < use.view.views.size(); ++layer) {
        gl_->GetTextureSubImage(use.texture, 0, 0, 0, static_cast<GLint>(layer), use.shadow.size,
                                use.shadow.size, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                                static_cast<GLsizei>(size * size * sizeof(float)),
                                values.data() + layer * size * size);
    }
    gl::check_gl(*gl_, "reading a shadow map");
    const bool parallel = use.view.kind == ShadowView::Kind::parallel;
    for (float& value : values) {
        const auto held = static_cast<double>(value);
        if (value == nothing) {
            value = std::numeric_limits<float>::infinity();
        } else if (parallel) {
            value = static_cast<float>((held - use.view.offset) / use.view.scale - use.view.near);
        } else {
            value = static_cast<float>(use.view.scale / (held - use.view.offset));
        }
    }
    if (use.view.kind == ShadowView::Kind::cube) return values;
    Buffer<float> picture(values.size());
    flip_rows(reinterpret_cast<const std::byte*>(values.data()),
              reinterpret_cast<std::byte*>(picture.data()), size * sizeof(float), size);
    return picture;
}

}  // namespace cubecam
