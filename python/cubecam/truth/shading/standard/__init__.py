"""The metallic-roughness material of glTF 2.0 and its extensions, in float64.

Written from the specification's section 3.9 and appendix B, the texts of KHR_materials_* and the papers that they
name. Directions point away from the surface and have length 1; v goes to the viewer, l to the light, h lies half way.
A scalar of each pixel is an array (..., 1) or a number, so that it multiplies colours (..., 3).
"""
