#include "layers/cyclic.h"

#include "core/check.h"

namespace stillwater {
namespace {

Rgba continued_to_the_right(const Rgba& image) {
  const int side = image.cols, strip = cyclic_period(side) - side;
  Rgba whole(image.rows, side + strip);
  image.copyTo(whole.colRange(0, side));
  for (int y = 0; y < image.rows; ++y)
    for (int j = 0; j < strip; ++j) {
      const float t = (j + 0.5f) / strip, share = t * t * (3 - 2 * t);
      whole(y, side + j) = (1 - share) * image(y, side - 1 - j) + share * image(y, strip - 1 - j);
    }
  return whole;
}

}  // namespace

int cyclic_period(int side) { return side + (side + 3) / 4; }

Rgba make_cyclic(const Rgba& image, bool along_x, bool along_y) {
  check::not_empty("image", image);
  Rgba whole = along_x ? continued_to_the_right(image) : image;
  if (along_y) whole = Rgba(continued_to_the_right(whole.t()).t());
  return whole;
}

}  // namespace stillwater
