#include "cubecam/render/passes/draw_conditions.hpp"

#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/trial/capture.hpp"

#include <cstddef>

namespace cubecam {

void DrawConditions::add_textures(std::span<const BoundTexture> own) {
    GLuint unit = texture_unit::first_of_material;
    for (const BoundTexture& texture : own) {
        textures.push_back({unit++, texture.texture, texture.revision});
    }
}

void DrawConditions::add_target(const TargetDescription& target, bool color, bool outputs,
                                bool layered) {
    add(color);
    add(outputs);
    add(layered);
    add(target.shape.kind);
    add(target.samples);
    add(target.format);
    add(target.post_processed);
    add(target.color);
    add(target.depth_format);
    add(target.depth_order);
    for (const ShadedOutput& output : target.outputs.by_slot()) {
        add(output.channels);
        add(output.type);
    }
}

void DrawConditions::add_node(const NodeSnapshot& node) {
    const SurfaceOptions& surface = node.material.value.surface;
    add(node.blend);
    if (node.blend == Blend::factors) {
        const BlendFactors& factors = surface.blend_factors;
        add(factors.src);
        add(factors.dst);
        add(factors.src_alpha);
        add(factors.dst_alpha);
        add(factors.equation);
    }
    add(surface.depth_test);
    add(node.depth_write);
    for (int i = 0; i < 4; ++i) add(surface.color_write[i]);
    add(surface.stencil.has_value());
    if (surface.stencil) {
        const Stencil& stencil = *surface.stencil;
        add(stencil.func);
        add(stencil.reference);
        add(stencil.read_mask);
        add(stencil.write_mask);
        add(stencil.fail);
        add(stencil.depth_fail);
        add(stencil.depth_pass);
    }
    const MeshData& mesh = *node.mesh;
    add(mesh.normals() != nullptr);
    add(mesh.uvs() != nullptr);
    add(mesh.uvs1() != nullptr);
    add(mesh.colors() != nullptr);
    add(mesh.tangents() != nullptr);
}

const trial::Texture& TextureKinds::find(const GladGLContext& gl, const UnitTexture& texture) {
    constexpr std::size_t most = 4096;
    if (known_.size() >= most) known_.clear();
    Known& known = known_[texture.texture];
    if (known.revision == 0 || known.revision != texture.revision) {
        known = {texture.revision, trial::capture_texture(gl, texture.unit, texture.texture)};
    }
    known.kind.unit = texture.unit;
    return known.kind;
}

}  // namespace cubecam
