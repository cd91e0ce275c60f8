#include "cubecam/render/readback.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/image/flip.hpp"
#include "cubecam/render/resources/repack.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace cubecam {
namespace {

using Result = std::shared_ptr<PixelBuffer>;

constexpr std::size_t filling_part = 4096;  // bytes

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

Given given_output(int channels, OutputType type) {
    if (type == OutputType::int32) return {GL_RED_INTEGER, GL_INT, 4};
    switch (channels) {
        case 1: return {GL_RED, GL_FLOAT, 4};
        case 2: return {GL_RG, GL_FLOAT, 8};
        default: return {GL_RGBA, GL_FLOAT, 16};
    }
}

/// Reads layers of a target. What `picture` and `output` are given has room for all layers of the
/// target, and is filled later: by `start`, or, where pixels travel, by `arrive`; it must exist
/// until then. All copies are requested first, and the GPU is waited for once; after `start` the
/// target may be drawn into again.
class Reader : public PixelsUnderWay {
public:
    /// `ring` is null for a driver that needs none.
    Reader(const GladGLContext& gl, Target& target, std::vector<int> layers, ResultPool& pool,
           ReadRing* ring)
        : gl_(gl), target_(target), d_(target.description()), layers_(std::move(layers)),
          pool_(pool), ring_(ring) {
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    }
    ~Reader() override {
        if (slot_ != nullptr) slot_->release();
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    void picture(std::byte* to) {
        Layers& layers = d_.post_processed        ? target_.post_processed_pass()
                         : target_.multisampled() ? target_.resolved()
                                                  : target_.color_pass();
        const bool packed = d_.format == Format::rgb565;
        const Given given{packed ? GLenum{GL_RGB} : GLenum{GL_RGBA}, gl_type(d_.format),
                          texel_size(d_.format)};
        if (!packed) return read(layers, 0, given, given.bytes, copy_row, to);
        read(
            layers, 0, given, 4,
            [](const std::byte* from, std::byte* row, std::size_t n) {
                widen_565(reinterpret_cast<const std::uint16_t*>(from), n,
                          reinterpret_cast<std::uint32_t*>(row));
            },
            to);
    }

    void output(const OutputKind& kind, std::byte* to) {
        switch (kind.source) {
            case OutputSource::shader: return read_shaded(kind, to);
            case OutputSource::depth: return read_depth(to);
            case OutputSource::stencil: return read_stencil(to);
        }
    }

    /// Returns whether all pixels are there; else they are under way.
    bool start() {
        if (ring_ == nullptr) {
            read_now(0);
        } else {
            request_all();
        }
        if (slot_ != nullptr) return false;
        for (const auto& turn : turns_) turn();
        return true;
    }

    void arrive() override {
        place_requested();
        for (const auto& turn : turns_) turn();
    }

private:
    void read_shaded(const OutputKind& kind, std::byte* to) {
        const Given given = given_output(kind.channels, kind.type);
        if (kind.channels != 3) {
            return read(target_.outputs(), kind.slot, given, given.bytes, copy_row, to);
        }
        read(
            target_.outputs(), kind.slot, given, 12,
            [](const std::byte* from, std::byte* row, std::size_t n) {
                drop_fourth(reinterpret_cast<const float*>(from), n, reinterpret_cast<float*>(row));
            },
            to);
    }

    /// Reads window-space z; the stored depth is reversed.
    void read_depth(std::byte* to) {
        const int bits = fixed_depth_bits(d_.depth_format);
        const float clear = depth_state(d_.depth_order).clear;
        const Given given{GL_DEPTH_COMPONENT,
                          bits == 0 ? GLenum{GL_FLOAT} : GLenum{GL_UNSIGNED_INT}, 4};
        read(target_.outputs(), std::nullopt, given, 4, copy_row, to);
        const std::size_t count =
            static_cast<std::size_t>(d_.width) * static_cast<std::size_t>(d_.height);
        for (const int number : layers_) {
            std::byte* const layer = to + static_cast<std::size_t>(number) * count * 4;
            turns_.push_back([layer, count, bits, clear] {
                if (bits == 0) {
                    turn_depth(reinterpret_cast<float*>(layer), count, clear);
                } else {
                    turn_fixed_depth(layer, count, bits, clear);
                }
            });
        }
    }

    void read_stencil(std::byte* to) {
        read(target_.outputs(), std::nullopt, {GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1}, 1, copy_row,
             to);
    }

    using Row = void (*)(const std::byte* from, std::byte* to, std::size_t texels);
    static constexpr Row copy_row = nullptr;

    /// Some rows of one buffer of one layer.
    struct Part {
        GLuint framebuffer;
        std::optional<std::size_t> slot;
        Given given;
        std::size_t bytes;  ///< of a texel of the result
        Row row;
        std::size_t first;  ///< row, from the bottom
        std::size_t rows;
        std::byte* to;
    };

    /// A call can be interrupted after so many bytes, which take a few milliseconds.
    static constexpr std::size_t most_of_part = std::size_t{16} << 20;

    /// Requests one buffer of the layers. `slot` is none for the depth and stencil buffer. `row`
    /// converts the driver's texels into texels of `bytes`; null: they are the same.
    void read(Layers& layers, std::optional<std::size_t> slot, const Given& given,
              std::size_t bytes, Row row, std::byte* to) {
        const auto rows = static_cast<std::size_t>(d_.height);
        const auto columns = static_cast<std::size_t>(d_.width);
        const std::size_t taken_row = columns * bytes;
        const std::size_t most =
            std::max<std::size_t>(most_of_part / (columns * given.bytes), std::size_t{1});
        for (const int number : layers_) {
            std::byte* const layer = to + static_cast<std::size_t>(number) * taken_row * rows;
            for (std::size_t first = 0; first < rows; first += most) {
                const std::size_t some = std::min(most, rows - first);
                const std::size_t above = d_.shape.has_faces() ? first : rows - first - some;
                parts_.push_back({layers.one(number), slot, given, bytes, row, first, some,
                                  layer + above * taken_row});
            }
        }
    }

    std::size_t given_bytes(const Part& part) const {
        return part.given.bytes * static_cast<std::size_t>(d_.width) * part.rows;
    }

    /// Copies a part into `to`: an address, or an offset into the bound buffer.
    void request(const Part& part, void* to) const {
        if (part.slot) gl_.NamedFramebufferReadBuffer(part.framebuffer, attachment(*part.slot));
        gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, part.framebuffer);
        gl_.ReadPixels(0, static_cast<GLint>(part.first), d_.width, static_cast<GLsizei>(part.rows),
                       part.given.format, part.given.type, to);
    }

