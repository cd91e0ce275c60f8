/// Tests what is read of a user's GLSL before a driver sees it: tokens, lines, declarations, and
/// the values that variables get.

#include "check.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/gl/glsl_text.hpp"
#include "cubecam/gl/program.hpp"
#include "cubecam/render/passes/user_text.hpp"

#include <array>
#include <string>
#include <vector>

using namespace cubecam;
using namespace cubecam::gl;

namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string joined_texts(const std::vector<GlslText::Token>& tokens) {
    std::string text;
    for (const GlslText::Token& token : tokens)
        text += token.text + "@" + std::to_string(token.line) + " ";
    return text;
}

void test_lines() {
    CHECK_EQUAL(with_plain_lines("\xEF\xBB\xBF"
                                 "a\r\nb\rc\n\rd"),
                "a\nb\nc\n\nd");
    CHECK_EQUAL(with_plain_lines(""), "");
    CHECK_EQUAL(with_plain_lines("\r"), "\n");
}

void test_tokens() {
    const GlslText text("a+=1.5e-3f; // b\n/* c\n */ x_1 <<= 0x1F\n# define A(x) \\\n x ## 2\ny");
    CHECK_EQUAL(joined_texts(text.tokens()), "a@1 +=@1 1.5e-3f@1 ;@1 x_1@3 <<=@3 0x1F@3 y@6 ");
    CHECK_EQUAL(text.directives().size(), 1U);
    CHECK_EQUAL(text.directives()[0].word, "define");
    CHECK_EQUAL(joined_texts(text.directives()[0].rest), "A@4 (@4 x@4 )@4 x@5 #@5 #@5 2@5 ");
    CHECK_EQUAL(text.directives()[0].last_line, 5U);
    CHECK_EQUAL(text.directives()[0].before_token, 7U);
    CHECK_EQUAL(text.last_line(), 6U);
    CHECK(!text.open_comment());
    CHECK_EQUAL(GlslText("a\n/* /* */ b\n  /*\n*").open_comment().value_or(0), 3U);
    // A word over two lines, a comment that a backslash continues, a directive in a comment.
    CHECK_EQUAL(joined_texts(GlslText("ma\\\nin // \\\n x\n/*\n#if\n*/ #else").tokens()),
                "main@1 ");
    CHECK_EQUAL(GlslText("/*\n#if\n*/ # else").directives()[0].word, "else");
    CHECK(GlslText("").tokens().empty());
    CHECK(GlslText("#").directives()[0].word.empty());
}

std::string described(const std::string& source) {
    const GlslOutline found = outline(GlslText(source));
    std::string text;
    for (const GlslName& name : found.names) {
        for (const std::string& qualifier : name.qualifiers) text += qualifier + " ";
        text += name.type + std::string(name.dimensions, '*') + " " + name.name +
                (name.initialised ? "=" : "") + "; ";
    }
    if (found.uncertain) text += "?";
    if (found.open_bracket) text += std::to_string(*found.open_bracket) + found.open_bracket_kind;
    return text;
}

void test_outline() {
    CHECK_EQUAL(described("layout(location = 1) flat out highp vec4 a, b[2], c = f(1, 2);"),
                "layout flat out highp vec4 a; layout flat out highp vec4* b; "
                "layout flat out highp vec4 c=; ");
    CHECK_EQUAL(described("float f(out float x) { float y; { int z; } } int g(int);"),
                "float f=; int g; ");
    CHECK_EQUAL(described("struct A { float x, y[2]; } a; uniform B { vec4 c; } b[3];"),
                "A A=; A a; uniform B B; vec4 c; uniform * b; ");
    CHECK_EQUAL(described("float[2] a[3]; const int[] b = {1, 2};"), "float** a; const int* b=; ");
    CHECK_EQUAL(described("#if 1\nint f() {\n#else\nint g() {\n#endif\n} int h;"),
                "int f=; int g=; int h; ");
    CHECK_EQUAL(described("#if 1\n{\n#endif\nint a;"), "?");
    CHECK_EQUAL(described("int a; void f() {\n if (1) {\n}"), "int a; void f=; 1{");
    CHECK_EQUAL(
        described("precision highp float; invariant gl_Position; ; layout(std140) uniform;"), "");
}

std::string prepared(const std::string& source, UserStage stage = UserStage::fragment) {
    return prepare_user_text({source, ""}, stage).text;
}

