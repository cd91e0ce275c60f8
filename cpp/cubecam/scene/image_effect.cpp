#include "cubecam/scene/image_effect.hpp"

#include "cubecam/core/checks.hpp"

#include <utility>
#include <variant>

namespace cubecam {

void check(const EffectValue& value) {
    expect(mentions(value.fragment.text, "effect"),
           "a fragment with a function vec4 effect(vec2 uv), or vec3 to keep the alpha",
           value.fragment.text.empty() ? "an empty one" : "one without the word effect");
    check(value.inputs);
    for (const auto& [name, source] : value.inputs.textures) {
        const auto* cube = std::get_if<CubeSource>(&source);
        expect(cube == nullptr || !std::holds_alternative<std::shared_ptr<Probe>>(*cube),
               "textures of an effect that are Images, RenderTextures or CubeMaps",
               "a Probe for " + name);
    }
}

ImageEffect::ImageEffect(EffectValue value) : value_((cubecam::check(value), std::move(value))) {}

}  // namespace cubecam
