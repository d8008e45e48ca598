#include "layers/seam_cost.h"

#include <algorithm>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int border_at_all = 60;
constexpr int unlike = 100000;  // where one of them can't be seen

}  // namespace

SeamCost::SeamCost(const InpaintLevel& level)
    : level_(level), inside_(cv::Point(), level.hole.size()), squared_radius_(level.radius > 0 ? level.radius * level.radius : 1e18),
      looks_(level.hole.size()) {
  const auto light = [&](int y, int x) {
    const cv::Vec4b& pixel = level.bytes(y, x);
    return pixel[0] + 2 * pixel[1] + pixel[2];
  };
  // The known pixel next to a place in one direction, or the place itself.
  const auto beside = [&](int y, int x, int dy, int dx) {
    return is_known({x + dx, y + dy}) ? light(y + dy, x + dx) : light(y, x);
  };
  parallel_rows(level.hole.rows, 64, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < level.hole.cols; ++x) {
        Look& look = looks_(y, x);
        for (int c = 0; c < 4; ++c) look[c] = level.bytes(y, x)[c];
        look[4] = static_cast<short>((beside(y, x, 0, 1) - beside(y, x, 0, -1)) / 4);
        look[5] = static_cast<short>((beside(y, x, 1, 0) - beside(y, x, -1, 0)) / 4);
      }
  });
}

int SeamCost::difference(const cv::Point& a, const cv::Point& b) const {
  const Look &one = looks_(a), &other = looks_(b);
  int sum = 0;
  for (int c = 0; c < 6; ++c) sum += (one[c] - other[c]) * (one[c] - other[c]);
  return sum;
}

int SeamCost::operator()(const cv::Point& p, const cv::Point& q, const cv::Vec2s& shift_p, const cv::Vec2s& shift_q) const {
  if (shift_p == shift_q) return 0;
  const cv::Point s(shift_p[0], shift_p[1]), t(shift_q[0], shift_q[1]);
  const bool open = level_.hole(q) != 0;
  int cost = border_at_all;
  cost += is_known(q + s) ? difference(q + s, q + t) : unlike;
  // What a known neighbour would be in the hole nobody knows.
  if (open) cost += is_known(p + t) ? difference(p + s, p + t) : unlike;
  return open ? cost : 2 * cost;
}

}  // namespace stillwater