    /// Reads the parts from a place of the list on, one after the other.
    void read_now(std::size_t first) {
        Result given;  // a part that is not read in place
        for (std::size_t i = first; i < parts_.size(); ++i) {
            const Part& part = parts_[i];
            poll_interrupts();
            if (d_.shape.has_faces() && part.row == copy_row) {
                request(part, part.to);
                continue;
            }
            const std::size_t bytes = given_bytes(part);
            if (given == nullptr || given->size() != bytes) given = pool_.take(bytes);
            request(part, given->data());
            place(part, given->data());
        }
    }

    /// Requests all parts. Those that the last buffer holds are then under way.
    void request_all() {
        while (end_ < parts_.size()) {
            poll_interrupts();
            if (slot_ != nullptr) place_requested();  // a large picture: one buffer after the other
            begun_ = end_++;
            std::size_t bytes = given_bytes(parts_[begun_]);
            while (end_ < parts_.size() &&
                   aligned(bytes) + given_bytes(parts_[end_]) <= ReadRing::most_bytes) {
                bytes = aligned(bytes) + given_bytes(parts_[end_++]);
            }
            try {
                slot_ = ring_->take(bytes);
            } catch (const GlError& error) {
                if (error.code() != GL_OUT_OF_MEMORY) throw;
                return read_now(begun_);
            }
            std::size_t offset = 0;
            for (std::size_t i = begun_; i < end_; ++i) {
                request(parts_[i], reinterpret_cast<void*>(offset));
                offset = aligned(offset + given_bytes(parts_[i]));
            }
            slot_->requested(gl_);
        }
    }

    /// Waits for the parts in the buffer, and copies them into their results.
    void place_requested() {
        const std::byte* held = slot_->wait(gl_);
        for (std::size_t i = begun_; i < end_; ++i) {
            place(parts_[i], held);
            held += aligned(given_bytes(parts_[i]));
        }
        ring_->give_back(*std::exchange(slot_, nullptr));
    }

