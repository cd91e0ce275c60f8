#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cubecam {

/// What sort of picture it is. Of pictures in one circle, those of the lower kind come first.
/// picture_kind.hpp lists them; the graph does not know them.
enum class PictureKind : std::uint8_t;

/// Which picture is meant: two with equal values are one. Places and no addresses, so that the
/// order of pictures is a function of the scenes alone.
struct PictureId {
    PictureKind kind{};
    std::size_t scene = 0;   ///< the number of the scene it is a picture of, or belongs to
    std::size_t object = 0;  ///< the place, among the scene's objects of its kind
    std::size_t bounce = 0;  ///< of a picture that is drawn from an earlier one of the same object
    std::shared_ptr<const PictureId>
        viewer;  ///< the picture that shows it, of what differs from viewer to viewer; else none

    std::strong_ordering operator<=>(const PictureId& other) const;
    bool operator==(const PictureId& other) const { return (*this <=> other) == 0; }
};

/// A frame, a capture, a probe's cube, a render texture, a light's shadow map: whatever is drawn,
/// and may be looked up by other pictures.
///
/// What a picture holds is a function of its keys (see key.hpp): `update` draws only what has
/// another key than what is there.
class Picture {
public:
    Picture() = default;
    virtual ~Picture() = default;
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// The pictures that this one might ever show, whatever is in view and whatever is due.
    virtual std::vector<PictureId> possible_dependencies() = 0;

    /// Plans this picture, and gives those that the plan shows: they are up to date before `update`
    /// is called. Called once in a call of a renderer, whose count policies like every_n_frames go
    /// by.
    virtual std::vector<PictureId> dependencies() = 0;

    /// Draws what has changed.
    virtual void update() = 0;

    /// Whether nothing can stand in for it where pictures go in circles, so that such a circle is
    /// refused.
    virtual bool strict() const = 0;

    /// What messages call it that is the `place`-th of a chain, from 1; at place 0 it is the
    /// sentence's subject. Empty if messages leave it out.
    virtual std::string label(std::size_t place) const = 0;
};

}  // namespace cubecam
