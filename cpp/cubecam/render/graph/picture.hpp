#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cubecam {

/// The kind of a picture. Of the pictures that do not depend on each other, those with the lower
/// kind come first. picture_kind.hpp lists the kinds; the graph does not depend on them.
enum class PictureKind : std::uint8_t;

/// Identifies a picture: equal values mean the same picture. The members are indices, not
/// addresses, so that the order of pictures depends only on the scenes.
struct PictureId {
    PictureKind kind{};
    std::size_t scene = 0;   ///< the number of the scene that it shows or belongs to
    std::size_t object = 0;  ///< the index among the scene's objects of its kind
    std::size_t bounce = 0;  ///< above 0: a further picture of the object, drawn from earlier ones
    std::shared_ptr<const PictureId>
        viewer;  ///< the picture that shows it, if each viewer needs another one; else null

    std::strong_ordering operator<=>(const PictureId& other) const;
    bool operator==(const PictureId& other) const { return (*this <=> other) == 0; }
};

/// A picture that the renderer draws and that other pictures may look up: a frame, a capture, a
/// probe's cube, a render texture or a light's shadow map.
///
/// The contents of a picture depend only on its keys (see key.hpp): `update` draws only the parts
/// whose keys have changed.
class Picture {
public:
    Picture() = default;
    virtual ~Picture() = default;
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// The pictures that this one might ever show, regardless of the view and of the update
    /// policies.
    virtual std::vector<PictureId> possible_dependencies() = 0;

    /// Plans this picture and returns the pictures that the plan shows: they are up to date before
    /// `update` is called. It runs once in a call of a renderer, since policies like every_n_frames
    /// count these runs.
    virtual std::vector<PictureId> dependencies() = 0;

    /// The pictures that a call brings up to date whenever it plans this one, before or after it.
    /// It runs after `dependencies`.
    virtual std::vector<PictureId> companions() { return {}; }

    /// Draws what has changed.
    virtual void update() = 0;

    /// Whether a circle that contains this picture is refused, since nothing can replace the
    /// picture there.
    virtual bool strict() const = 0;

    /// The name of the picture in messages, as number `place` of a chain, from 1; place 0 makes it
    /// the subject of the sentence. Empty if messages skip the picture.
    virtual std::string label(std::size_t place) const = 0;
};

}  // namespace cubecam
