#include "cubecam/render/passes/tonemap.hpp"

namespace cubecam {

Tonemap parse_tonemap(std::string_view name) { return parse_name("tonemap", name, tonemap_names); }

Encode parse_encode(std::string_view name) { return parse_name("encode", name, encode_names); }

}  // namespace cubecam
