#include "cubecam/render/passes/shadow_pass.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/large_texture.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/gl/texture_memory.hpp"
#include "cubecam/image/flip.hpp"
#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/render/resources/node_record.hpp"
#include "cubecam/render/resources/sampler.hpp"
#include "cubecam/render/resources/view_record.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {
namespace {

constexpr GLenum map_format = GL_DEPTH_COMPONENT32F;
constexpr DepthState depth_test = depth_state(DepthOrder::nearest);
constexpr float nothing = depth_test.clear;

/// The uniform block `Mask` of shaders/include/mask.glsl, std140.
struct MaskBlock {
    glm::vec4 rows[2];  ///< of the matrix that places the map
    glm::vec4 numbers;  ///< x: factor, y: cutoff
};

MaskBlock make_mask_block(const AlphaMask& mask, const MapPlacing& placing) {
    const glm::mat3x2 columns = matrix(placing);
    MaskBlock block{};
    for (int row = 0; row < 2; ++row) {
        block.rows[row] = glm::vec4(columns[0][row], columns[1][row], columns[2][row], 0.0F);
    }
    block.numbers = glm::vec4(mask.factor, mask.cutoff, 0.0F, 0.0F);
    return block;
}

/// The casters that one call draws: nodes of one mesh, which differ only in their matrices. Those
/// with holes also have one material. A node of which the map shows a part is alone.
struct Casters {
    const NodeSnapshot* first;
    const GpuMesh* mesh;
    std::optional<IndexRange> indices;  ///< none: those of the whole mesh
    std::vector<ViewRecord> nodes;
};

}  // namespace

ShadowPass::ShadowPass(const gl::Context& context, GpuCache& cache, Programs& programs)
    : context_(&context), gl_(&context.gl()), cache_(&cache), programs_(&programs), picker_(cache) {
    largest_ = gl::largest_side(context.limits(), false).pixels;
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
    check_texture_memory(*context_, bytes, 0.0, what);
    ShadowMap map;
    map.depth = gl::make_large_texture(*context_, static_cast<double>(size) * size * count,
                                       [size, count](const GladGLContext& gl) {
                                           return gl::create_texture_2d_array(gl, map_format, size,
                                                                              size, count);
                                       });
    const GLuint id = map.depth.id();
    set_sampler(*gl_, id, clamped_nearest);
    map.layers.emplace(*gl_, std::vector<Layers::Attachment>{{GL_DEPTH_ATTACHMENT, id}}, count);
    map.size = size;
    return map;
}

void ShadowPass::draw(const ShadowInput& input, std::size_t layer, ShadowMap& map, Stats& stats) {
    std::vector<Casters> casters;  // in the order of their first nodes
    std::map<std::pair<const MeshData*, std::uint64_t>, std::size_t> places;
    std::vector<const NodeSnapshot*> moved;
    const View& from = input.view.views[layer];
    picker_.start();
    input.plan.for_each([&](const PlannedNode& planned) {
        const auto visibilities = input.plan.visible_in(planned);
        const bool seen =
            std::any_of(visibilities.begin(), visibilities.end(),
                        [layer](const Visibility& visibility) { return visibility.view == layer; });
        if (!seen) return;
        const NodeSnapshot& node = input.scene.nodes[planned.node];
        if (moves_vertices(node)) {
            moved.push_back(&node);
            return;
        }
        const GpuMesh& mesh = cache_->mesh(*node.mesh);
        const std::optional<IndexRange> indices = picker_.pick(
            node, *node.mesh, mesh, from, {0, 0, map.size, map.size}, {map.size, map.size});
        std::size_t place = casters.size();
        if (!indices) {
            const std::uint64_t material = has_holes(node) ? node.material.revision : 0;
            place = places.try_emplace({node.mesh.get(), material}, place).first->second;
        }
        if (place == casters.size()) casters.push_back({&node, &mesh, indices, {}});
        const glm::dmat4 matrix = reverse_depth(from.view_projection * node.world);
        casters[place].nodes.push_back(make_view_record(from, matrix, from.position, layer));
    });
    std::vector<ViewRecord> instances;
    for (const Casters& some : casters) {
        instances.insert(instances.end(), some.nodes.begin(), some.nodes.end());
    }
    instances_ = gl::create_buffer(*gl_, instances.size() * sizeof(ViewRecord), instances.data());
    if (!picker_.bytes().empty()) indices_ = gl::create_buffer(*gl_, std::span(picker_.bytes()));

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
    GLuint first = 0;
    for (const Casters& some : casters) {
        poll_interrupts();
        const GpuMesh& mesh = *some.mesh;
        const auto count = static_cast<GLsizei>(some.nodes.size());
        const IndexRange indices = some.indices.value_or(IndexRange{0, mesh.index_count});
        first += static_cast<GLuint>(count);
        stats.triangles_skipped += std::int64_t{(mesh.index_count - indices.count) / 3} * count;
        if (indices.count == 0) continue;
        bind_program(*some.first, input);
        gl_->VertexArrayVertexBuffer(mesh.array.id(), vertex_buffer::records, instances_.id(), 0,
                                     sizeof(ViewRecord));
        gl_->BindVertexArray(mesh.array.id());
        if (some.indices) gl_->VertexArrayElementBuffer(mesh.array.id(), indices_.id());
        gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, indices.count, mesh.index_type,
                                               reinterpret_cast<const void*>(indices.offset), count,
                                               first - static_cast<GLuint>(count));
        if (some.indices) gl_->VertexArrayElementBuffer(mesh.array.id(), mesh.indices.id());
        ++stats.draw_calls;
        stats.triangles += std::int64_t{indices.count / 3} * count;
    }
    for (const NodeSnapshot* node : moved) draw_moved(*node, input, layer, stats);
    context_->pace().submitted(*gl_, static_cast<double>(map.size) * map.size);
}

