"""`stillwater.peel`: a picture taken apart, and put together again."""

import numpy as np
import pytest
import stillwater

SIZE = (40, 56)
Y, X = np.mgrid[:40, :56]


def scene():
    """A red soft disc and a blue soft disc before stripes: picture, mattes, and the stripes."""
    stripes = np.stack([0.2 + 0 * X, 0.3 + 0.3 * (X // 4 % 2), 0.2 + 0 * X], -1)
    discs = [np.clip(7.5 - np.hypot(X - x, Y - y), 0, 1).astype(np.float32) for x, y in ((18, 18), (38, 20))]
    picture = stripes
    for disc, colour in zip(reversed(discs), ([0.1, 0.1, 0.9], [0.9, 0.1, 0.1]), strict=True):
        picture = picture + disc[..., None] * (np.array(colour) - picture)
    return picture.astype(np.float32), discs, stripes


@pytest.mark.parametrize("fill", ["exemplar", "smooth", "none", ["exemplar", "none"]])
def test_layers_laid_over_each_other_are_the_picture(fill):
    picture, discs, _ = scene()
    layers = stillwater.peel(picture, discs, fill, patch=5)
    assert len(layers) == 3
    whole = layers[-1]
    for layer in reversed(layers[:-1]):
        whole = stillwater.over(layer, whole)
    np.testing.assert_allclose(whole[..., :3], picture, atol=2e-5)
    np.testing.assert_allclose(whole[..., 3], 1, atol=1e-5)


def test_colours_are_free_of_what_lies_behind():
    """Within 2 % of the truth, in the mean."""
    picture, discs, stripes = scene()
    red, blue, behind = stillwater.peel(picture, discs, patch=5)
    for layer, disc, colour in ((red, discs[0], [0.9, 0.1, 0.1]), (blue, discs[1], [0.1, 0.1, 0.9])):
        np.testing.assert_allclose(layer[..., 3], disc, atol=1e-6)
        assert abs(layer[..., :3] - colour)[disc > 0.05].mean() < 0.02
    seen = (discs[0] < 0.95) & (discs[1] < 0.95)
    assert abs(behind[..., :3] - stripes)[seen].mean() < 0.02
    assert abs(behind[..., :3] - stripes).mean() < 0.02  # the stripes go on


def test_a_painted_background_stands_behind():
    picture, discs, stripes = scene()
    *_, behind = stillwater.peel(picture, discs[:1], [stripes])
    inside = discs[0] == 1
    np.testing.assert_allclose(behind[inside][:, :3], stripes[inside], atol=1e-6)


def test_progress_and_cancel():
    picture, discs, _ = scene()
    told = []
    stillwater.peel(picture, discs, patch=5, progress=lambda phase, share: told.append(share) or True)
    assert told and min(told) >= 0 and max(told) <= 1
    with pytest.raises(stillwater.Cancelled):
        stillwater.peel(picture, discs, patch=5, progress=lambda phase, share: False)


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"fill": ["smooth"]}, "fill: 1 are not one for all, or one for each of 2 mattes"),
        ({"fill": "magic"}, r"fill\[0\]: 'magic' is not one of exemplar, smooth, none, or a painted background"),
        ({"mattes": [np.ones((4, 4))]}, r"mattes\[0\].matte: 4 x 4 is not the size of the picture"),
        ({"fill": np.ones((4, 4, 3))}, r"mattes\[0\].fill: 4 x 4 is not the size of the picture"),
        ({"patch": 4}, "patch: 4 is not odd"),
    ],
)
def test_what_does_not_fit_is_a_sentence(change, sentence):
    picture, discs, _ = scene()
    with pytest.raises(ValueError, match=sentence):
        stillwater.peel(**{"picture": picture, "mattes": discs, **change})
