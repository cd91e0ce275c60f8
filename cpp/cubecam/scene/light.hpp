#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/scene/shadow.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <glm/glm.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace cubecam {

inline constexpr double no_range = std::numeric_limits<double>::infinity();

struct PointParameters {
    glm::dvec3 position{0.0};
    double decay = 0.0;       ///< light falls with distance^-decay; 0: constant, 2: as in physics
    double range = no_range;  ///< no light reaches farther, world units

    bool operator==(const PointParameters&) const = default;
};

struct DirectionalParameters {
    glm::dvec3 direction{0.0, -1.0, 0.0};  ///< the direction in which light travels, unit length

    bool operator==(const DirectionalParameters&) const = default;
};

struct AmbientParameters {
    bool operator==(const AmbientParameters&) const = default;
};

/// A point light that shines into a cone, as in three.js and glTF's KHR_lights_punctual, which
/// gives cosines instead of angles.
struct SpotParameters {
    glm::dvec3 position{0.0};
    glm::dvec3 direction{0.0, -1.0, 0.0};  ///< of the cone's axis, in which light travels
    double angle = 30.0;                   ///< from the axis to the cone's edge, degrees
    double penumbra = 0.0;    ///< share of the angle, from the edge inwards, over which light fades
    double decay = 0.0;       ///< see PointParameters::decay
    double range = no_range;  ///< see PointParameters::range

    bool operator==(const SpotParameters&) const = default;
};

using LightParameters =
    std::variant<PointParameters, DirectionalParameters, AmbientParameters, SpotParameters>;

struct LightValue {
    LightParameters parameters;
    glm::vec3 color{1.0F};  ///< linear RGB
    float intensity = 1.0F;
    std::optional<Shadow> shadow;  ///< none: the light shines through everything
    /// Position and direction are in the parent's coordinates; none: in the world's.
    std::weak_ptr<Node> parent{};

    bool operator==(const LightValue& other) const {
        return parameters == other.parameters && color == other.color &&
               intensity == other.intensity && shadow == other.shadow &&
               same_node(parent, other.parent);
    }
};

/// Moves position and direction from the coordinates of a node to the world's. A scale changes
/// neither the light's strength nor its range.
LightParameters transformed(LightParameters parameters, const glm::dmat4& world);

/// Normalises the direction. Throws std::invalid_argument for a value that is not finite or out of
/// its range, for negative light, a direction of length 0 or an ambient light with a shadow.
void check(LightValue& value);

class Light {
public:
    explicit Light(LightValue value);
    virtual ~Light() = default;
    Light(const Light&) = delete;
    Light& operator=(const Light&) = delete;

    using State = Versioned<LightValue>::State;

    State state() const { return value_.state(); }
    /// The light as it was set: relative to its parent if it has one.
    LightValue value() const { return value_.value(); }
    /// The parameters in the world at this moment. Locks the parent's scene.
    LightParameters world_parameters() const;
    const Revision& revision() const { return value_.revision(); }

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

/// Each kind has a class of its own, as materials do.
template <class Parameters>
class LightOf : public Light {
public:
    explicit LightOf(Parameters parameters = {}, glm::vec3 color = glm::vec3(1.0F),
                     float intensity = 1.0F, std::optional<Shadow> shadow = std::nullopt)
        : Light({parameters, color, intensity, std::move(shadow), {}}) {}

    Parameters parameters() const { return std::get<Parameters>(value().parameters); }

    template <class Change>
    void edit_parameters(Change&& change) {
        edit([&](LightValue& value) { change(std::get<Parameters>(value.parameters)); });
    }
};

using PointLight = LightOf<PointParameters>;
using DirectionalLight = LightOf<DirectionalParameters>;
using AmbientLight = LightOf<AmbientParameters>;
using SpotLight = LightOf<SpotParameters>;

}  // namespace cubecam