void ShadowPass::bind_program(const NodeSnapshot& node, const ShadowInput& input) {
    if (!has_holes(node)) return programs_->shadow({}).use();
    const MaterialTraits& traits = node.material.value.traits();
    const std::optional<std::size_t> map = mask_texture(node);
    ShadowVariant variant;
    variant.holes = true;
    variant.map = map.has_value();
    variant.vertex_colors =
        traits.vertex_colors != VertexColors::ignored && node.mesh->colors() != nullptr;
    MapPlacing placing;
    if (map) {
        const NamedTexture& texture = traits.textures[*map];
        if (texture.placing != nullptr) placing = *texture.placing;
        variant.second_uvs = uv_set_of(texture) == 1;
        gl_->BindTextureUnit(texture_unit::first_of_material, input.look_up(node)[*map].texture);
    }
    const MaskBlock block = make_mask_block(*traits.alpha_mask, placing);
    block_ = gl::create_buffer(*gl_, sizeof(block), &block);
    gl_->BindBufferBase(GL_UNIFORM_BUFFER, material_binding, block_.id());
    programs_->shadow(variant).use();
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
    const GpuMesh& mesh = cache_->mesh(*node.mesh);
    gl_->VertexArrayVertexBuffer(mesh.array.id(), vertex_buffer::records, instances_.id(), 0,
                                 sizeof(ViewRecord));
    gl_->BindVertexArray(mesh.array.id());
    const std::vector<BoundTexture> textures = input.look_up(node);
    const auto own = std::span(textures).subspan(material.user_code->first_texture);
    DrawConditions conditions;
    if (programs_->tries()) {
        conditions.add_node(node);
        conditions.add_textures(own);
    }
    UserProgram& program =
        programs_->user_shadow(material, node.mesh->colors() != nullptr, conditions);
    // llvmpipe runs vertex shaders at once, although it may still be drawing what they look up.
    if (context_->software() && vertices_see_pictures(node)) gl_->Finish();
    program.use(*material.user_code->inputs, own);
    program.program().use();
    gl_->DrawElementsInstancedBaseInstance(GL_TRIANGLES, mesh.index_count, mesh.index_type, nullptr,
                                           1, 0);
    ++stats.draw_calls;
    stats.triangles += mesh.index_count / 3;
}

Buffer<float> ShadowPass::read(const ShadowUse& use) {
    const auto size = static_cast<std::size_t>(use.shadow.size);
    Buffer<float> values(use.view.views.size() * size * size);
    context_->pace().finish(*gl_);
    for (std::size_t layer = 0; layer < use.view.views.size(); ++layer) {
        poll_interrupts();
        gl::read_layer(*gl_, use.texture, static_cast<int>(layer), use.shadow.size, use.shadow.size,
                       GL_DEPTH_COMPONENT, GL_FLOAT, sizeof(float),
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
