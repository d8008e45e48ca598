#include "layers/shift_map.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parallel.h"

namespace stillwater {
namespace {

const std::array<cv::Point, 4> neighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

cv::Point as_point(const cv::Vec2s& shift) { return {shift[0], shift[1]}; }

struct Votes {
  cv::Vec2s shift;
  float weight;
};

class Seams {
 public:
  Seams(const InpaintLevel& level, const Mask& allowed, ShiftMap& shifts)
      : level_(level), allowed_(allowed), shifts_(shifts), inside_(cv::Point(), level.hole.size()), box_(cv::boundingRect(level.hole)) {}

  bool round(int colour) {
    std::atomic<bool> moved{false};
    parallel_rows(box_.height, 16, [&](int first, int last) {
      for (int y = box_.y + first; y < box_.y + last; ++y)
        for (int x = box_.x + ((box_.x + y + colour) & 1); x < box_.br().x; x += 2)
          if (level_.hole(y, x) && settle({x, y})) moved = true;
    });
    return moved;
  }

 private:
  cv::Vec2s shift_of(const cv::Point& p) const { return level_.hole(p) ? shifts_(p) : cv::Vec2s(0, 0); }

  int difference(const cv::Point& a, const cv::Point& b) const {
    const cv::Vec4b &one = level_.bytes(a.y, a.x), &other = level_.bytes(b.y, b.x);
    int sum = 0;
    for (int c = 0; c < 4; ++c) sum += (one[c] - other[c]) * (one[c] - other[c]);
    return sum;
  }

  // How a pair of neighbours shows: each seen with its own shift and with the other's.
  int seam(const cv::Point& p, const cv::Point& q, const cv::Vec2s& ours, const cv::Vec2s& theirs) const {
    if (ours == theirs) return 0;
    const cv::Point a = p + as_point(ours), b = p + as_point(theirs), c = q + as_point(ours), d = q + as_point(theirs);
    constexpr int unlike = 3 * 255 * 255 / 4;
    // A known pixel with shift 0 says nothing of the hole's own place.
    int cost = 0;
    cost += inside_.contains(b) && !level_.hole(b) ? difference(a, b) : level_.hole(q) ? unlike : 0;
    cost += inside_.contains(c) && !level_.hole(c) ? difference(c, d) : unlike;
    return cost;
  }

  std::int64_t energy(const cv::Point& p, const cv::Vec2s& shift) const {
    std::int64_t sum = 0;
    for (const cv::Point& step : neighbours) {
      const cv::Point q = p + step;
      if (inside_.contains(q)) sum += seam(p, q, shift, shift_of(q));
    }
    return sum;
  }

  bool settle(const cv::Point& p) {
    const cv::Vec2s now = shifts_(p);
    cv::Vec2s best = now;
    std::int64_t least = -1;
    for (const cv::Point& step : neighbours) {
      const cv::Point q = p + step;
      if (!inside_.contains(q) || !level_.hole(q)) continue;
      const cv::Vec2s other = shifts_(q);
      const cv::Point from = p + as_point(other);
      if (other == best || !inside_.contains(from) || !allowed_(from)) continue;
      if (least < 0) least = energy(p, now);
      const std::int64_t cost = energy(p, other);
      if (cost < least) best = other, least = cost;
    }
    shifts_(p) = best;
    return best != now;
  }

  const InpaintLevel& level_;
  const Mask& allowed_;
  ShiftMap& shifts_;
  cv::Rect inside_, box_;
};

}  // namespace

ShiftMap agreed_shifts(const MatchField& field, const Plane& weight, int patch, const Mask& hole) {
  ShiftMap shifts = ShiftMap::zeros(hole.size());
  const int half = patch / 2, left = field.area.x, top = field.area.y;
  const cv::Rect box = cv::boundingRect(hole);
  parallel_rows(box.height, 8, [&](int first, int last) {
    std::vector<Votes> votes;
    for (int y = box.y + first; y < box.y + last; ++y)
      for (int x = box.x; x < box.br().x; ++x) {
        if (!hole(y, x)) continue;
        votes.clear();
        for (int row = std::max(0, y - half - top); row <= std::min(field.area.height - 1, y + half - top); ++row)
          for (int column = std::max(0, x - half - left); column <= std::min(field.area.width - 1, x + half - left); ++column) {
            const float share = weight(row, column);
            if (share <= 0) continue;
            const cv::Vec2s& shift = field.offset(row, column);
            const auto known = std::find_if(votes.begin(), votes.end(), [&](const Votes& v) { return v.shift == shift; });
            if (known == votes.end()) votes.push_back({shift, share});
            else known->weight += share;
          }
        if (votes.empty()) continue;
        shifts(y, x) = std::max_element(votes.begin(), votes.end(), [](const Votes& a, const Votes& b) { return a.weight < b.weight; })->shift;
      }
  });
  return shifts;
}

void settle_seams(const InpaintLevel& level, const Mask& allowed, int rounds, ShiftMap& shifts, const std::function<void(double)>& at) {
  Seams seams(level, allowed, shifts);
  for (int i = 0; i < rounds; ++i) {
    const bool white = seams.round(0), black = seams.round(1);
    if (at) at((i + 1.0) / rounds);
    if (!white && !black) break;
  }
}

void copy_shifted(const ShiftMap& shifts, const Mask& hole, Rgba& colour) {
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x)
      if (hole(y, x)) colour(y, x) = colour(y + shifts(y, x)[1], x + shifts(y, x)[0]);
}

}  // namespace stillwater
