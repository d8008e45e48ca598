#include "layers/inpainting/shift_map.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <opencv2/imgproc.hpp>
#include <map>
#include <utility>
#include <vector>

#include "core/parallel.h"

namespace stillwater {
namespace {

const std::array<cv::Point, 4> neighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

struct Votes {
  cv::Vec2s shift;
  float weight;
};

class Seams {
 public:
  Seams(const SeamCost& cost, const Mask& hole, ShiftMap& shifts)
      : cost_(cost), hole_(hole), shifts_(shifts), box_(cv::boundingRect(hole)) {}

  bool round(int colour) {
    std::atomic<bool> moved{false};
    parallel_rows(box_.height, 16, [&](int first, int last) {
      for (int y = box_.y + first; y < box_.y + last; ++y)
        for (int x = box_.x + ((box_.x + y + colour) & 1); x < box_.br().x; x += 2)
          if (hole_(y, x) && settle({x, y})) moved = true;
    });
    return moved;
  }

 private:
  std::int64_t energy(const cv::Point& p, const cv::Vec2s& shift) const {
    std::int64_t sum = cost_.far(shift);
    for (const cv::Point& step : neighbours) {
      const cv::Point q = p + step;
      if (cost_.contains(q)) sum += cost_(p, q, shift, shifts_(q));
    }
    return sum;
  }

  bool settle(const cv::Point& p) {
    const cv::Vec2s now = shifts_(p);
    cv::Vec2s best = now;
    std::int64_t least = -1;
    for (const cv::Point& step : neighbours) {
      const cv::Point q = p + step;
      if (!cost_.contains(q) || !hole_(q)) continue;
      const cv::Vec2s other = shifts_(q);
      if (other == best || !cost_.may_copy(p, other)) continue;
      if (least < 0) least = energy(p, now);
      const std::int64_t changed = energy(p, other);
      if (changed < least) best = other, least = changed;
    }
    shifts_(p) = best;
    return best != now;
  }

  const SeamCost& cost_;
  const Mask& hole_;
  ShiftMap& shifts_;
  cv::Rect box_;
};

}  // namespace

ShiftMap agreed_shifts(const MatchField& field, const Plane& weight, int patch, const Mask& hole,
                       const std::function<void(double)>& at) {
  ShiftMap shifts = ShiftMap::zeros(hole.size());
  const int half = patch / 2, left = field.area.x, top = field.area.y;
  const cv::Rect box = cv::boundingRect(hole);
  parallel_rows(
      box.height, 8,
      [&](int first, int last) {
        std::vector<Votes> votes;
        for (int y = box.y + first; y < box.y + last; ++y)
          for (int x = box.x; x < box.br().x; ++x) {
            if (!hole(y, x)) continue;
            votes.clear();
            for (int row = std::max(0, y - half - top); row <= std::min(field.area.height - 1, y + half - top); ++row)
              for (int column = std::max(0, x - half - left); column <= std::min(field.area.width - 1, x + half - left);
                   ++column) {
                const float share = weight(row, column);
                if (share <= 0) continue;
                const cv::Vec2s& shift = field.offset(row, column);
                const auto known =
                    std::find_if(votes.begin(), votes.end(), [&](const Votes& v) { return v.shift == shift; });
                if (known == votes.end())
                  votes.push_back({shift, share});
                else
                  known->weight += share;
              }
            if (votes.empty()) continue;
            shifts(y, x) = std::max_element(votes.begin(), votes.end(), [](const Votes& a, const Votes& b) {
                             return a.weight < b.weight;
                           })->shift;
          }
      },
      at);
  return shifts;
}

std::vector<cv::Vec2s> most_used(const ShiftMap& shifts, const Mask& hole, size_t most) {
  std::map<std::pair<int, int>, int> counts;
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x)
      if (hole(y, x)) ++counts[{shifts(y, x)[0], shifts(y, x)[1]}];
  std::vector<std::pair<std::pair<int, int>, int>> ordered(counts.begin(), counts.end());
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  ordered.resize(std::min(most, ordered.size()));
  std::vector<cv::Vec2s> used;
  for (const auto& [shift, count] : ordered)
    used.emplace_back(static_cast<short>(shift.first), static_cast<short>(shift.second));
  return used;
}

void settle_seams(const SeamCost& cost, const Mask& hole, int rounds, ShiftMap& shifts,
                  const std::function<void(double)>& at) {
  Seams seams(cost, hole, shifts);
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
