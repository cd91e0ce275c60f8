#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/image/encoding.hpp"
#include "cubecam/image/output_values.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/math/cube_face.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace cubecam {

/// The faces, filtered for one roughness: [6][M][M][C], in the cube's layout and type.
struct CubeLevel {
    int size = 0;  ///< M, texels along an edge
    float roughness = 0.0F;
    std::shared_ptr<const PixelBuffer> pixels;
};
/// Levels 1, 2, ... of a filtered cubemap, rougher and rougher; level 0 is the cube itself.
using CubeLevels = std::vector<CubeLevel>;

/// One state of a cubemap. It never changes, so threads may share it.
struct CubeMapData {
    int size;      ///< N, texels along an edge
    int channels;  ///< C: 1, 3 or 4
    DType dtype;
    bool mipmaps;  ///< lookups are trilinear
    Encoding encoding;
    std::shared_ptr<const PixelBuffer> pixels;  ///< [6][N][N][C], laid out as cube_face.hpp says
    std::array<std::uint64_t, face_count> face_revisions;
    std::uint64_t revision;  ///< of all faces: changes with each of them
    /// Null for a cubemap that nobody filtered.
    std::shared_ptr<const CubeLevels> levels = nullptr;

    std::size_t face_bytes() const {
        return static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
               static_cast<std::size_t>(channels) * dtype_size(dtype);
    }
    std::span<const std::byte> face_pixels(Face face) const {
        return {pixels->data() + face_index(face) * face_bytes(), face_bytes()};
    }
};

/// Six faces that surround a point. A CubeMap is a handle that threads may share; it points to one
/// CubeMapData after another. It does not use GL: the key of the renderer's copy consists of this
/// object and `face_revisions`.
class CubeMap {
public:
    /// All six faces, in "gl" layout.
    /// @throws std::invalid_argument unless size >= 1, channels is 1, 3 or 4 and the lengths of
    ///         `pixels` and of each output match.
    CubeMap(int size, int channels, DType dtype, PixelBuffer pixels, bool mipmaps = false,
            OutputList outputs = {}, Encoding encoding = Encoding::linear)
        : CubeMap(size, channels, dtype, std::make_shared<PixelBuffer>(std::move(pixels)), mipmaps,
                  std::move(outputs), encoding) {}
    /// Makes a cubemap of memory that already has a shared owner.
    CubeMap(int size, int channels, DType dtype, std::shared_ptr<PixelBuffer> pixels, bool mipmaps,
            OutputList outputs, Encoding encoding = Encoding::linear,
            std::shared_ptr<const CubeLevels> levels = nullptr);

    /// Makes an independent cubemap with the same contents and new revisions. The two share their
    /// pixels until one of them changes.
    CubeMap(const CubeMap& other);
    CubeMap& operator=(const CubeMap&) = delete;

    /// Returns the current state.
    std::shared_ptr<const CubeMapData> data() const;
    /// The revision of the state; reading it never waits for another thread.
    const Revision& revision() const { return revision_; }

    /// The outputs of a capture besides colour, [6][N][N][channels]. Only the constructor sets
    /// them.
    const OutputList& outputs() const { return outputs_; }

    /// Replaces one face ("gl" layout, this cube's size, channels and dtype). Only this face's
    /// revision changes, and none at all when the pixels are the same.
    /// @throws std::invalid_argument when the length does not match, or if the cube has filtered
    ///         levels, which would not belong to the new faces.
    void set_face(Face face, std::span<const std::byte> pixels);

    /// Looks up `count` directions (xyz each, from the center outwards, of any length but 0) and
    /// writes count * channels floats, uint8 as value/255.
    ///
    /// The numbers are those of GLSL textureLod with GL_LINEAR and GL_TEXTURE_CUBE_MAP_SEAMLESS (GL
    /// 4.6 section 8.14): texels beyond an edge belong to the neighbour face, and the fourth texel
    /// of a corner is the average of the other three. `lods` is null for level 0, otherwise it
    /// holds one level (`lod_count` 1) or `count` levels; the lookup is trilinear between
    /// box-filtered levels. Without mipmaps every level is level 0.
    void sample(const float* directions, std::size_t count, const float* lods,
                std::size_t lod_count, float* to) const;

    /// Levels 1, 2, ... down to 1x1, each [6][M][M][C] in the cube's dtype, M = max(1, size >> l):
    /// each texel is the average of the texels that it covers in the level before (weighted by area
    /// if a side is odd). `sample` and the renderer both use this chain, so that their numbers
    /// agree. It is empty without mipmaps.
    using MipChain = std::vector<PixelBuffer>;
    std::shared_ptr<const MipChain> mip_chain() const;

    /// Whether all contents, including captured outputs, are the same bit for bit. Revisions are
    /// not compared.
    bool same_contents(const CubeMap& other) const;

private:
    void set_data(CubeMapData data);

    mutable std::mutex mutex_;
    std::shared_ptr<const CubeMapData> data_;
    Revision revision_;  ///< of data_
    OutputList outputs_;
    mutable std::shared_ptr<const MipChain> mip_chain_;  ///< of data_; made on first use
};

/// Box-filtered levels of a state, whether it has mipmaps or not; see CubeMap::mip_chain.
CubeMap::MipChain make_mip_chain(const CubeMapData& data);

/// Like CubeMap::sample, for one state; `chain` may be null.
void sample_cube(const CubeMapData& data, const CubeMap::MipChain* chain, const float* directions,
                 std::size_t count, const float* lods, std::size_t lod_count, float* to);

}  // namespace cubecam
