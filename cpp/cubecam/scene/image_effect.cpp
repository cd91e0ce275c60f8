#include "cubecam/scene/image_effect.hpp"

#include "cubecam/scene/describe.hpp"

#include <utility>
#include <variant>

namespace cubecam {

void check(const EffectValue& value) {
    expect(mentions(value.fragment.text, "effect"),
           "a fragment with a function vec4 effect(vec2 uv), or vec3 to keep the alpha",
           value.fragment.text.empty() ? "an empty one" : "one without the word effect");
    check(value.inputs);
    for (const auto& [name, source] : value.inputs.textures) {
        expect(!std::holds_alternative<std::shared_ptr<Probe>>(source),
               "textures of an effect that are Images or CubeMaps", "a Probe for " + name);
    }
}

ImageEffect::ImageEffect(EffectValue value) : value_((cubecam::check(value), std::move(value))) {}

EffectSnapshot ImageEffect::snapshot() const {
    auto state = value_.state();
    std::vector<FrozenTexture> textures;
    for (const auto& [name, source] : state.value.inputs.textures) {
        if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
            textures.emplace_back(*image);
        } else {
            const auto& cube = std::get<std::shared_ptr<CubeMap>>(source);
            textures.emplace_back(FrozenSource(FrozenCube{cube, cube->data()}));
        }
    }
    return {std::move(state.value), state.revision, std::move(textures)};
}

}  // namespace cubecam
