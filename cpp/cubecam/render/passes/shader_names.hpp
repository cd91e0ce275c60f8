#pragma once

#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/render/passes/user_text.hpp"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam {

/// The names that shaders/ declares in the programs into which a user's text goes.
struct ShaderNames {
    std::set<std::string, std::less<>> macros;
    std::set<std::string, std::less<>> variables;  ///< also members of blocks
    std::set<std::string, std::less<>> functions;
    std::set<std::string, std::less<>> blocks;
    std::vector<gl::GlslStructure> structures;
};

/// The names for a stage, in all variants of its program.
const ShaderNames& shader_names(UserStage stage);

/// Whether a name of shaders/ is one that the documentation lets users' sources call or use.
bool is_documented(std::string_view name);

}  // namespace cubecam
