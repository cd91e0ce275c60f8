"""Six files whose names tell their faces, in any order."""

import random

import pytest

from cubecam.io.cubemap_names import by_their_names

NAMES = {
    "dashes": "museum/{}.jpg pos-x neg-x pos-y neg-y pos-z neg-z",
    "short": "/sky/evening_{}.png px nx py ny pz nz",
    "capitals": "{}.TGA RT LF UP DN FT BK",
    "mixed": "a/posX{} posX negX posY negY posZ negZ",  # the folder has a name, too
    "signs": "x/+x{}.exr +x -x +y -y +z -z",
    "words": "left/{}.png right left top bottom front back",
    "digits": "6/face5_{}.png 0 1 2 3 4 5",
}


@pytest.mark.parametrize("key", NAMES)
def test_names_tell_the_faces(key):
    template, *faces = NAMES[key].split()
    files = [template.format(face) for face in faces]
    for seed in range(5):
        mixed = random.Random(seed).sample(files, 6)
        assert by_their_names(mixed) == files
    assert by_their_names(sorted(files)) == files


@pytest.mark.parametrize(
    "files",
    ["a b c d e f", "px nx py ny pz p", "px nx py ny pz px", "a/px a/nx a/py a/ny a/pz b/nz"],
)
def test_other_names_stay_in_their_order(files):
    assert by_their_names(files.split()) == files.split()
