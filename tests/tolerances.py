"""Every tolerance of the suite in one table, each with its reason; all other values are compared exactly.

A value passes when |got - expected| <= absolute + relative * |expected|, and the mean of the differences of all
compared values stays below `mean`. Silhouettes are masked, never given a wider tolerance.

Each entry says where it holds. Most hold on any driver. Those with `elsewhere` hold as they stand on llvmpipe alone,
which filters with float32 weights. On another driver this share of the range of the expected values is added, and
`mean` is not checked: GPUs weigh texels in steps of 1/256 (Direct3D and Vulkan require no finer ones). With
`elsewhere=None` the test is skipped on another driver. docs/gpu.md describes what holds on which driver.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Tolerance:
    absolute: float
    reason: str
    relative: float = 0.0
    mean: float = float("inf")
    elsewhere: float | None = 0.0
    outliers: float = 0.0  # this share of the values may be off by more,
    outlier: float = 0.0  # up to this


#: Weights rounded to 1/256 are off by up to 1/512 in each of three directions: across, down, between levels.
WEIGHTS = 3 / 512


TOLERANCES = {
    "exact": Tolerance(0.0, "copies, permutations and repeated draws change no bit"),
    "float32_maths": Tolerance(
        2e-6, "a handful of float32 operations on numbers of the size of 1", relative=2e-6
    ),
    "deformed": Tolerance(
        2e-5,
        "float32 sums of up to 12 joints and of displacements; a rasteriser rounds vertices to 1/256 pixel, which "
        "moves what is interpolated by 1e-4 of its slope for each pixel",
        mean=5e-6,
    ),
    "deformed_light": Tolerance(
        2e-3, "errors of 1e-5 in a normal, times the slope of a highlight", relative=2e-3, mean=1e-4
    ),
    "lookup": Tolerance(
        1e-5,
        "float32 bilinear weights: s * N of a 64-texel face keeps 17 bits below the point",
        relative=1e-5,
        elsewhere=WEIGHTS,
    ),
    "sky": Tolerance(
        1e-5,
        "directions of float32 from float64 rays, and a smooth cube of 16 texels: its slope is below 4 for a radian",
    ),
    "filtered_lookup": Tolerance(
        1e-5,
        "places among the faces of an atlas of 512 texels keep 14 bits below the point: weights are off by 6e-5, "
        "times the contrast of neighbours",
        relative=3e-4,
        mean=2e-4,
        elsewhere=WEIGHTS,
    ),
    "turned_lookup": Tolerance(
        1e-3,
        "a matrix of float32 turns by 1e-7, which a cube of noise from 1/20 to 20 makes 1e-4 of its greatest values",
        relative=1e-3,
        mean=5e-4,
        elsewhere=WEIGHTS,
    ),
    "resample": Tolerance(
        1e-4,
        "float32 trigonometry puts a sample up to 1e-6 of a turn off, on noise of slope 1 a texel",
        mean=1e-5,
    ),
    "mirror_ball": Tolerance(
        5e-3,
        "triangles of an icosphere stand for the ball, and a pixel is a mean of its footprint: 1/100 of a radian",
        mean=1e-3,
    ),
    "window": Tolerance(
        2e-3,
        "one ray through the middle of a pixel, and the mean of its footprint, on a smooth cube",
    ),
    "unorm8": Tolerance(0.51 / 255, "one rounding to 8 bits, and the float32 before it"),
    "unorm8_counts": Tolerance(
        1.0, "one count of 255: the value may lie on a rounding boundary", mean=0.05
    ),
    "unorm8_phong": Tolerance(
        0.51 / 255 + 1.5e-3, "Phong's own tolerance, and one rounding to 8 bits", mean=2e-3
    ),
    "depth32": Tolerance(2e-5, "window depth of what is seen, from a z of float32 arithmetic"),
    "unorm8_steps": Tolerance(
        2.6 / 255,
        "four translucent layers in 8 bits, each rounded, and once more to read",
        mean=0.004,
    ),
    "texture8": Tolerance(
        0.02, "a lookup in 8 bits of what was blended in 8 bits, times Phong's light", mean=6e-3
    ),
    "unorm8_blend": Tolerance(
        1.6 / 255, "source, factors and both products rounded to 8 bits, as llvmpipe blends them"
    ),
    "unorm8_filter": Tolerance(
        7e-3,
        "llvmpipe filters 8-bit textures in 8-bit arithmetic: weights of 1/256, rounded twice",
        relative=0.03,
        mean=2e-3,
    ),
    "srgb_filter": Tolerance(2e-3, "llvmpipe decodes sRGB by a polynomial", elsewhere=WEIGHTS),
    "unorm5": Tolerance(
        1.0 / 31 + 0.5 / 255,
        "llvmpipe cuts 8 bits to 5 for what it shades: the level below, not the nearest",
    ),
    "unorm6": Tolerance(1.0 / 63 + 0.5 / 255, "the same for 6 bits"),
    "half": Tolerance(
        1e-6, "float16 keeps 11 bits and may be rounded to zero: at most one unit", relative=2**-10
    ),
    "shaded": Tolerance(
        3e-4,
        "varyings of 32 bits interpolated over a pixel grid snapped to 1/256: positions are off by up to 1/512 pixel",
        relative=1e-4,
        mean=5e-5,
    ),
    "phong": Tolerance(
        1.5e-3,
        "the specular power of 10 multiplies the error of N and of the position, exp2/log2 of llvmpipe add 1e-4",
        mean=2e-4,
    ),
    "standard": Tolerance(
        2 / 255,
        "the mark of StandardMaterial: highlights multiply the error of N, and tables are looked up bilinearly",
        mean=1.5e-3,
    ),
    "distance": Tolerance(1e-4, "from interpolated float32 world positions", relative=1e-4),
    "window_depth": Tolerance(
        4e-6, "float32 depth of vertices snapped to 1/256 pixel, in 0..1, interpolated", mean=5e-7
    ),
    "depth16": Tolerance(
        1.0 / 65535 + 4e-6, "one step of 65535: the value may lie on a rounding boundary"
    ),
    "position": Tolerance(
        2e-4, "float32 interpolation with 1/256 sub-pixel vertices", relative=1e-4
    ),
    "normal": Tolerance(5e-4, "interpolated and normalised float32 normals on snapped vertices"),
    "mirror": Tolerance(
        4e-3,
        "a lookup in a smooth cube: the error of N, doubled by the reflection, times the cube's slope",
        relative=2e-3,
        mean=4e-4,
    ),
    "blend": Tolerance(2e-5, "three blends in float32", relative=2e-5),
    "tone": Tolerance(2e-4, "llvmpipe's exp2 and log2 are good to some 1e-5", mean=5e-5),
    "edge": Tolerance(
        0.06, "slope of the scene over one texel: two texel centres lie apart across an edge"
    ),
    "reference_image": Tolerance(
        1.0, "one count: processors round differently", mean=0.02, elsewhere=None
    ),
    "reference_image_of_another_mesa": Tolerance(
        1.0,
        "pictures are promised for one version of a driver: Mesa 26 draws 9 of 16,384 values of P09 up to 3 off",
        mean=0.02,
        elsewhere=None,
        outliers=1e-3,
        outlier=4.0,
    ),
}
