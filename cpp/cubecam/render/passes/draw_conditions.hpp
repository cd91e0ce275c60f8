#pragma once

#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/scene/snapshot.hpp"
#include "cubecam/trial/job.hpp"

#include <glad/gl.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace cubecam {

/// A texture in its unit.
struct UnitTexture {
    GLuint unit;
    GLuint texture;
    std::uint64_t revision;  ///< 0: it may be another one under the same name
};

/// What a driver's machine code for a draw call depends on besides the program: llvmpipe compiles a
/// program again for other formats, samples, blending, tests, attributes and samplers. A user's
/// source is tried in each state before this process draws with it (docs/adr/0023).
///
/// `key` holds everything that cubecam varies: with equal keys OpenGL is in the same state, as far
/// as machine code is concerned. Making it costs less than a microsecond, so that a draw call whose
/// conditions are known costs nothing more; OpenGL itself is only asked when the key is new.
struct DrawConditions {
    std::string key;
    std::vector<UnitTexture> textures;

    void clear() {
        key.clear();
        textures.clear();
    }
    template <class Value>
    void add(const Value& value) {
        static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
        char bytes[sizeof(Value)];
        std::memcpy(bytes, &value, sizeof(Value));
        key.append(bytes, sizeof(Value));
    }
    /// The user's textures, in the units from `texture_unit::first_of_material` on.
    void add_textures(std::span<const BoundTexture> own);
    /// The parts of a pass: `color` and `outputs` say what is written.
    void add_target(const TargetDescription& target, bool color, bool outputs, bool layered);
    /// The parts of a node: blending, tests, the streams of its mesh.
    void add_node(const NodeSnapshot& node);
};

/// What captures of textures found, so that a texture that is known is not asked again.
class TextureKinds {
public:
    const trial::Texture& find(const GladGLContext& gl, const UnitTexture& texture);

private:
    struct Known {
        std::uint64_t revision;
        trial::Texture kind;
    };
    std::unordered_map<GLuint, Known> known_;
};

}  // namespace cubecam
