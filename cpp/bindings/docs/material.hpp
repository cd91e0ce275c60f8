/// Docstrings of cubecam.Material.
#pragma once

namespace cubecam::docs {

inline constexpr const char* material =
    R"doc(Base of the materials: how a surface reflects light.

Any number of nodes may share a material; all of them show a change of it. A colour is 3 or 4 linear
numbers, or a CSS name or "#rrggbb", which are sRGB; a fourth number, from 0 to 1, multiplies `opacity`.
A surface that is not fully opaque is blended over the surfaces behind it.

Every material takes these options by keyword, and has them as attributes:

======================  =========================================================================
opacity=1               from 0 to 1; multiplies the alpha of the colours
double_sided=False      True shows both sides; False culls back faces. Of a translucent mesh the
                        triangles that show their backs are drawn first, then the others
blend=None              how the material's colour S, of alpha a, is combined with D, the colour
                        that is already in the picture:
                        "opaque": S, with alpha 1;
                        "alpha": a S + (1 - a) D, alpha a + (1 - a) D;
                        "alpha_keep": the same colour; the alpha of D stays;
                        "additive": a S + D, alpha a + D;
                        "multiply": (1 - a + a S) D; the alpha of D stays;
                        "premultiplied": S + (1 - a) D in all four channels, for maps whose colour
                        is already multiplied by their alpha; opacity and the colour's alpha
                        multiply both;
                        a `Blend`: by its factors.
                        None: "alpha" if any part of the material is translucent, else "opaque"
depth_write=None        whether the surface hides farther surfaces that are drawn after it; None:
                        True if the blend is "opaque"; shadows do not depend on it
depth_test=True         False: the surface is drawn over nearer ones, too
color_write=True        which channels are written: one bool, or four (red, green, blue, alpha)
stencil=None            a `Stencil`: how the surface tests and changes the stencil buffer, if
                        ``depth_format`` has one; None: it does neither
flat_shading=False      True shows each triangle with the normal of its plane, in place of the mesh's
                        normals; see `Mesh.flat_shaded`
======================  =========================================================================

A surface that is blended, or writes no depth, is drawn after the background, far to near; it writes
colour and no other output. A mask, which writes a stencil but neither colour nor depth, is drawn among
the opaque nodes.
)doc";

}  // namespace cubecam::docs
