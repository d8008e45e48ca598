#include "layers/inpainting/seam_cost.h"

#include <algorithm>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int border_at_all = 60;
constexpr int not_seen = 20000;  // what would be beside one of them lies outside the picture, or in the hole

constexpr short no_slope = 32767;  // beside a pixel lies the hole, or the picture's border

}  // namespace

SeamCost::SeamCost(const InpaintLevel& level)
    : level_(level),
      inside_(cv::Point(), level.hole.size()),
      squared_radius_(level.radius > 0 ? level.radius * level.radius : 1e18),
      looks_(level.hole.size()) {
  const auto light = [&](int y, int x) {
    const cv::Vec4b& pixel = level.bytes(y, x);
    return pixel[0] + 2 * pixel[1] + pixel[2];
  };
  const auto slope = [&](int y, int x, int dy, int dx) {
    if (!is_known({x + dx, y + dy}) || !is_known({x - dx, y - dy})) return no_slope;
    return static_cast<short>((light(y + dy, x + dx) - light(y - dy, x - dx)) / 4);
  };
  parallel_rows(level.hole.rows, 64, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < level.hole.cols; ++x) {
        Look& look = looks_(y, x);
        for (int c = 0; c < 4; ++c) look[c] = level.bytes(y, x)[c];
        look[4] = slope(y, x, 0, 1);
        look[5] = slope(y, x, 1, 0);
      }
  });
}

int SeamCost::difference(const cv::Point& a, const cv::Point& b) const {
  const Look &one = looks_(a), &other = looks_(b);
  int sum = 0;
  for (int c = 0; c < 4; ++c) sum += (one[c] - other[c]) * (one[c] - other[c]);
  for (int c = 4; c < 6; ++c)
    if (one[c] != no_slope && other[c] != no_slope) sum += (one[c] - other[c]) * (one[c] - other[c]);
  return sum;
}

int SeamCost::operator()(const cv::Point& p, const cv::Point& q, const cv::Vec2s& shift_p,
                         const cv::Vec2s& shift_q) const {
  if (shift_p == shift_q) return 0;
  const cv::Point s(shift_p[0], shift_p[1]), t(shift_q[0], shift_q[1]);
  const bool open = level_.hole(q) != 0;
  int cost = border_at_all;
  cost += is_known(q + s) ? difference(q + s, q + t) : not_seen;
  // What a known neighbour would be in the hole nobody knows.
  if (open) cost += is_known(p + t) ? difference(p + s, p + t) : not_seen;
  return open ? cost : 2 * cost;
}

}  // namespace stillwater
