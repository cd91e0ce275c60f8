#include "cubecam/image/format.hpp"

#include "cubecam/core/parse_name.hpp"

#include <stdexcept>
#include <string>

namespace cubecam {

Format parse_format(std::string_view name) {
    const std::size_t place = place_of_name(format_names, name);
    if (place < format_names.size()) return format_names[place].second;
    throw std::invalid_argument("expected format " + quoted_names(format_names) + ", got '" +
                                shortened(name) + "'");
}

std::string_view to_string(Format format) {
    return format_names[static_cast<std::size_t>(format)].first;
}

}  // namespace cubecam