void test_values() {
    CHECK_EQUAL(
        prepared("void f() { float a, b = 1.0, c; for (int i;;) {} }"),
        "void f() { float a = float(0), b = 1.0, c = float(0); for (int i = int(0);;) {} }");
    CHECK_EQUAL(prepared("void f() { vec3 a[2]; }"),
                "void f() { vec3 a[2]; for (int cubecam_0 = 0; cubecam_0 < a.length(); "
                "++cubecam_0) { a[cubecam_0] = vec3(0);} }");
    CHECK_EQUAL(prepared("float f() { if (a) return 1.0; }"),
                "float f() { if (a) return 1.0;  return float(0); }");
    CHECK_EQUAL(prepared("void f(out int x) {}"), "void f(out int x) { x = int(0);}");
    CHECK_EQUAL(prepared("struct P { int a; }; void f() { P p; }"),
                "struct P { int a; }; void f() { P p; p.a = int(0); }");
    CHECK_EQUAL(prepared("#define real float\nvoid f() { real x; }"),
                "#define real float\nvoid f() { real x = real(0); }");
    CHECK_EQUAL(prepared("float[3] f() { if (a) return b; }"),
                "float[3] f() { if (a) return b;  return float[](float(0),float(0),float(0)); }");
    CHECK_EQUAL(prepared("vec2[N] f() { if (a) return b; }"),
                "vec2[N] f() { if (a) return b;  { vec2 [ N ] cubecam_result; for (int cubecam_0 "
                "= 0; cubecam_0 < cubecam_result.length(); ++cubecam_0) { "
                "cubecam_result[cubecam_0] = vec2(0);} return cubecam_result; } }");
    CHECK_EQUAL(prepared("#define T float[2]\nT f() {\n#if A\nreturn b;\n#endif\n}"),
                "#define T float[2]\nT f() {\n#if A\nreturn b;\n#endif\n return "
                "float[](float(0),float(0)); }");
    CHECK_EQUAL(prepared("float[3] f() { if (a) return b; return c; }"),
                "float[3] f() { if (a) return b; return c; }");
    for (const std::string same :
         {"float a; uniform int b; void f() { return; }", "void f() { const int a; x y; }",
          "void f() { a = b; c(d); if (e) float g; sampler2D h; }", "float f();",
          "float f(float x, inout int y, const in vec2 z) {}"}) {
        CHECK_EQUAL(prepared(same), same);
    }
    const std::string after =
        prepare_user_text({"#define A 2\n#ifdef A\nout vec3 v;\n#else\nfloat w[A];\n#endif", ""},
                          UserStage::vertex)
            .after;
    CHECK(after.find("#ifdef A") < after.find("v = vec3(0);"));
    CHECK(after.find("v = vec3(0);") < after.find("#else"));
    CHECK(after.find("#else") < after.find("w[cubecam_0] = float(0);"));
    CHECK(after.find("#undef A") < after.find("#define A 2"));
    CHECK(after.ends_with("}\n#undef A\n"));
}

