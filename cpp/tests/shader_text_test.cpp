/// Tests includes of GLSL files, the lines before the source, and a driver's log with the user's
/// own lines.

#include "check.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/program.hpp"

#include <array>
#include <string>

using namespace cubecam;
using namespace cubecam::gl;

namespace {

const std::array<ShaderSource, 5> sources = {{
    {"a.frag", "#include \"b.glsl\"\n#include \"c.glsl\"\nvoid main() {}\n"},
    {"b.glsl", "#include \"c.glsl\"\nint b;\n"},
    {.name = "c.glsl", .text = "int c;\n", .title = "user's file"},
    {"lost.frag", "int x;\n#include \"nowhere.glsl\"\n"},
    {"old.frag", "#version 330\n"},
}};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string refusal(const char* name) {
    try {
        expand_shader(name, {}, sources);
    } catch (const ShaderError& error) {
        return error.what();
    }
    return "nothing";
}

}  // namespace

int main() {
    ShaderOptions options;
    options.extensions = {"GL_ARB_shader_viewport_layer_array"};
    options.defines = {{"COLOR", "1"}};
    const ExpandedShader shader = expand_shader("a.frag", options, sources);
    const std::string& text = shader.text;
    CHECK(text.starts_with("#version 450 core\n"));
    CHECK(contains(text, "#extension GL_ARB_shader_viewport_layer_array : require\n"));
    CHECK(contains(text, "#define COLOR 1\n"));
    CHECK(text.find("int c;") < text.find("int b;"));
    CHECK(text.find("int c;") == text.rfind("int c;"));  // each file once
    CHECK(!contains(text, "#include"));

    // The origin of every line is known.
    std::size_t line = 0;
    std::size_t begin = 0;
    while (text.compare(begin, 6, "int b;") != 0) {
        begin = text.find('\n', begin) + 1;
        ++line;
    }
    CHECK_EQUAL(std::string(shader.files[shader.lines[line].file].name), "b.glsl");
    CHECK_EQUAL(shader.lines[line].number, std::size_t{2});

    // Mesa and NVIDIA name the place of an error differently; the title replaces the name.
    std::size_t of_c = 0;
    for (std::size_t i = 0; i < shader.lines.size(); ++i) {
        const std::size_t file = shader.lines[i].file;
        if (file != ExpandedShader::ahead && shader.files[file].name == "c.glsl") of_c = i + 1;
    }
    const std::string number = std::to_string(of_c);
    const std::string mesa = explain_shader_log("0:" + number + "(5): error: bad", shader);
    CHECK(contains(mesa, "user's file:1(5): error: bad"));
    const std::string nvidia = explain_shader_log("0(" + number + ") : error C1: bad", shader);
    CHECK(contains(nvidia, "user's file"));

    CHECK(contains(refusal("lost.frag"), "lost.frag:2"));
    CHECK(contains(refusal("lost.frag"), "nowhere.glsl"));
    CHECK(contains(refusal("old.frag"), "old.frag:1"));
    CHECK(contains(refusal("missing.frag"), "missing.frag"));
    return test::result();
}
