/// The `encoding` argument of classes that hold pictures.
#pragma once

#include "choice.hpp"
#include "objects.hpp"

#include "cubecam/image/encoding.hpp"
#include "cubecam/image/pixels.hpp"

#include <optional>
#include <string>

namespace cubecam::bindings {

using EncodingNow = Choice<encoding_names>;
using EncodingName = std::optional<EncodingNow>;

/// The encoding that a caller names. None: that of a Frame, a CubeMap or an Image; of an array, it
/// follows from the type: 8-bit pictures are sRGB, as in files, and floats are linear.
inline Encoding to_encoding(const EncodingName& name, py::handle value, DType dtype) {
    if (name) return parse_encoding(*name);
    if (py::hasattr(value, "encoding")) {
        const py::object own = value.attr("encoding");
        if (py::isinstance<py::str>(own)) return parse_encoding(own.cast<std::string>());
    }
    return dtype == DType::uint8 ? Encoding::srgb : Encoding::linear;
}

}  // namespace cubecam::bindings
