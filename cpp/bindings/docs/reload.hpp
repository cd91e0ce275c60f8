/// Docstrings of `reload`, which cubecam.ShaderMaterial and cubecam.ImageEffect have.
#pragma once

namespace cubecam::docs {

inline constexpr const char* reload = R"doc(Read the source again from its file.

If the new source does not compile, the next picture raises ShaderError; a later `reload` of a corrected file
works.

Returns
-------
bool
    Whether the source changed.

Raises
------
ValueError
    If no part of the source came from a file, or the file lacks its function.
OSError
    If the file cannot be read; the old source stays.
)doc";

}  // namespace cubecam::docs
