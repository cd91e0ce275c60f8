#include "cubecam/cubemap/cubemap_layout.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/parse_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace cubecam {

namespace {

std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name) {
        plain += c == '-' || c == ' '
                     ? '_'
                     : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return plain;
}

[[noreturn]] void refuse_name(const char* what, const std::string& names, std::string_view got) {
    throw std::invalid_argument(std::string(what) + ": expected " + names + ", got '" +
                                shortened(got) + "'");
}

/// Returns the value that a name stands for, whatever its letter case and its separators.
template <class Value, std::size_t N>
std::optional<Value> find_name(const NameTable<Value, N>& table, std::string_view name) {
    const std::string plain = plain_name(name);
    for (const auto& [known, value] : table) {
        if (plain_name(known) == plain) return value;
    }
    return std::nullopt;
}

/// How a convention shows the gl cube. Each conversion is its own inverse: a flip is, and the
/// exchange of +X and -X flips both faces in the same way.
FaceSource face_in_gl(Convention convention, Face face) {
    const bool vertical = face == Face::pos_y || face == Face::neg_y;
    switch (convention) {
        case Convention::gl: break;
        case Convention::inside: return {face, !vertical, vertical};
        case Convention::three:
            return {face == Face::pos_x   ? Face::neg_x
                    : face == Face::neg_x ? Face::pos_x
                                          : face,
                    true, false};
    }
    return {face, false, false};
}

struct Cell {
    Face face;
    int column;
    int row;
    bool turned;  ///< the face is turned by 180 degrees
};

std::array<Cell, face_count> layout_cells(Layout layout, Convention convention) {
    // A viewer inside who looks at -Z has +X to the right; in gl and three pictures +X is to the
    // right of +Z.
    const bool inside = convention == Convention::inside;
    const Face front = inside ? Face::neg_z : Face::pos_z;
    const Face back = inside ? Face::pos_z : Face::neg_z;
    switch (layout) {
        case Layout::cross:
        case Layout::vertical_cross: {
            const bool upright = layout == Layout::vertical_cross;
            return {{{Face::pos_x, 2, 1, false},
                     {Face::neg_x, 0, 1, false},
                     {Face::pos_y, 1, 0, false},
                     {Face::neg_y, 1, 2, false},
                     {front, 1, 1, false},
                     upright ? Cell{back, 1, 3, true} : Cell{back, 3, 1, false}}};
        }
        case Layout::row:
        case Layout::column: {
            std::array<Cell, face_count> cells{};
            for (int i = 0; i < face_count; ++i) {
                cells[static_cast<std::size_t>(i)] = layout == Layout::row
                                                         ? Cell{static_cast<Face>(i), i, 0, false}
                                                         : Cell{static_cast<Face>(i), 0, i, false};
            }
            return cells;
        }
        case Layout::equirect:
        case Layout::openexr: break;
    }
    throw std::invalid_argument("layout: expected cross, vertical_cross, row or column, got '" +
                                std::string(to_string(layout)) + "', which must be resampled");
}

/// Copies rows of texels; `from` and `to` point to the first row, and the strides are in bytes.
void copy_rows(const std::byte* from, std::size_t from_stride, std::byte* to, std::size_t to_stride,
               int size, std::size_t texel, bool flip_columns, bool flip_rows) {
    const auto count = static_cast<std::size_t>(size);
    for (std::size_t row = 0; row < count; ++row) {
        poll_interrupts();
        const std::byte* source = from + (flip_rows ? count - 1 - row : row) * from_stride;
        std::byte* target = to + row * to_stride;
        if (!flip_columns) {
            std::memcpy(target, source, count * texel);
            continue;
        }
        for (std::size_t column = 0; column < count; ++column) {
            std::memcpy(target + column * texel, source + (count - 1 - column) * texel, texel);
        }
    }
}

}  // namespace

Convention parse_convention(std::string_view name) {
    if (const auto found = find_name(convention_names, name)) return *found;
    refuse_name("convention", quoted_names(convention_names), name);
}

Layout parse_layout(std::string_view name) {
    if (const auto found = find_name(layout_names, name)) return *found;
    if (plain_name(name) == "horizontal_cross") return Layout::cross;
    refuse_name("layout", quoted_names(layout_names), name);
}

Center parse_center(std::string_view name) {
    if (const auto found = find_name(center_names, name)) return *found;
    refuse_name("center", quoted_names(center_names), name);
}

Face parse_face(std::string_view name) {
    if (const auto found = find_name(face_words, name)) return *found;
    refuse_name("face", "'+x', '-x', '+y', '-y', '+z' or '-z' (or 'px' ..., 'pos_x' ...)", name);
}