    /// An offset must be a multiple of the size of a component (GL 4.5 section 18.2.2).
    static constexpr std::size_t aligned(std::size_t offset) { return (offset + 15) / 16 * 16; }

    /// Copies a part that the driver has written to `from` into its result.
    void place(const Part& part, const std::byte* from) const {
        const std::size_t rows = part.rows;
        const auto columns = static_cast<std::size_t>(d_.width);
        const std::size_t given_row = columns * part.given.bytes;
        const std::size_t taken_row = columns * part.bytes;
        if (d_.shape.has_faces()) {
            if (part.row == copy_row) {
                std::memcpy(part.to, from, taken_row * rows);
            } else {
                part.row(from, part.to, rows * columns);
            }
        } else if (part.row == copy_row) {
            flip_rows(from, part.to, taken_row, rows);
        } else {
            for (std::size_t y = 0; y < rows; ++y) {
                part.row(from + y * given_row, part.to + (rows - 1 - y) * taken_row, columns);
            }
        }
    }

    const GladGLContext& gl_;
    Target& target_;
    const TargetDescription d_;
    const std::vector<int> layers_;
    ResultPool& pool_;
    ReadRing* ring_;
    std::shared_ptr<ReadRing::Slot> slot_;  // of the parts that are under way; null: none are
    std::size_t begun_ = 0, end_ = 0;       // these parts
    std::vector<Part> parts_;
    std::vector<std::function<void()>> turns_;  // of the results, once they are read
};

ReadRing* needed(const gl::Context& context, ReadRing& ring) {
    return context.software() && !ReadRing::for_all_drivers ? nullptr : &ring;
}

/// Begins to read. A GPU goes on meanwhile; a software driver is waited for at a pace.
std::unique_ptr<PixelsUnderWay> begin(const gl::Context& context, std::unique_ptr<Reader> reader,
                                      const char* what) {
    if (context.software()) context.pace().finish(context.gl());
    const bool there = reader->start();
    gl::check_gl(context.gl(), what);
    return there ? nullptr : std::move(reader);
}

}  // namespace

std::vector<OutputKind> output_kinds(const Outputs& outputs) {
    std::vector<OutputKind> kinds;
    for (const ShadedOutput& output : outputs.by_slot()) {
        kinds.push_back({std::string(output.name), output.channels, output.type,
                         OutputSource::shader, output.slot});
    }
    for (std::size_t i = 0; i < output_table.size(); ++i) {
        const OutputRow& row = output_table[i];
        if (!outputs.has(i) || row.source == OutputSource::shader) continue;
        kinds.push_back({std::string(row.name), row.channels, row.type, row.source, 0});
    }
    return kinds;
}

std::size_t result_bytes(const TargetDescription& d) {
    std::size_t texel = 0;
    std::size_t passing = 0;  // of one layer and one buffer at a time
    if (d.color) {
        texel = color_bytes(d.format);
        passing = texel_size(d.format);
    }
    for (const OutputKind& kind : output_kinds(d.outputs)) {
        texel += kind.bytes();
        const std::size_t given = kind.source == OutputSource::shader
                                      ? given_output(kind.channels, kind.type).bytes
                                      : kind.bytes();
        passing = std::max(passing, given);
    }
    const std::size_t layer =
        static_cast<std::size_t>(d.width) * static_cast<std::size_t>(d.height);
    return layer * (texel * static_cast<std::size_t>(d.layers()) + passing);
}

namespace {

/// Reads a target into memory of the pool. The colour is null if there is none.
std::unique_ptr<PixelsUnderWay> start_all(const gl::Context& context, Target& target,
                                          ResultPool& pool, ReadRing& ring, Result& color,
                                          OutputList& outputs, const char* what) {
    const TargetDescription& d = target.description();
    const std::size_t texels = static_cast<std::size_t>(d.width) *
                               static_cast<std::size_t>(d.height) *
                               static_cast<std::size_t>(d.layers());
    std::vector<int> layers(static_cast<std::size_t>(d.layers()));
    std::iota(layers.begin(), layers.end(), 0);
    auto reader = std::make_unique<Reader>(context.gl(), target, std::move(layers), pool,
                                           needed(context, ring));
    if (d.color) {
        color = pool.take(texels * color_bytes(d.format));
        reader->picture(color->data());
    }
    for (const OutputKind& kind : output_kinds(d.outputs)) {
        outputs.push_back({kind.name, kind.channels, kind.type, pool.take(texels * kind.bytes())});
        reader->output(kind, outputs.back().values->data());
    }
    return begin(context, std::move(reader), what);
}

}  // namespace

