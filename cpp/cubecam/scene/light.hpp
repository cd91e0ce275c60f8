#pragma once

#include "cubecam/scene/versioned.hpp"

#include <glm/glm.hpp>

#include <variant>

namespace cubecam {

struct PointParameters {
    glm::dvec3 position{0.0};
    double decay = 0.0;  ///< light falls with distance^-decay; 0: not at all, 2: as physics has it

    bool operator==(const PointParameters&) const = default;
};

struct DirectionalParameters {
    glm::dvec3 direction{0.0, -1.0, 0.0};  ///< the way the light travels, unit length

    bool operator==(const DirectionalParameters&) const = default;
};

struct AmbientParameters {
    bool operator==(const AmbientParameters&) const = default;
};

using LightParameters = std::variant<PointParameters, DirectionalParameters, AmbientParameters>;

struct LightValue {
    LightParameters parameters;
    glm::vec3 color{1.0F};  ///< linear RGB
    float intensity = 1.0F;

    bool operator==(const LightValue&) const = default;
};

/// Throws std::invalid_argument for a value that is not finite, negative light or a direction of no
/// length; normalises the direction.
void check(LightValue& value);

class Light {
public:
    explicit Light(LightValue value);
    virtual ~Light() = default;
    Light(const Light&) = delete;
    Light& operator=(const Light&) = delete;

    LightValue value() const { return value_.value(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](LightValue& value) {
            change(value);
            check(value);
        });
    }

private:
    Versioned<LightValue> value_;
};

/// One class per kind, as for materials.
template <class Parameters>
class LightOf : public Light {
public:
    explicit LightOf(Parameters parameters = {}, glm::vec3 color = glm::vec3(1.0F),
                     float intensity = 1.0F)
        : Light({parameters, color, intensity}) {}

    Parameters parameters() const { return std::get<Parameters>(value().parameters); }

    template <class Change>
    void edit_parameters(Change&& change) {
        edit([&](LightValue& value) { change(std::get<Parameters>(value.parameters)); });
    }
};

using PointLight = LightOf<PointParameters>;
using DirectionalLight = LightOf<DirectionalParameters>;
using AmbientLight = LightOf<AmbientParameters>;

}  // namespace cubecam
