#include "cubecam/render/readback.hpp"

#include "cubecam/image/flip.hpp"
#include "cubecam/render/resources/repack.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>

namespace cubecam {
namespace {

using Result = std::shared_ptr<PixelBuffer>;

GLenum gl_type(Format format) {
    switch (format) {
        case Format::rgba8: return GL_UNSIGNED_BYTE;
        case Format::rgba16f: return GL_HALF_FLOAT;
        case Format::rgba32f: return GL_FLOAT;
        case Format::rgb565: return GL_UNSIGNED_SHORT_5_6_5;
    }
    return GL_FLOAT;
}

/// The format in which the driver returns a texel. It is the stored type, since a driver that must
/// convert takes ten times as long.
struct Given {
    GLenum format;
    GLenum type;
    std::size_t bytes;
};

Given given_output(const ShadedOutput& output) {
    if (output.type == OutputType::int32) return {GL_RED_INTEGER, GL_INT, 4};
    switch (output.channels) {
        case 1: return {GL_RED, GL_FLOAT, 4};
        case 2: return {GL_RG, GL_FLOAT, 8};
        default: return {GL_RGBA, GL_FLOAT, 16};
    }
}

/// Reads all layers of a target, one after the other.
class Reader {
public:
    Reader(const GladGLContext& gl, Target& target, ResultPool& pool)
        : gl_(gl), target_(target), d_(target.description()), pool_(pool) {
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    }

    Result picture() {
        Layers& layers = d_.post_processed        ? target_.post_processed_pass()
                         : target_.multisampled() ? target_.resolved()
                                                  : target_.color_pass();
        const bool packed = d_.format == Format::rgb565;
        const Given given{packed ? GLenum{GL_RGB} : GLenum{GL_RGBA}, gl_type(d_.format),
                          texel_size(d_.format)};
        if (!packed) return read(layers, 0, given, given.bytes, copy_row);
        return read(layers, 0, given, 4, [](const std::byte* from, std::byte* to, std::size_t n) {
            widen_565(reinterpret_cast<const std::uint16_t*>(from), n,
                      reinterpret_cast<std::uint32_t*>(to));
        });
    }

    OutputList outputs() {
        OutputList list;
        for (const ShadedOutput& output : d_.outputs.by_slot()) {
            list.push_back(
                {std::string(output.name), output.channels, output.type, read_shaded(output)});
        }
        for (std::size_t i = 0; i < output_table.size(); ++i) {
            const OutputRow& row = output_table[i];
            if (!d_.outputs.has(i) || row.source == OutputSource::shader) continue;
            list.push_back({std::string(row.name), row.channels, row.type,
                            row.source == OutputSource::depth ? read_depth() : read_stencil()});
        }
        return list;
    }

private:
    Result read_shaded(const ShadedOutput& output) {
        const Given given = given_output(output);
        if (output.channels != 3) {
            return read(target_.outputs(), output.slot, given, given.bytes, copy_row);
        }
        return read(target_.outputs(), output.slot, given, 12,
                    [](const std::byte* from, std::byte* to, std::size_t n) {
                        drop_fourth(reinterpret_cast<const float*>(from), n,
                                    reinterpret_cast<float*>(to));
                    });
    }

    /// Reads window-space z; the stored depth is reversed.
    Result read_depth() {
        const int bits = fixed_depth_bits(d_.depth_format);
        const float clear = depth_state(d_.depth_order).clear;
        const Given given{GL_DEPTH_COMPONENT,
                          bits == 0 ? GLenum{GL_FLOAT} : GLenum{GL_UNSIGNED_INT}, 4};
        const Result depth = read(target_.outputs(), std::nullopt, given, 4, copy_row);
        const std::size_t count = depth->size() / 4;
        if (bits == 0) {
            turn_depth(reinterpret_cast<float*>(depth->data()), count, clear);
        } else {
            turn_fixed_depth(depth->data(), count, bits, clear);
        }
        return depth;
    }

    Result read_stencil() {
        return read(target_.outputs(), std::nullopt, {GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1}, 1,
                    copy_row);
    }

    using Row = void (*)(const std::byte* from, std::byte* to, std::size_t texels);
    static constexpr Row copy_row = nullptr;

