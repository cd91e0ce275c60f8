/// The `encoding` argument of classes that hold pictures.
#pragma once

#include "choice.hpp"
#include "frame.hpp"
#include "objects.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/image/encoding.hpp"
#include "cubecam/image/image.hpp"
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
    if (py::isinstance<CubeMap>(value)) return value.cast<CubeMap&>().data()->encoding;
    if (py::isinstance<Image>(value)) return value.cast<Image&>().encoding();
    if (py::isinstance<PyFrame>(value)) return value.cast<PyFrame&>().encoding;
    return dtype == DType::uint8 ? Encoding::srgb : Encoding::linear;
}

}  // namespace cubecam::bindings
