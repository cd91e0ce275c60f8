"""Well-spread numbers for the paths: Sobol's first two dimensions, scrambled by Owen's method with a hash.

B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. Every number is a function of the seed, the pixel,
the sample and the dimension, so that neither tiles nor processes change a picture.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import Array

Words = npt.NDArray[np.uint32]

_HALVES = (
    (1, 0x55555555),
    (2, 0x33333333),
    (4, 0x0F0F0F0F),
    (8, 0x00FF00FF),
    (16, 0x0000FFFF),
)


def reversed_bits(words: Words) -> Words:
    """Give uint32 words with their 32 bits in the reverse order."""
    for shift, mask in _HALVES:
        words = ((words >> np.uint32(shift)) & np.uint32(mask)) | (
            (words & np.uint32(mask)) << np.uint32(shift)
        )
    return words


def hashed(*parts: npt.ArrayLike) -> Words:
    """Mix whole numbers into one uint32 each.

    Each part goes through the finaliser of MurmurHash3 (A. Appleby, 2011), so that neighbours share no pattern.
    """
    result = np.zeros((), np.uint32)
    with np.errstate(over="ignore"):
        for part in parts:
            word = np.asarray(part).astype(np.uint32)
            result = result * np.uint32(0x9E3779B9) + word + np.uint32(0x7F4A7C15)
            result = (result ^ (result >> np.uint32(16))) * np.uint32(0x85EBCA6B)
            result = (result ^ (result >> np.uint32(13))) * np.uint32(0xC2B2AE35)
            result = result ^ (result >> np.uint32(16))
    return result


def scrambled(words: Words, seeds: Words) -> Words:
    """Scramble words, as fractions of 2^32, by Owen's method: each bit is flipped as the bits above it say.

    The permutation is that of Laine and Karras with the constants of Burley, section 5.
    """
    x = reversed_bits(words)
    with np.errstate(over="ignore"):
        x = x + seeds
        x = x ^ (x * np.uint32(0x6C50B47C))
        x = x ^ (x * np.uint32(0xB82F1E52))
        x = x ^ (x * np.uint32(0xC7AFE638))
        x = x ^ (x * np.uint32(0x8D22F6E6))
    return reversed_bits(x)


def sobol(index: Words) -> tuple[Words, Words]:
    """Give the first two dimensions of Sobol's sequence as fractions of 2^32.

    The first is the index with its bits reversed. The matrix of the second is that of Pascal's triangle modulo 2,
    which is a Kronecker product of five 2 x 2 matrices.
    """
    first = reversed_bits(index)
    second = index
    for shift, mask in _HALVES:
        second = second ^ ((second >> np.uint32(shift)) & np.uint32(mask))
    return first, reversed_bits(second)


def pairs(pixel: npt.ArrayLike, sample: npt.ArrayLike, pair: npt.ArrayLike, seed: int) -> Array:
    """Give numbers (R, 2) from 0 to below 1 for pixels, samples and pairs of dimensions (R,).

    The samples 0 .. 2^k - 1 of a pixel and pair fill the square evenly: each is in a cell of its own of all
    2^a x 2^(k - a) cells. Different pixels and different pairs are independent.
    """
    own = hashed(seed, pixel, pair)
    index = scrambled(np.asarray(sample).astype(np.uint32), hashed(own, 1))
    first, second = sobol(index)
    both = np.stack([scrambled(first, hashed(own, 2)), scrambled(second, hashed(own, 3))], axis=-1)
    # 53 bits hold all 32, and no number becomes 1.
    return both.astype(np.float64) * 2.0**-32