    /// Reads one buffer of all layers. `slot` is none for the depth and stencil buffer. `row`
    /// converts the driver's texels into texels of `bytes`; null: they are the same.
    Result read(Layers& layers, std::optional<std::size_t> slot, const Given& given,
                std::size_t bytes, Row row) {
        const auto rows = static_cast<std::size_t>(d_.height);
        const auto columns = static_cast<std::size_t>(d_.width);
        const auto count = static_cast<std::size_t>(d_.layers());
        const std::size_t given_row = columns * given.bytes;
        const std::size_t taken_row = columns * bytes;
        const bool direct = d_.shape.has_faces() && row == copy_row;
        Result layer;
        if (!direct) layer = pool_.take(given_row * rows);
        Result all = pool_.take(taken_row * rows * count);
        for (std::size_t i = 0; i < count; ++i) {
            const GLuint framebuffer = layers.one(static_cast<int>(i));
            if (slot) gl_.NamedFramebufferReadBuffer(framebuffer, attachment(*slot));
            gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
            std::byte* to = all->data() + i * taken_row * rows;
            gl_.ReadPixels(0, 0, d_.width, d_.height, given.format, given.type,
                           direct ? to : layer->data());
            if (direct) continue;
            if (row == copy_row) {
                flip_rows(layer->data(), to, taken_row, rows);
            } else if (d_.shape.has_faces()) {
                row(layer->data(), to, rows * columns);
            } else {
                for (std::size_t y = 0; y < rows; ++y) {
                    row(layer->data() + y * given_row, to + (rows - 1 - y) * taken_row, columns);
                }
            }
        }
        return all;
    }

    const GladGLContext& gl_;
    Target& target_;
    const TargetDescription& d_;
    ResultPool& pool_;
};

/// The bytes of a texel in the result, and in the memory through which frames are read.
struct ResultTexel {
    std::size_t result;
    std::size_t passing;
};

ResultTexel result_texel(const ShadedOutput& output) {
    return {output_type_size(output.type) * static_cast<std::size_t>(output.channels),
            given_output(output).bytes};
}

}  // namespace

std::size_t result_bytes(const TargetDescription& d) {
    std::size_t texel = 0;
    std::size_t passing = 0;  // of one layer and one buffer at a time
    const auto add = [&](std::size_t result, std::size_t through) {
        texel += result;
        passing = std::max(passing, through);
    };
    if (d.color) {
        const bool packed = d.format == Format::rgb565;
        add(packed ? 4 : texel_size(d.format), texel_size(d.format));
    }
    for (const ShadedOutput& output : d.outputs.by_slot()) {
        const ResultTexel bytes = result_texel(output);
        add(bytes.result, bytes.passing);
    }
    for (std::size_t i = 0; i < output_table.size(); ++i) {
        if (!d.outputs.has(i) || output_table[i].source == OutputSource::shader) continue;
        const std::size_t bytes = output_table[i].source == OutputSource::depth ? 4 : 1;
        add(bytes, bytes);
    }
    const std::size_t layer =
        static_cast<std::size_t>(d.width) * static_cast<std::size_t>(d.height);
    return layer * (texel * static_cast<std::size_t>(d.layers()) + passing);
}

Frame read_frame(const GladGLContext& gl, Target& target, ResultPool& pool) {
    const TargetDescription& d = target.description();
    Reader reader(gl, target, pool);
    Frame frame;
    frame.width = d.width;
    frame.height = d.height * d.layers();
    frame.format = d.format;
    if (d.color) frame.color = reader.picture();
    frame.outputs = reader.outputs();
    gl::check_gl(gl, "reading a frame");
    return frame;
}

std::shared_ptr<CubeMap> read_cube(const GladGLContext& gl, Target& target, ResultPool& pool,
                                   Encoding encoding) {
    const TargetDescription& d = target.description();
    Reader reader(gl, target, pool);
    Result color = reader.picture();
    OutputList outputs = reader.outputs();
    gl::check_gl(gl, "reading a cubemap");
    return std::make_shared<CubeMap>(d.width, 4, dtype_of(d.format), std::move(color), d.mipmaps,
                                     std::move(outputs), encoding);
}

}  // namespace cubecam
