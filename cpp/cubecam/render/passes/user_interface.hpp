#pragma once

#include "cubecam/gl/handle.hpp"
#include "cubecam/render/passes/user_text.hpp"

#include <span>

namespace cubecam {

/// A text as its user wrote it, with plain lines.
struct WrittenText {
    UserSource source;
    UserStage stage;
};

/// Refuses the blocks, buffers and vertex attributes of a linked program that shaders/ does not
/// declare: macros can hide declarations from check_user_text(). `texts` are those of the program.
/// @throws ShaderError
void check_interface(const GladGLContext& gl, GLuint program, std::span<const WrittenText> texts);

}  // namespace cubecam
