#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/materials/blend.hpp"
#include "cubecam/materials/model.hpp"
#include "cubecam/materials/stencil.hpp"

#include <glm/glm.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace cubecam {

/// The options that every material has.
struct SurfaceOptions {
    float opacity = 1.0F;  ///< 0..1, times the colour's alpha
    bool double_sided = false;
    std::optional<Blend> blend;       ///< none: alpha if anything is translucent, else opaque
    BlendFactors blend_factors;       ///< if blend is Blend::factors
    std::optional<bool> depth_write;  ///< none: opaque surfaces write depth
    bool depth_test = true;           ///< nearer surfaces hide it
    glm::bvec4 color_write{true};     ///< channels of the colour that are written
    std::optional<Stencil> stencil;   ///< none: neither tested nor written
    bool flat_shading = false;        ///< shows each triangle with the normal of its plane

    bool operator==(const SurfaceOptions&) const = default;
};

struct MaterialValue {
    std::shared_ptr<const MaterialModel> model;  ///< never null
    SurfaceOptions surface;

    const MaterialTraits& traits() const { return model->traits(); }

    bool operator==(const MaterialValue& other) const {
        return surface == other.surface && (model == other.model || model->equals(*other.model));
    }
};

/// Throws std::invalid_argument for an option that is out of its range or not finite.
void check(const MaterialValue& value);

/// How a surface reflects light. Any number of nodes may share a material; setters are thread-safe
/// and check their values.
class Material {
public:
    using State = Versioned<MaterialValue>::State;

    explicit Material(MaterialValue value);
    virtual ~Material() = default;
    Material(const Material&) = delete;
    Material& operator=(const Material&) = delete;

    State state() const { return value_.state(); }
    MaterialValue value() const { return value_.value(); }
    const Revision& revision() const { return value_.revision(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](MaterialValue& value) {
            change(value);
            check(value);
        });
    }

    /// A name for people. It is no part of the value, since no picture depends on it.
    std::string name() const;
    void set_name(std::string name);

private:
    Versioned<MaterialValue> value_;
    mutable std::mutex name_guard_;
    std::string name_;
};

/// Each kind has a class of its own, so that C++ and Python users can name it.
template <class Kind>
class MaterialOf : public Material {
public:
    explicit MaterialOf(Kind kind = {}, SurfaceOptions surface = {})
        : Material({std::make_shared<const MaterialModelOf<Kind>>(std::move(kind)), surface}) {}

    Kind kind() const {
        const MaterialValue now = value();
        return kind_of(now);
    }

    template <class Change>
    void edit_kind(Change&& change) {
        edit([&](MaterialValue& value) {
            Kind kind = kind_of(value);
            change(kind);
            value.model = std::make_shared<const MaterialModelOf<Kind>>(std::move(kind));
        });
    }

private:
    static const Kind& kind_of(const MaterialValue& value) {
        return static_cast<const MaterialModelOf<Kind>&>(*value.model).kind();
    }
};

/// Whether the material alone makes a surface translucent. Its maps and the mesh's colours may also
/// do so.
bool translucent(const MaterialValue& value);

}  // namespace cubecam
