#include "cubecam/render/readback.hpp"

#include "cubecam/image/flip.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cubecam {
namespace {

GLenum gl_type(Format format) {
    switch (format) {
        case Format::rgba8: return GL_UNSIGNED_BYTE;
        case Format::rgba16f: return GL_HALF_FLOAT;
        case Format::rgba32f: return GL_FLOAT;
        case Format::rgb565: return GL_UNSIGNED_SHORT_5_6_5;
    }
    return GL_FLOAT;
}

/// To nearest: v / (2^bits - 1) as a number of 255 (GL 4.6, equation 2.1).
std::byte widen(unsigned value, unsigned bits) {
    const unsigned most = (1U << bits) - 1;
    return static_cast<std::byte>((value * 255 + most / 2) / most);
}

PixelBuffer widen_565(const Buffer<std::uint16_t>& packed) {
    PixelBuffer pixels(packed.size() * 4);
    for (std::size_t i = 0; i < packed.size(); ++i) {
        const unsigned p = packed[i];
        pixels[4 * i] = widen(p >> 11, 5);
        pixels[4 * i + 1] = widen(p >> 5 & 63, 6);
        pixels[4 * i + 2] = widen(p & 31, 5);
        pixels[4 * i + 3] = std::byte{255};
    }
    return pixels;
}

template <class T>
std::byte* bytes_of(T* values) {
    return reinterpret_cast<std::byte*>(values);
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
        Layers& layers = d_.post_processed        ? target_.post_processed_pass()
                         : target_.multisampled() ? target_.resolved()
                                                  : target_.color_pass();
        if (d_.format == Format::rgb565) {
            Buffer<std::uint16_t> packed;
            read(layers, Slot::color, GL_RGB, gl_type(d_.format), 1, packed);
            return widen_565(packed);
        }
        PixelBuffer color;
        read(layers, Slot::color, GL_RGBA, gl_type(d_.format), texel_size(d_.format), color);
        return color;
    }

    Buffer<float> scalar(Slot slot) {
        Buffer<float> values;
        read(target_.outputs(), slot, GL_RED, GL_FLOAT, 1, values);
        return values;
    }

    /// Stored with a fourth channel that nobody asked for.
    Buffer<float> vector(Slot slot) {
        Buffer<float> four;
        read(target_.outputs(), slot, GL_RGBA, GL_FLOAT, 4, four);
        Buffer<float> three(four.size() / 4 * 3);
        for (std::size_t i = 0; i < four.size() / 4; ++i) {
            for (std::size_t c = 0; c < 3; ++c) three[3 * i + c] = four[4 * i + c];
        }
        return three;
    }

    Buffer<std::int32_t> id() {
        Buffer<std::int32_t> ids;
        read(target_.outputs(), Slot::id, GL_RED_INTEGER, GL_INT, 1, ids);
        return ids;
    }

    /// Window-space z. Depth is stored reversed; turned round as the whole number that it is, a
    /// fixed-point depth loses nothing.
    Buffer<float> depth() {
        const int bits = fixed_depth_bits(d_.depth_format);
        if (bits == 0) {
            Buffer<float> values;
            read(target_.outputs(), std::nullopt, GL_DEPTH_COMPONENT, GL_FLOAT, 1, values);
            for (float& value : values) value = 1.0F - value;
            return values;
        }
        // GL widens to 32 bits, which leaves the stored ones on top.
        Buffer<std::uint32_t> stored;
        read(target_.outputs(), std::nullopt, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 1, stored);
        const std::uint32_t most = (std::uint32_t{1} << bits) - 1;
        Buffer<float> values(stored.size());
        for (std::size_t i = 0; i < stored.size(); ++i) {
            const std::uint32_t near = stored[i] >> (32 - bits);
            values[i] = static_cast<float>(static_cast<double>(most - near) / most);
        }
        return values;
    }

    Buffer<std::uint8_t> stencil() {
        Buffer<std::uint8_t> values;
        read(target_.outputs(), std::nullopt, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1, values);
        return values;
    }

private:
    template <class T>
    void read(Layers& layers, std::optional<Slot> slot, GLenum format, GLenum type,
              std::size_t channels, Buffer<T>& to) {
        const auto rows = static_cast<std::size_t>(d_.height);
        const std::size_t row = static_cast<std::size_t>(d_.width) * channels;
        const auto count = static_cast<std::size_t>(d_.layers());
        Buffer<T> layer;
        if (!d_.cube) layer.resize(row * rows);
        to.resize(row * rows * count);
        for (std::size_t i = 0; i < count; ++i) {
            const GLuint framebuffer = layers.one(static_cast<int>(i));
            if (slot) {
                gl_.NamedFramebufferReadBuffer(framebuffer,
                                               GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(*slot));
            }
            gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
            T* here = d_.cube ? to.data() + i * row * rows : layer.data();
            gl_.ReadPixels(0, 0, d_.width, d_.height, format, type, here);
            if (d_.cube) continue;
            T* there = to.data() + i * row * rows;
            flip_rows(bytes_of(layer.data()), bytes_of(there), row * sizeof(T), rows);
        }
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
    frame.height = d.height * d.views;
    frame.format = d.format;
    if (d.color) frame.color = reader.picture();
    if (d.outputs.distance) frame.distance = reader.scalar(Slot::distance);
    if (d.outputs.z) frame.z = reader.scalar(Slot::z);
    if (d.outputs.normal) frame.normal = reader.vector(Slot::normal);
    if (d.outputs.position) frame.position = reader.vector(Slot::position);
    if (d.outputs.id) frame.id = reader.id();
    if (d.outputs.depth) frame.depth = reader.depth();
    if (d.outputs.stencil) frame.stencil = reader.stencil();
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
    if (d.outputs.depth) outputs.depth = share(reader.depth());
    if (d.outputs.stencil) outputs.stencil = share(reader.stencil());
    gl::check_gl(gl, "reading a cubemap");
    return std::make_shared<CubeMap>(d.width, 4, dtype_of(d.format), std::move(color), d.mipmaps,
                                     std::move(outputs));
}

}  // namespace cubecam
