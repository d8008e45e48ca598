"""A picture is found with the label map that lies beside it."""

import pytest
from find_pictures import pictures_with_maps


@pytest.mark.parametrize(
    "files, pairs",
    [
        (["image.png", "labels.png"], [("image.png", "labels.png")]),
        (["a.jpg", "a_mask.png", "b.jpg"], [("a.jpg", "a_mask.png")]),
        (["c_mask.jpg", "c_mask_dilated.jpg", "naive.jpg", "target.jpg"], [("naive.jpg", "c_mask.jpg")]),
        (["creek.jpg", "creek_mask.jpg", "target_mask.png"], [("creek.jpg", "creek_mask.jpg")]),
        (["a.png", "unmasked.png", "notes.txt"], []),
    ],
)
def test_pictures_and_their_maps(tmp_path, files, pairs):
    (tmp_path / "scene").mkdir()
    for name in files:
        (tmp_path / "scene" / name).touch()
    assert [(picture.name, labels.name) for picture, labels in pictures_with_maps(tmp_path)] == pairs
