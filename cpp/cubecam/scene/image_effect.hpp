#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/materials/user_shader.hpp"

namespace cubecam {

/// A user's GLSL, `vec4 effect(vec2 uv)`, which runs for every pixel of a finished picture.
struct EffectValue {
    UserSource fragment;
    ShaderInputs inputs;

    bool operator==(const EffectValue&) const = default;
};

/// Throws std::invalid_argument for a source without the function, or for a probe: a probe belongs
/// to a scene, but an effect does not.
void check(const EffectValue& value);

/// A pass over a frame. Any number of calls may share an effect; setters are thread-safe and check
/// their values.
class ImageEffect {
public:
    using State = Versioned<EffectValue>::State;

    explicit ImageEffect(EffectValue value);
    ImageEffect(const ImageEffect&) = delete;
    ImageEffect& operator=(const ImageEffect&) = delete;

    State state() const { return value_.state(); }
    EffectValue value() const { return value_.value(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](EffectValue& value) {
            change(value);
            check(value);
        });
    }

private:
    Versioned<EffectValue> value_;
};

}  // namespace cubecam
