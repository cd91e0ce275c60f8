#include "cubecam/render/resources/gpu_cache.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/memory.hpp"
#include "cubecam/gl/large_texture.hpp"
#include "cubecam/image/flip.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/render/resources/node_record.hpp"
#include "cubecam/render/resources/probe_grid_block.hpp"
#include "cubecam/render/resources/sampler.hpp"
#include "cubecam/render/resources/view_record.hpp"

#include <glm/gtc/type_precision.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace cubecam {
namespace {

constexpr int texels_of_a_part = 1 << 20;

// docs/adr/0033-static-geometry.md has what was measured. A GPU takes a triangle in less than a
// tenth of the time that picking one takes, so that only small parts of large meshes pay.
constexpr PartCosts software_costs{2'000, 0.5, 3.0};
constexpr PartCosts hardware_costs{100'000, 0.02, 500.0};

struct TextureFormat {
    GLenum internal;
    GLenum format;
    GLenum type;
};

TextureFormat texture_format(DType dtype, int channels) {
    const GLenum format = channels == 1 ? GL_RED : channels == 3 ? GL_RGB : GL_RGBA;
    switch (dtype) {
        case DType::uint8:
            return {static_cast<GLenum>(channels == 1   ? GL_R8
                                        : channels == 3 ? GL_RGB8
                                                        : GL_RGBA8),
                    format, GL_UNSIGNED_BYTE};
        case DType::float16:
            return {static_cast<GLenum>(channels == 1   ? GL_R16F
                                        : channels == 3 ? GL_RGB16F
                                                        : GL_RGBA16F),
                    format, GL_HALF_FLOAT};
        case DType::float32: break;
    }
    return {static_cast<GLenum>(channels == 1   ? GL_R32F
                                : channels == 3 ? GL_RGB32F
                                                : GL_RGBA32F),
            format, GL_FLOAT};
}

void check_side(const gl::Context& context, const char* what, int side, int largest,
                const char* limit) {
    if (side <= largest) return;
    throw std::invalid_argument(std::string(what) + ": expected at most " +
                                std::to_string(largest) + " pixels a side (" + limit + " of " +
                                context.renderer() + "), got " + std::to_string(side));
}

void set_cube_filters(const GladGLContext& gl, GLuint texture, bool mipmaps) {
    Sampler sampler{{Wrap::clamp, Wrap::clamp}};
    if (mipmaps) sampler.min = MinFilter::linear_mipmap_linear;
    set_sampler(gl, texture, sampler);
}

/// One channel means grey, as everywhere in this library.
void set_swizzle(const GladGLContext& gl, GLuint texture, int channels) {
    if (channels != 1) return;
    const GLint grey[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    gl.TextureParameteriv(texture, GL_TEXTURE_SWIZZLE_RGBA, grey);
}

void set_attribute(const GladGLContext& gl, GLuint array, GLuint index, GLuint buffer,
                   GLint components, std::size_t offset) {
    gl.EnableVertexArrayAttrib(array, index);
    gl.VertexArrayAttribFormat(array, index, components, GL_FLOAT, GL_FALSE,
                               static_cast<GLuint>(offset));
    gl.VertexArrayAttribBinding(array, index, buffer);
}

void set_view_attributes(const GladGLContext& gl, GLuint array) {
    for (GLuint column = 0; column < 4; ++column) {
        set_attribute(gl, array, attribute::view_matrix + column, vertex_buffer::records, 4,
                      offsetof(ViewRecord, matrix) + column * sizeof(glm::vec4));
    }
    set_attribute(gl, array, attribute::view_eye, vertex_buffer::records, 4,
                  offsetof(ViewRecord, eye));
    set_attribute(gl, array, attribute::view_position, vertex_buffer::records, 4,
                  offsetof(ViewRecord, position));
    set_attribute(gl, array, attribute::view_forward, vertex_buffer::records, 4,
                  offsetof(ViewRecord, forward));
    gl.VertexArrayBindingDivisor(array, vertex_buffer::records, 1);
}

void set_node_attributes(const GladGLContext& gl, GLuint array) {
    const auto columns = [&](GLuint first, GLuint count, std::size_t offset) {
        for (GLuint column = 0; column < count; ++column) {
            set_attribute(gl, array, first + column, vertex_buffer::records, 4,
                          offset + column * sizeof(glm::vec4));
        }
    };
    columns(attribute::model, 4, offsetof(NodeRecord, model));
    columns(attribute::normal_matrix, 3, offsetof(NodeRecord, normal_matrix));
    columns(attribute::material, most_flat_constants, offsetof(NodeRecord, material));
    gl.EnableVertexArrayAttrib(array, attribute::id_and_label);
    gl.VertexArrayAttribIFormat(array, attribute::id_and_label, 2, GL_INT,
                                offsetof(NodeRecord, id_and_label));
    gl.VertexArrayAttribBinding(array, attribute::id_and_label, vertex_buffer::records);
    gl.VertexArrayBindingDivisor(array, vertex_buffer::records, 1);
}

/// The binding of a stream of vertices: each attribute has a vertex buffer of its own.
struct StreamPlace {
    GLuint attribute;
    GLuint buffer;
};

template <class Vector>
void upload_stream(const GladGLContext& gl, std::array<GLuint, 2> arrays, StreamPlace place,
                   const VertexStream<Vector>& from, GpuStream& to) {
    if (to.revision == from.revision) return;
    const bool first = to.revision == 0;
    to.revision = from.revision;
    if (!from.values) {
        for (const GLuint array : arrays) gl.DisableVertexArrayAttrib(array, place.attribute);
        to.bytes = 0;
        return;
    }
    const std::vector<Vector>& values = *from.values;
    const std::size_t bytes = values.size() * sizeof(Vector);
    if (to.writable && to.bytes == bytes) {
        gl.NamedBufferSubData(to.buffer.id(), 0, static_cast<GLsizeiptr>(bytes), values.data());
        return;
    }
    // A stream that was updated once will probably be updated again.
    to.writable = !first;
    to.bytes = bytes;
    to.buffer = gl::create_buffer(gl, bytes, values.data(),
                                  to.writable ? GLbitfield{GL_DYNAMIC_STORAGE_BIT} : 0U);
    for (const GLuint array : arrays) {
        gl.VertexArrayVertexBuffer(array, place.buffer, to.buffer.id(), 0, sizeof(Vector));
        set_attribute(gl, array, place.attribute, place.buffer, Vector::length(), 0);
    }
}

void upload_streams(const GladGLContext& gl, const MeshData& data, GpuMesh& mesh) {
    const std::array<GLuint, 2> arrays = {mesh.array.id(), mesh.instanced.id()};
    upload_stream(gl, arrays, {attribute::position, vertex_buffer::positions},
                  data.position_stream(), mesh.positions);
    upload_stream(gl, arrays, {attribute::normal, vertex_buffer::normals}, data.normal_stream(),
                  mesh.normals);
    upload_stream(gl, arrays, {attribute::uv, vertex_buffer::uvs}, data.uv_stream(), mesh.uvs);
    upload_stream(gl, arrays, {attribute::color, vertex_buffer::colors}, data.color_stream(),
                  mesh.colors);
    upload_stream(gl, arrays, {attribute::tangent, vertex_buffer::tangents}, data.tangent_stream(),
                  mesh.tangents);
    upload_stream(gl, arrays, {attribute::uv1, vertex_buffer::uvs1}, data.uv1_stream(), mesh.uvs1);
    mesh.revision = data.revision();
}

/// Uploads indices of 16 bits if these are enough for all vertices.
void upload_indices(const GladGLContext& gl, const MeshData& data, GpuMesh& mesh) {
    const std::vector<glm::uvec3>& triangles = *data.triangles();
    mesh.index_count = static_cast<GLsizei>(triangles.size() * 3);
    if (data.positions()->size() > std::size_t{1} << 16) {
        mesh.index_type = GL_UNSIGNED_INT;
        mesh.indices = gl::create_buffer(gl, std::span<const glm::uvec3>(triangles));
    } else {
        std::vector<glm::u16vec3> narrow(triangles.begin(), triangles.end());
        mesh.index_type = GL_UNSIGNED_SHORT;
        mesh.indices = gl::create_buffer(gl, std::span<const glm::u16vec3>(narrow));
    }
    gl.VertexArrayElementBuffer(mesh.array.id(), mesh.indices.id());
    gl.VertexArrayElementBuffer(mesh.instanced.id(), mesh.indices.id());
}

GpuMesh upload_mesh(const GladGLContext& gl, const MeshData& data) {
    GpuMesh mesh;
    mesh.array = gl::create_vertex_array(gl);
    mesh.instanced = gl::create_vertex_array(gl);
    upload_indices(gl, data, mesh);
    upload_streams(gl, data, mesh);
    set_view_attributes(gl, mesh.array.id());
    set_node_attributes(gl, mesh.instanced.id());
    return mesh;
}

std::vector<std::byte> three_times(const std::vector<std::byte>& grey) {
    std::vector<std::byte> rgb;
    rgb.reserve(3 * grey.size());
    for (const std::byte value : grey) rgb.insert(rgb.end(), 3, value);
    return rgb;
}

/// Rows that are copied between two looks for interrupts.
int rows_of_a_part(int width) { return std::max(1, texels_of_a_part / std::max(1, width)); }

GpuTexture upload_image(const gl::Context& context, const Image& image, bool decoded) {
    const GladGLContext& gl = context.gl();
    const bool mipmaps = image.sampler().mipmaps();
    const int width = image.width();
    const int height = image.height();
    TextureFormat format = texture_format(image.dtype(), image.channels());
    // The texture unit decodes before it filters, and alpha stays as it is. OpenGL has no such
    // format of one channel.
    const bool threefold = decoded && image.channels() == 1;
    if (decoded) {
        format.internal = image.channels() == 4 ? GL_SRGB8_ALPHA8 : GL_SRGB8;
        if (threefold) format.format = GL_RGB;
    }
    GpuTexture result{gl::make_large_texture(context, static_cast<double>(width) * height,
                                             [internal = format.internal, width, height,
                                              levels = mipmaps ? 0 : 1](const GladGLContext& of) {
                                                 return gl::create_texture_2d(of, internal, width,
                                                                              height, levels);
                                             }),
                      mipmaps};
    const GLuint id = result.texture.id();
    // The rows are reversed, since GL's texel (0, 0) is the bottom-left corner of a picture.
    const std::size_t row = static_cast<std::size_t>(width) *
                            static_cast<std::size_t>(image.channels()) * dtype_size(image.dtype());
    const int most = rows_of_a_part(width);
    for (int y = 0; y < height; y += most) {
        poll_interrupts();
        const int rows = std::min(most, height - y);
        const auto first = static_cast<std::size_t>(height - y - rows);
        std::vector<std::byte> pixels(row * static_cast<std::size_t>(rows));
        flip_rows(image.pixels()->data() + first * row, pixels.data(), row,
                  static_cast<std::size_t>(rows));
        if (threefold) pixels = three_times(pixels);
        gl.TextureSubImage2D(id, 0, 0, y, width, rows, format.format, format.type, pixels.data());
    }
    if (mipmaps) gl.GenerateTextureMipmap(id);
    set_sampler(gl, id, image.sampler());
    if (!decoded) set_swizzle(gl, id, image.channels());
    return result;
}

}  // namespace

GpuCache::GpuCache(const gl::Context& context)
    : context_(&context), gl_(&context.gl()), views_only_(gl::create_vertex_array(context.gl())) {
    set_view_attributes(*gl_, views_only_.id());
    // Rows are uploaded as numpy stores them, without padding.
    gl_->PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

const GpuMesh& GpuCache::mesh(const MeshData& mesh) {
    GpuMesh& held = meshes_.get(mesh.identity(), [&] { return upload_mesh(*gl_, mesh); });
    if (held.revision != mesh.revision()) upload_streams(*gl_, mesh, held);
    return held;
}

const PartCosts& GpuCache::part_costs() const {
    return context_->software() ? software_costs : hardware_costs;
}

const TriangleClusters* GpuCache::clusters(const MeshData& mesh, double wasted) {
    GpuMesh* held = meshes_.find(mesh.identity());
    if (held == nullptr) return nullptr;
    GpuMesh::Clusters& clusters = held->clusters;
    if (clusters.revision != mesh.position_stream().revision) {
        clusters = {mesh.position_stream().revision, calls_, 0.0, nullptr};
    }
    if (clusters.made) return clusters.made->finite() ? clusters.made.get() : nullptr;
    const auto triangles = static_cast<double>(mesh.triangles()->size());
    clusters.wasted += wasted;
    if (clusters.first == calls_ || clusters.wasted < part_costs().making * triangles) {
        return nullptr;
    }
    const double bytes = triangles * static_cast<double>(TriangleClusters::bytes_of_making);
    if (bytes > static_cast<double>(small_allocation) && bytes > 0.5 * memory_left().bytes) {
        clusters.wasted = 0.0;  // it looks again later
        return nullptr;
    }
    clusters.made = std::make_unique<const TriangleClusters>(*mesh.positions(), *mesh.triangles());
    return this->clusters(mesh, 0.0);
}

const GpuTexture& GpuCache::image(const std::shared_ptr<const Image>& image, bool colors) {
    const bool decoded = colors && image->decodes();
    return (decoded ? decoded_images_ : images_).get(image, [&] {
        check_side(*context_, "map", std::max(image->width(), image->height()),
                   context_->limits().max_texture_size, "GL_MAX_TEXTURE_SIZE");
        return upload_image(*context_, *image, decoded);
    });
}

const GpuTexture& GpuCache::cube(const CubeSnapshot& cube) {
    return upload(cubes_, cube, cube.data->mipmaps);
}

const GpuTexture& GpuCache::box_mipmaps(const CubeSnapshot& cube) {
    return cube.data->mipmaps ? this->cube(cube) : upload(box_mipmaps_, cube, true);
}

const GpuTexture& GpuCache::upload(WeakCache<CubeMap, GpuCube>& to, const CubeSnapshot& cube,
                                   bool mipmaps) {
    const CubeMapData& data = *cube.data;
    const TextureFormat format = texture_format(data.dtype, data.channels);
    GpuCube& entry = to.get(cube.object, [&] {
        check_side(*context_, "cubemap", data.size, context_->limits().max_cube_map_texture_size,
                   "GL_MAX_CUBE_MAP_TEXTURE_SIZE");
        const int levels = mipmaps ? gl::mip_levels(data.size, data.size) : 1;
        GpuCube made{{gl::make_large_texture(*context_, 6.0 * data.size * data.size,
                                             [internal = format.internal, size = data.size,
                                              levels](const GladGLContext& of) {
                                                 return gl::create_texture_cube(of, internal, size,
                                                                                levels);
                                             }),
                      mipmaps},
                     {}};
        set_cube_filters(*gl_, made.texture.texture.id(), mipmaps);
        set_swizzle(*gl_, made.texture.texture.id(), data.channels);
        return made;
    });
    const GLuint id = entry.texture.texture.id();
    const auto upload = [&](int level, std::size_t face, int size, const std::byte* pixels) {
        const std::size_t row = static_cast<std::size_t>(size) *
                                static_cast<std::size_t>(data.channels) * dtype_size(data.dtype);
        const int most = rows_of_a_part(size);
        for (int y = 0; y < size; y += most) {
            poll_interrupts();
            gl_->TextureSubImage3D(id, level, 0, y, static_cast<GLint>(face), size,
                                   std::min(most, size - y), 1, format.format, format.type,
                                   pixels + static_cast<std::size_t>(y) * row);
        }
    };
    const bool changed = entry.face_revisions != data.face_revisions;
    // The levels are computed on the CPU, so that CubeMap::sample and a shader see the same
    // numbers.
    const CubeMap::MipChain chain = mipmaps && changed ? make_mip_chain(data) : CubeMap::MipChain{};
    for (std::size_t face = 0; face < all_faces.size(); ++face) {
        if (entry.face_revisions[face] == data.face_revisions[face]) continue;
        entry.face_revisions[face] = {};  // a look for interrupts may end the upload in its middle
        upload(0, face, data.size, data.face_pixels(all_faces[face]).data());
        for (std::size_t level = 1; level <= chain.size(); ++level) {
            const PixelBuffer& pixels = chain[level - 1];
            const int size = std::max(1, data.size >> level);
            upload(static_cast<int>(level), face, size,
                   pixels.data() + face * (pixels.size() / all_faces.size()));
        }
        entry.face_revisions[face] = data.face_revisions[face];
    }
    if (changed) gl::check_gl(*gl_, "uploading a cubemap");
    return entry.texture;
}

const GpuProbeGrid& GpuCache::probe_grid(const ProbeGridSnapshot& grid) {
    GpuProbeGrid& entry = probe_grids_.get(grid.object, [] { return GpuProbeGrid(); });
    if (entry.revision == grid.revision) return entry;
    entry = {};  // frees the old memory first
    const GridPicture light = light_picture(grid.value);
    const GridPicture distances = distances_picture(grid.value);
    check_side(*context_, "probe grid", std::max(distances.height, distances.width),
               context_->limits().max_texture_size, "GL_MAX_TEXTURE_SIZE");
    entry.light = gl::create_texture_2d(*gl_, GL_RGBA32F, light.width, light.height);
    gl_->TextureSubImage2D(entry.light.id(), 0, 0, 0, light.width, light.height, GL_RGBA, GL_FLOAT,
                           light.numbers.data());
    entry.distances = gl::create_texture_2d(*gl_, GL_RG32F, distances.width, distances.height);
    gl_->TextureSubImage2D(entry.distances.id(), 0, 0, 0, distances.width, distances.height, GL_RG,
                           GL_FLOAT, distances.numbers.data());
    gl_->TextureParameteri(entry.distances.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl::check_gl(*gl_, "uploading a probe grid");
    entry.revision = grid.revision;
    return entry;
}

void GpuCache::sweep() {
    ++calls_;
    meshes_.sweep();
    images_.sweep();
    decoded_images_.sweep();
    cubes_.sweep();
    box_mipmaps_.sweep();
    probe_grids_.sweep();
}

}  // namespace cubecam