/// What macros hide: the text behind the #define lines.
void test_values_by_macros() {
    const auto behind = [](const std::string& macros, const std::string& source) {
        const std::string text = prepared(macros + source);
        return text.starts_with(macros) ? text.substr(macros.size()) : text;
    };
    const std::string f = "#define F(n) float n\n";
    CHECK_EQUAL(behind(f, "void f() { F(x); g(x); }"), "void f() { F(x); x = float(0); g(x); }");
    CHECK_EQUAL(behind(f, "void f() { F(x), y, z = 1.0; }"),
                "void f() { F(x), y, z = 1.0; x = float(0);y = float(0); }");
    CHECK_EQUAL(behind(f, "void f() { for (F(x);;) {} }"),
                "void f() { for (F(x) = float(0);;) {} }");
    CHECK_EQUAL(behind("#define HI highp\n", "void f() { HI vec2 x; }"),
                "void f() { HI vec2 x; x = vec2(0); }");
    CHECK_EQUAL(behind("#define ALL float a, b\n", "void f() { ALL; }"),
                "void f() { ALL; a = float(0);b = float(0); }");
    CHECK_EQUAL(behind("#define D(t, n) t n##1;\n", "void f() { D(vec2, x) g(x1); }"),
                "void f() { D(vec2, x) x1 = vec2(0); g(x1); }");
    CHECK_EQUAL(behind("#define T float[2]\n", "void f() { T x; }"),
                "void f() { T x; for (int cubecam_0 = 0; cubecam_0 < x.length(); ++cubecam_0) { "
                "x[cubecam_0] = float(0);} }");
    CHECK_EQUAL(behind("#define O out\n", "void f(O int x) {}"), "void f(O int x) { x = int(0);}");
    CHECK_EQUAL(behind("#define R return\n", "int f() { if (a) R 1; }"),
                "int f() { if (a) R 1;  return int(0); }");
    CHECK_EQUAL(behind("#define FN(n) float n(float x)\n", "FN(f) { float y; return y; }"),
                "FN(f) { float y = float(0); return y;  return float(0); }");
    CHECK_EQUAL(behind("#define HI highp\n", "struct P { HI float a; }; void f() { P p; }"),
                "struct P { HI float a; }; void f() { P p; p.a = float(0); }");
    CHECK_EQUAL(behind("#define S struct P { float a; };\n", "S void f() { P p; }"),
                "S void f() { P p; p.a = float(0); }");
    // Statements that do other things, and macros that mean different types.
    for (const std::string same : {"F(x) = 2.0;", "g(F);", "G(x);", "V(x);"}) {
        CHECK_EQUAL(behind("#define F(n) float n\n#define G(n) n = 1.0\n#if 1\n#define V(n) int n\n"
                           "#else\n#define V(n) vec2 n\n#endif\n",
                           "void f() { " + same + " }"),
                    "void f() { " + same + " }");
    }
    const PreparedText global = prepare_user_text({f + "F(x); float y;", ""}, UserStage::effect);
    CHECK_EQUAL(global.text, f + "F(x); float y;");
    CHECK(contains(global.after, "x = float(0);\ny = float(0);"));
    // Macros inside each other end at a limit.
    std::string deep = "#define A0 float x; float y;\n";
    for (int i = 1; i < 64; ++i) {
        const std::string last = " A" + std::to_string(i - 1);
        deep += "#define A" + std::to_string(i) + last + last + "\n";
    }
    CHECK(contains(prepared(deep + "void f() { A63; float z; }"),
                   "\nvoid f() { A63; float z = float(0); }"));
}

/// A label that is reached past a declaration.
void test_values_in_switch() {
    CHECK_EQUAL(
        prepared("void f() { switch (i) { case 0: float a = 1.0; break; case 1: g(a); } }"),
        "void f() { { bool cubecam_passed_0 = false; switch (i) { case 0: float a = 1.0; "
        "cubecam_passed_0 = true; break; case 1: if (!cubecam_passed_0) { a = float(0); } g(a); } "
        "} }");
    CHECK_EQUAL(prepared("void f() { if (b) switch (i) { case 0: int a, b; default: g(b); } }"),
                "void f() { if (b) { bool cubecam_passed_0 = false; switch (i) { case 0: int a = "
                "int(0), b = int(0); cubecam_passed_0 = true; default: if (!cubecam_passed_0) { b "
                "= int(0); } g(b); } } }");
    for (const std::string same :
         {"switch (i) { case 0: int a = 1; g(a); break; case 1: g(b); }",
          "switch (i) { case 0: { int a = 1; } case 1: g(a); }",
          "switch (i) { case 0: for (int a = 1; a < 2; ++a) g(a); case 1: g(a); }",
          "switch (i) { case 0: const int a = 1; case 1: g(a); }",
          "switch (i) { case 0: a = 1; case 1: g(a); int a = 1; }"}) {
        CHECK_EQUAL(prepared("void f() { " + same + " }"), "void f() { " + same + " }");
    }
    CHECK(
        contains(prepared("#define U g(a)\nvoid f() { switch (i) { case 0: int a; case 1: U; } }"),
                 "case 1: if (!cubecam_passed_0) { a = int(0); } U;"));
    CHECK(contains(
        prepared("#define D(n) int n\nvoid f() { switch (i) { case 0: D(a); case 1: a; } }"),
        "D(a); cubecam_passed_0 = true; a = int(0); case 1: if (!cubecam_passed_0) {"));
}

std::string refusal(const std::string& source, UserStage stage = UserStage::fragment) {
    try {
        check_user_text({source, ""}, stage);
    } catch (const ShaderError& error) {
        return error.what();
    }
    return "nothing";
}

