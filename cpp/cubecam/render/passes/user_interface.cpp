// What a linked program with a user's GLSL may not have.
#include "cubecam/render/passes/user_interface.hpp"

#include "cubecam/gl/glsl_text.hpp"
#include "cubecam/gl/program.hpp"
#include "cubecam/render/passes/output_declarations.hpp"
#include "cubecam/render/passes/shader_names.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace cubecam {

void check_interface(const GladGLContext& gl, GLuint program, std::span<const WrittenText> texts) {
    const auto refuse = [&texts](const std::string& name, const std::string& got) {
        // A macro may have made the name: then its line is not known.
        const WrittenText* from = &texts.front();
        std::size_t line = gl::GlslText(from->source.text).last_line();
        for (const WrittenText& text : texts) {
            if (const auto found = gl::line_of_word(text.source.text, name)) {
                from = &text;
                line = *found;
                break;
            }
        }
        throw gl::source_error(
            {.name = "", .text = from->source.text, .title = title_of(from->source, from->stage)},
            line, got);
    };
    const ShaderNames& names = shader_names(texts.front().stage);
    const auto check = [&](GLenum kind, const std::string& expected, const auto& is_known) {
        GLint count = 0;
        GLint longest = 0;
        gl.GetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
        gl.GetProgramInterfaceiv(program, kind, GL_MAX_NAME_LENGTH, &longest);
        for (GLint i = 0; i < count; ++i) {
            std::string name(static_cast<std::size_t>(std::max(longest, 1)), '\0');
            GLsizei length = 0;
            gl.GetProgramResourceName(program, kind, static_cast<GLuint>(i), longest, &length,
                                      name.data());
            name.resize(static_cast<std::size_t>(length));
            name = name.substr(0, name.find_first_of("[."));
            if (!is_known(name)) refuse(name, expected + name);
        }
    };
    check(GL_UNIFORM_BLOCK, "expected uniforms outside of blocks, got the block ",
          [&names](const std::string& name) {
              return names.blocks.contains(name) || name == "Mask";  // of shadow.frag
          });
    check(GL_SHADER_STORAGE_BLOCK, "expected uniforms and textures, got the buffer ",
          [](const std::string&) { return false; });
    const std::vector<NamedOutput> declared = declared_outputs(texts.front().source);
    check(GL_PROGRAM_OUTPUT, "expected outputs declared as `out vec4 name;`, without a macro, got ",
          [&](const std::string& name) {
              if (name.starts_with("gl_") || name.starts_with("o_other_")) return true;
              if (names.variables.contains(name)) return true;
              return std::any_of(
                  declared.begin(), declared.end(),
                  [&name](const NamedOutput& output) { return output.name == name; });
          });
    check(GL_PROGRAM_INPUT,
          "expected vertices with position, normal, uv and color, got the attribute ",
          [&names](const std::string& name) {
              return name.starts_with("gl_") || names.variables.contains(name);
          });
}

}  // namespace cubecam
