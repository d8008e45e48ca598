#include "layers/matting/trimap.h"

#include "core/check.h"

namespace stillwater {
namespace {

constexpr float surely_foreground = 0.9f, surely_background = 0.1f;

unsigned char label_of(float grey) {
  if (grey >= surely_foreground) return known::foreground;
  return grey <= surely_background ? known::background : known::unknown;
}

}  // namespace

Trimap trimap_from_grey(const Plane& grey) {
  check::not_empty("trimap", grey);
  check::each_in_range("trimap", grey, 0, 1);
  Trimap trimap(grey.size());
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) trimap(y, x) = label_of(grey(y, x));
  return trimap;
}

Plane grey_of(const Trimap& trimap) {
  Plane grey(trimap.size());
  for (int y = 0; y < trimap.rows; ++y)
    for (int x = 0; x < trimap.cols; ++x)
      grey(y, x) = trimap(y, x) == known::unknown ? 0.5f : trimap(y, x) == known::foreground ? 1.0f : 0.0f;
  return grey;
}

TrimapCount count(const Trimap& trimap) {
  TrimapCount total;
  for (const unsigned char label : trimap)
    ++(label == known::foreground ? total.foreground : label == known::background ? total.background : total.unknown);
  return total;
}

}  // namespace stillwater