Reading<Frame> start_frame(const gl::Context& context, Target& target, ResultPool& pool,
                           ReadRing& ring) {
    const TargetDescription& d = target.description();
    Reading<Frame> reading;
    Frame& frame = reading.result;
    frame.width = d.width;
    frame.height = d.height * d.layers();
    frame.format = d.format;
    reading.pixels =
        start_all(context, target, pool, ring, frame.color, frame.outputs, "reading a frame");
    return reading;
}

Reading<std::shared_ptr<CubeMap>> start_cube(const gl::Context& context, Target& target,
                                             ResultPool& pool, ReadRing& ring, Encoding encoding) {
    const TargetDescription& d = target.description();
    Result color;
    OutputList outputs;
    std::unique_ptr<PixelsUnderWay> pixels =
        start_all(context, target, pool, ring, color, outputs, "reading a cubemap");
    return {std::make_shared<CubeMap>(d.width, 4, dtype_of(d.format), std::move(color), d.mipmaps,
                                      std::move(outputs), encoding),
            std::move(pixels)};
}

ClearTexels read_texels(const gl::Context& context, Target& target, ResultPool& pool,
                        ReadRing& ring) {
    const auto cube = start_cube(context, target, pool, ring, Encoding::linear).finished();
    const TargetDescription& d = target.description();
    const auto first = [](const PixelBuffer& values, std::size_t bytes) {
        return std::vector<std::byte>(values.begin(),
                                      values.begin() + static_cast<std::ptrdiff_t>(bytes));
    };
    ClearTexels texels;
    texels.color = first(*cube->data()->pixels, color_bytes(d.format));
    const std::vector<OutputKind> kinds = output_kinds(d.outputs);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        texels.outputs.push_back(first(*cube->outputs()[i].values, kinds[i].bytes()));
    }
    return texels;
}

namespace {

/// Writes a texel so many times.
void fill(std::byte* to, std::size_t count, const std::vector<std::byte>& texel) {
    std::memcpy(to, texel.data(), texel.size());
    // The filled part doubles until it is as long as a page, which stays in the cache.
    const std::size_t part = filling_part / texel.size() * texel.size();
    const std::size_t bytes = count * texel.size();
    std::size_t filled = texel.size();
    while (filled < bytes) {
        const std::size_t next = std::min(std::min(filled, part), bytes - filled);
        std::memcpy(to + filled, to, next);
        filled += next;
    }
}

}  // namespace

void read_layers(const gl::Context& context, Target& target, const std::vector<bool>& drawn,
                 const ClearTexels& clear, ResultPool& pool, ReadRing& ring,
                 const LayerMemory& to) {
    const TargetDescription& d = target.description();
    const std::size_t texels =
        static_cast<std::size_t>(d.width) * static_cast<std::size_t>(d.height);
    const std::vector<OutputKind> kinds = output_kinds(d.outputs);
    std::vector<int> layers;
    for (std::size_t layer = 0; layer < drawn.size(); ++layer) {
        if (drawn[layer]) {
            layers.push_back(static_cast<int>(layer));
            continue;
        }
        poll_interrupts();
        if (d.color) {
            fill(to.color + layer * texels * clear.color.size(), texels, clear.color);
        }
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const std::vector<std::byte>& texel = clear.outputs[i];
            fill(to.outputs[i] + layer * texels * texel.size(), texels, texel);
        }
    }
    if (layers.empty()) return;
    auto reader =
        std::make_unique<Reader>(context.gl(), target, layers, pool, needed(context, ring));
    if (d.color) reader->picture(to.color);
    for (std::size_t i = 0; i < kinds.size(); ++i) reader->output(kinds[i], to.outputs[i]);
    const std::unique_ptr<PixelsUnderWay> pixels =
        begin(context, std::move(reader), "reading a batch");
    if (pixels != nullptr) pixels->arrive();
}

}  // namespace cubecam
