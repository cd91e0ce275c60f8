#include "cubecam/render/passes/shader_names.hpp"

#include "cubecam/gl/embedded.hpp"
#include "cubecam/render/passes/environment_text.hpp"
#include "cubecam/render/resources/outputs.hpp"

#include <algorithm>
#include <array>

namespace cubecam {
namespace {

/// The interface in the docstrings of cubecam.ShaderMaterial and cubecam.ImageEffect.
constexpr std::array<std::string_view, 25> documented = {"Surface",
                                                         "Vertex",
                                                         "LightSample",
                                                         "model_matrix",
                                                         "normal_matrix",
                                                         "eye_position",
                                                         "environment",
                                                         "environment_at",
                                                         "environment_lod",
                                                         "environment_levels",
                                                         "environment_filtered",
                                                         "environment_irradiance",
                                                         "environment_mip",
                                                         "environment_size",
                                                         "environment_is_local",
                                                         "environment_position",
                                                         "brdf",
                                                         "light_count",
                                                         "sample_light",
                                                         "ambient_light",
                                                         "phong",
                                                         "schlick",
                                                         "frame",
                                                         "frame_size",
                                                         "frame_pixel"};

class NameReader {
public:
    explicit NameReader(ShaderNames& names) : names_(&names) {}

    void read(std::string_view file) {
        if (!seen_.emplace(file).second) return;
        for (const gl::ShaderSource& source : gl::embedded_shaders()) {
            if (source.name == file) read_text(source.text);
        }
    }

private:
    void read_text(std::string_view source) {
        constexpr std::string_view include = "#include \"";
        for (std::size_t at = source.find(include); at != std::string_view::npos;
             at = source.find(include, at + 1)) {
            const std::size_t begin = at + include.size();
            read(source.substr(begin, source.find('"', begin) - begin));
        }
        // STAGE is a macro for `in` and `out`.
        std::string staged(source);
        for (std::size_t at = staged.find("STAGE "); at != std::string::npos;
             at = staged.find("STAGE ", at))
            staged.replace(at, 5, "in   ");
        const gl::GlslText text(staged);
        for (const gl::GlslText::Directive& directive : text.directives()) {
            if (directive.word == "define" && !directive.rest.empty())
                names_->macros.insert(directive.rest[0].text);
            if (!directive.is_conditional()) continue;
            for (const gl::GlslText::Token& token : directive.rest) {
                if (token.is_word() && token.text != "defined") names_->macros.insert(token.text);
            }
        }
        const gl::GlslOutline found = gl::outline(text);
        for (const gl::GlslName& name : found.names) {
            switch (name.kind) {
                case gl::GlslName::Kind::function: names_->functions.insert(name.name); break;
                case gl::GlslName::Kind::block: names_->blocks.insert(name.name); break;
                case gl::GlslName::Kind::structure: break;
                default: names_->variables.insert(name.name); break;
            }
        }
        names_->structures.insert(names_->structures.end(), found.structures.begin(),
                                  found.structures.end());
    }

    ShaderNames* names_;
    std::set<std::string, std::less<>> seen_;
};

ShaderNames read_names(std::initializer_list<std::string_view> files) {
    ShaderNames names;
    NameReader reader(names);
    for (const std::string_view file : files) reader.read(file);
    names.functions.erase("main");  // has a message of its own
    names.macros.insert("STAGE");
    for (const char* name : {"MATERIAL_SIZE", "SHADOW_UNIT", "SHADOW_KINDS", "MAX_SHADOWS",
                             "OUTPUT_DECLARATIONS", "OUTPUT_ZEROS", "SCREEN_DEPTH_LEVELS"}) {
        names.macros.insert(name);
    }
    return names;
}

/// Also the variables of passes that no user's text is in: one name has one meaning everywhere.
void add_all_variables(ShaderNames& names) {
    ShaderNames all;
    NameReader reader(all);
    for (const gl::ShaderSource& source : gl::embedded_shaders()) {
        if (!source.name.starts_with("materials/")) reader.read(source.name);
    }
    for (const std::string& name : all.variables) {
        if (name.size() > 1 && name[1] == '_') names.variables.insert(name);
    }
}

}  // namespace

const ShaderNames& shader_names(UserStage stage) {
    static const ShaderNames effect = [] {
        ShaderNames names = read_names({"passes/effect.frag"});
        add_all_variables(names);
        return names;
    }();
    static const ShaderNames surface = [] {
        ShaderNames names = read_names({"passes/surface.vert", "passes/surface.frag",
                                        "materials/shader.glsl", "include/environment_blend.glsl"});
        for (const OutputRow& row : output_table)
            names.variables.insert("o_" + std::string(row.name));
        add_all_variables(names);
        // Those of several environments, one after the other.
        for (const std::string& name : environment_names()) {
            for (std::size_t i = 0; i <= most_blended_probes; ++i) {
                const std::string numbered = name + "_" + std::to_string(i);
                names.variables.insert(numbered);
                names.blocks.insert(numbered);
            }
        }
        names.macros.erase("VOLUME");  // another material's, and a name that users may want
        return names;
    }();
    return stage == UserStage::effect ? effect : surface;
}

bool is_documented(std::string_view name) {
    return std::find(documented.begin(), documented.end(), name) != documented.end();
}

}  // namespace cubecam
