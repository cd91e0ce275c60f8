#include "cubecam/render/readback.hpp"

#include "cubecam/render/flip.hpp"

#include <cstddef>

namespace cubecam {
namespace {

GLenum gl_type(Format format) {
    switch (format) {
        case Format::rgba8: return GL_UNSIGNED_BYTE;
        case Format::rgba16f: return GL_HALF_FLOAT;
        case Format::rgba32f: return GL_FLOAT;
    }
    return GL_FLOAT;
}

template <class T>
std::byte* bytes_of(Buffer<T>& buffer) {
    return reinterpret_cast<std::byte*>(buffer.data());
}

/// Reads all layers of a target, one after the other, each as the type it is stored in: a driver
/// that must convert takes ten times as long.
class Reader {
public:
    Reader(const GladGLContext& gl, Target& target)
        : gl_(gl), target_(target), d_(target.description()) {
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    }

    PixelBuffer picture() {
        Layers& layers = d_.graded                ? target_.graded_pass()
                         : target_.multisampled() ? target_.resolved()
                                                  : target_.color_pass();
        PixelBuffer color;
        read(layers, Slot::color, GL_RGBA, gl_type(d_.format), 4 * dtype_size(dtype_of(d_.format)),
             color);
        return color;
    }

    Buffer<float> scalar(Slot slot) {
        Buffer<float> values;
        read(output_layers(), slot, GL_RED, GL_FLOAT, 1, values);
        return values;
    }

    /// Stored with a fourth channel that nobody asked for.
    Buffer<float> vector(Slot slot) {
        Buffer<float> four;
        read(output_layers(), slot, GL_RGBA, GL_FLOAT, 4, four);
        Buffer<float> three(four.size() / 4 * 3);
        for (std::size_t i = 0; i < four.size() / 4; ++i) {
            for (std::size_t c = 0; c < 3; ++c) three[3 * i + c] = four[4 * i + c];
        }
        return three;
    }

    Buffer<std::int32_t> id() {
        Buffer<std::int32_t> ids;
        read(output_layers(), Slot::id, GL_RED_INTEGER, GL_INT, 1, ids);
        return ids;
    }

private:
    Layers& output_layers() {
        return target_.multisampled() ? target_.output_pass() : target_.color_pass();
    }

    template <class T>
    void read(Layers& layers, Slot slot, GLenum format, GLenum type, std::size_t channels,
              Buffer<T>& to) {
        const auto rows = static_cast<std::size_t>(d_.height);
        const std::size_t row = static_cast<std::size_t>(d_.width) * channels;
        const auto count = static_cast<std::size_t>(d_.layers());
        Buffer<T> layer;
        if (!d_.cube) layer.resize(row * rows);
        to.resize(row * rows * count);
        for (std::size_t i = 0; i < count; ++i) {
            const GLuint framebuffer = layers.one(static_cast<int>(i));
            gl_.NamedFramebufferReadBuffer(framebuffer,
                                           GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(slot));
            gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
            T* here = d_.cube ? to.data() + i * row * rows : layer.data();
            gl_.ReadPixels(0, 0, d_.width, d_.height, format, type, here);
        }
        if (!d_.cube) flip_rows(bytes_of(layer), bytes_of(to), row * sizeof(T), rows);
    }

    const GladGLContext& gl_;
    Target& target_;
    const TargetDescription& d_;
};

template <class T>
std::shared_ptr<const Buffer<T>> share(Buffer<T>&& buffer) {
    return std::make_shared<const Buffer<T>>(std::move(buffer));
}

}  // namespace

Frame read_frame(const GladGLContext& gl, Target& target) {
    const TargetDescription& d = target.description();
    Reader reader(gl, target);
    Frame frame;
    frame.width = d.width;
    frame.height = d.height;
    frame.format = d.format;
    frame.color = reader.picture();
    if (d.outputs.distance) frame.distance = reader.scalar(Slot::distance);
    if (d.outputs.z) frame.z = reader.scalar(Slot::z);
    if (d.outputs.normal) frame.normal = reader.vector(Slot::normal);
    if (d.outputs.position) frame.position = reader.vector(Slot::position);
    if (d.outputs.id) frame.id = reader.id();
    gl::check_gl(gl, "reading a frame");
    return frame;
}

std::shared_ptr<CubeMap> read_cube(const GladGLContext& gl, Target& target) {
    const TargetDescription& d = target.description();
    Reader reader(gl, target);
    PixelBuffer color = reader.picture();
    CapturedOutputs outputs;
    if (d.outputs.distance) outputs.distance = share(reader.scalar(Slot::distance));
    if (d.outputs.z) outputs.z = share(reader.scalar(Slot::z));
    if (d.outputs.normal) outputs.normal = share(reader.vector(Slot::normal));
    if (d.outputs.position) outputs.position = share(reader.vector(Slot::position));
    if (d.outputs.id) outputs.id = share(reader.id());
    gl::check_gl(gl, "reading a cubemap");
    return std::make_shared<CubeMap>(d.width, 4, dtype_of(d.format), std::move(color), d.mipmaps,
                                     std::move(outputs));
}

}  // namespace cubecam