std::string_view to_string(Convention convention) {
    return convention_names[static_cast<std::size_t>(convention)].first;
}

std::string_view to_string(Layout layout) {
    return layout_names[static_cast<std::size_t>(layout)].first;
}

FaceSource face_source(Convention from, Convention to, Face face) {
    const FaceSource in_gl = face_in_gl(to, face);
    const FaceSource source = face_in_gl(from, in_gl.face);
    return {source.face, in_gl.flip_columns != source.flip_columns,
            in_gl.flip_rows != source.flip_rows};
}

void copy_face(const std::byte* from, int size, std::size_t texel, FaceSource flips,
               std::byte* to) {
    const std::size_t stride = static_cast<std::size_t>(size) * texel;
    copy_rows(from, stride, to, stride, size, texel, flips.flip_columns, flips.flip_rows);
}

PixelBuffer convert_faces(const std::byte* faces, int size, std::size_t texel, Convention from,
                          Convention to) {
    const std::size_t bytes =
        static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * texel;
    PixelBuffer result(bytes * face_count);
    for (const Face face : all_faces) {
        const FaceSource source = face_source(from, to, face);
        copy_face(faces + face_index(source.face) * bytes, size, texel, source,
                  result.data() + face_index(face) * bytes);
    }
    return result;
}

PictureSize layout_size(Layout layout, int face_size) {
    PictureSize cells{0, 0};
    for (const Cell& cell : layout_cells(layout, Convention::gl)) {
        cells.width = std::max(cells.width, cell.column + 1);
        cells.height = std::max(cells.height, cell.row + 1);
    }
    return {cells.width * face_size, cells.height * face_size};
}

Layout recognize_layout(int width, int height) {
    for (const Layout layout :
         {Layout::cross, Layout::vertical_cross, Layout::row, Layout::column}) {
        const PictureSize unit = layout_size(layout, 1);
        if (width > 0 && width % unit.width == 0 && height == width / unit.width * unit.height) {
            return layout;
        }
    }
    if (width > 0 && width % 2 == 0 && height == width / 2) return Layout::equirect;
    throw std::invalid_argument(
        "picture: expected width x height of 4:3 (cross), 3:4 (vertical_cross), 6:1 (row), 1:6 "
        "(column) or 2:1 (equirect), got " +
        std::to_string(width) + " x " + std::to_string(height));
}

int layout_face_size(Layout layout, int width, int height) {
    const PictureSize unit = layout_size(layout, 1);
    const int size = width / unit.width;
    if (size < 1 || width != size * unit.width || height != size * unit.height) {
        throw std::invalid_argument("picture: expected " + std::string(to_string(layout)) + ", " +
                                    std::to_string(unit.width) + "N x " +
                                    std::to_string(unit.height) + "N (width x height), got " +
                                    std::to_string(width) + " x " + std::to_string(height));
    }
    return size;
}

PixelBuffer faces_to_picture(const std::byte* faces, int size, std::size_t texel, Layout layout,
                             Convention convention) {
    const PictureSize picture = layout_size(layout, size);
    const std::size_t face_stride = static_cast<std::size_t>(size) * texel;
    const std::size_t stride = static_cast<std::size_t>(picture.width) * texel;
    const std::size_t face_bytes = face_stride * static_cast<std::size_t>(size);
    PixelBuffer result(stride * static_cast<std::size_t>(picture.height));
    for (std::size_t first = 0; first < result.size(); first += stride) {
        poll_interrupts();
        std::memset(result.data() + first, 0, stride);
    }
    for (const Cell& cell : layout_cells(layout, convention)) {
        copy_rows(faces + face_index(cell.face) * face_bytes, face_stride,
                  result.data() + static_cast<std::size_t>(cell.row * size) * stride +
                      static_cast<std::size_t>(cell.column * size) * texel,
                  stride, size, texel, cell.turned, cell.turned);
    }
    return result;
}

PixelBuffer picture_to_faces(const std::byte* picture, int width, int height, std::size_t texel,
                             Layout layout, Convention convention) {
    const int size = layout_face_size(layout, width, height);
    const std::size_t face_stride = static_cast<std::size_t>(size) * texel;
    const std::size_t stride = static_cast<std::size_t>(width) * texel;
    const std::size_t face_bytes = face_stride * static_cast<std::size_t>(size);
    PixelBuffer result(face_bytes * face_count);
    for (const Cell& cell : layout_cells(layout, convention)) {
        copy_rows(picture + static_cast<std::size_t>(cell.row * size) * stride +
                      static_cast<std::size_t>(cell.column * size) * texel,
                  stride, result.data() + face_index(cell.face) * face_bytes, face_stride, size,
                  texel, cell.turned, cell.turned);
    }
    return result;
}

}  // namespace cubecam
