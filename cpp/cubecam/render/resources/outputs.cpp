#include "cubecam/render/resources/outputs.hpp"

#include <algorithm>

namespace cubecam {

void Outputs::add(const NamedOutput& output) {
    const auto place = std::lower_bound(named_.begin(), named_.end(), output);
    if (place == named_.end() || *place != output) named_.insert(place, output);
}

bool Outputs::has(OutputSource source) const {
    for (std::size_t row = 0; row < output_table.size(); ++row) {
        if (has(row) && output_table[row].source == source) return true;
    }
    return false;
}

std::vector<ShadedOutput> Outputs::by_slot() const {
    std::vector<ShadedOutput> shaded;
    for (std::size_t i = 0; i < output_table.size(); ++i) {
        const OutputRow& row = output_table[i];
        if (!has(i) || row.source != OutputSource::shader) continue;
        shaded.push_back({row.name, shaded.size() + 1, row.channels, row.type, row.clear});
    }
    for (const NamedOutput& output : named_) {
        shaded.push_back(
            {output.name, shaded.size() + 1, output.channels, OutputType::float32, 0.0F});
    }
    return shaded;
}

Outputs Outputs::without_buffered() const {
    Outputs shaded = *this;
    for (std::size_t row = 0; row < output_table.size(); ++row) {
        if (output_table[row].source != OutputSource::shader) shaded.rows_ &= ~(1U << row);
    }
    return shaded;
}

std::string_view glsl_type(int channels, OutputType type) {
    if (type == OutputType::int32) return "int";
    constexpr std::array<std::string_view, 4> types = {"float", "vec2", "vec3", "vec4"};
    return types[static_cast<std::size_t>(channels - 1)];
}

RequestedOutputs parse_outputs(const std::vector<std::string>& names) {
    RequestedOutputs requested;
    for (const std::string& name : names) {
        if (name == "color") continue;  // it is always there, and naming it is allowed
        const auto* row = std::find_if(output_table.begin(), output_table.end(),
                                       [&name](const OutputRow& r) { return r.name == name; });
        if (row == output_table.end()) {
            requested.others.push_back(name);
        } else {
            requested.outputs.add(static_cast<std::size_t>(row - output_table.begin()));
        }
    }
    return requested;
}

std::string known_outputs() {
    std::string known = "\"color\"";
    for (const OutputRow& row : output_table) known += ", \"" + std::string(row.name) + '"';
    return known;
}

}  // namespace cubecam
