#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/handle.hpp"

#include <functional>

namespace cubecam::gl {

/// Makes a texture by `make`, and looks for interrupts meanwhile if it has many texels (samples
/// count).
///
/// llvmpipe fills the memory of a new texture with zeros inside the call that asks for it. That
/// takes as long as the machine takes to give the memory: from 0.1 s to several seconds for 500 MB.
/// So a thread makes a large texture, in a context of its own that shares textures with this one.
/// After an interrupt that thread finishes the texture and deletes it; nothing waits for it but the
/// end of the process. Under other drivers, and where nothing asks for looks, this is a plain call.
///
/// `make` may run on the other thread, and after the caller has gone: it must hold copies of what
/// it needs. The context must be current. @throws what `make` throws, and what the look throws.
Texture make_large_texture(const Context& context, double texels,
                           std::function<Texture(const GladGLContext&)> make);

/// How many threads make a texture now, or finish one that nobody wants any more.
int threads_making_textures() noexcept;

}  // namespace cubecam::gl