void test_refusals() {
    const std::string shade = "vec3 shade(Surface s) { return vec3(1); }\n";
    CHECK_EQUAL(refusal(shade), "nothing");
    CHECK(contains(refusal(shade + "void main() {}"), "fragment:2: expected no main()"));
    CHECK(contains(refusal("\n" + shade + "in vec4 x;", UserStage::effect), "effect"));
    CHECK(contains(refusal("void vertex(inout Vertex v) {}\nin vec4 x;", UserStage::vertex),
                   "vertex:2: "));
}

/// Logs of other drivers, in the forms that their documentation and users' reports show.
void test_logs() {
    const std::array<ShaderSource, 4> sources = {{
        {"a.vert", "#include \"include/user_vertex.glsl\"\nvoid main() {}\n"},
        {"a.frag", "int own;\n#include \"include/user_fragment.glsl\"\nint end;\nvoid main() {}\n"},
        {.name = "include/user_vertex.glsl",
         .text = "out vec2 way;\n",
         .title = "vertex",
         .user = true},
        {.name = "include/user_fragment.glsl",
         .text = "in vec3 way;\n#line 7\nfloat f();\nx\n",
         .title = "fragment",
         .user = true,
         .after = "int added;\n"},
    }};
    const std::vector<ExpandedShader> shaders = {expand_shader("a.vert", {}, sources),
                                                 expand_shader("a.frag", {}, sources)};
    const ExpandedShader& frag = shaders[1];
    CHECK(!contains(frag.text, "#line"));
    std::size_t x = 0;  // the line of the user's "x"
    for (std::size_t i = 0; i < frag.lines.size(); ++i) {
        const bool user = frag.lines[i].file == 1 && frag.lines[i].number == 4;
        if (user && !frag.lines[i].after) x = i + 1;
    }
    const std::string number = std::to_string(x);
    for (const std::string& log :
         {"0:" + number + "(5): error: bad", "0(" + number + ") : error C1008: undefined variable",
          "ERROR: 0:" + number + ": 'x' : undeclared identifier",
          "ERROR: 0:" + number + ": error(#143) Undeclared identifier x",
          "ERROR: 0:" + number + ": Use of undeclared identifier 'x'"}) {
        const std::string text = explain_shader_log(log, frag);
        CHECK(contains(text, "fragment:4"));
        CHECK(contains(text, ">    4 | x"));
    }
    // Behind the user's text, in what was added to it, and in an own file.
    for (const std::size_t behind : {x + 1, x + 2, x + 3}) {
        const std::string text =
            explain_shader_log("0:" + std::to_string(behind) + "(1): error: bad", frag);
        CHECK(contains(text, "fragment:4(1): error: bad"));
    }
    CHECK(contains(
        explain_shader_log("0:0(0): error: function `float f()' has static recursion", frag),
        "fragment:3: f"));

    // Linkers: names, headings of stages with line numbers, and limits without a name.
    const auto linked = [&shaders](const std::string& log) {
        return explain_link_log(log, shaders);
    };
    const std::string types =
        linked("error: vertex shader output `way' declared as type `vec2', but fragment shader "
               "input declared as type `vec3'");
    CHECK(contains(types, "vertex:1: way"));
    CHECK(contains(types, "fragment:1: way"));
    CHECK(contains(linked("Fragment info\n-------------\n0(" + number + ") : error C5052: bad"),
                   "fragment:4 : error C5052: bad"));
    CHECK(contains(linked("Fragment shader(s) failed to link.\nFragment link error: "
                          "INVALID_OPERATION.\nERROR: 0:" +
                          number + ": error(#280) bad"),
                   "fragment:4: error(#280) bad"));
    CHECK(contains(linked("error C5041: cannot locate suitable resource to bind variable "
                          "\"way\". Possibly large array."),
                   "vertex:1: way"));
    CHECK(contains(linked("ERROR: Definition for \"f(\" not found."), "fragment:3: f"));
    CHECK(contains(linked("ERROR: too many varyings"), "fragment:1: "));
    CHECK_EQUAL(shown_names(shaders), "vertex + fragment");
    CHECK_EQUAL(line_of_word("a + b;\nfloat b;", "b").value_or(0), 2U);
    CHECK(!line_of_word("// b", "b"));
}

}  // namespace

int main() {
    test_lines();
    test_tokens();
    test_outline();
    test_values_by_macros();
    test_values_in_switch();
    test_values();
    test_refusals();
    test_logs();
    return test::result();
}
