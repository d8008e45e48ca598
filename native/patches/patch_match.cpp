#include "patches/patch_match.h"

#include <algorithm>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"
#include "patches/patch_distance.h"

namespace stillwater {
namespace {

constexpr int tile_side = 32;
constexpr int tiles_between_looks = 64;
constexpr int tries_by_chance = 16;

// A quick run of numbers from one place's random bits.
class Dice {
 public:
  explicit Dice(std::uint64_t bits) : bits_(bits | 1) {}

  // -reach .. reach.
  int within(int reach) {
    bits_ ^= bits_ << 13, bits_ ^= bits_ >> 7, bits_ ^= bits_ << 17;
    return static_cast<int>((bits_ >> 33) * static_cast<std::uint64_t>(2 * reach + 1) >> 31) - reach;
  }

 private:
  std::uint64_t bits_;
};

class Search {
 public:
  Search(const PatchImage& target, const PatchImage& source, const Mask& centres, MatchField& field,
         const PatchSearch& parameters)
      : distance_(target, source, parameters.patch),
        centres_(centres),
        field_(field),
        parameters_(parameters),
        squared_radius_(parameters.radius > 0 ? parameters.radius * parameters.radius : 1e18),
        squared_nearest_(parameters.nearest * parameters.nearest),
        longest_reach_(std::max(source.width(), source.height())) {
    if (parameters.radius > 0) longest_reach_ = std::min(longest_reach_, static_cast<int>(parameters.radius));
    for (int y = 0; y < field.area.height; y += tile_side)
      for (int x = 0; x < field.area.width; x += tile_side) {
        const cv::Rect tile = cv::Rect(x, y, tile_side, tile_side) & cv::Rect(cv::Point(), field.area.size());
        if (cv::countNonZero(field.wanted(tile)) > 0) tiles_.push_back(tile);
      }
  }

  void run(const std::function<void(double)>& at) {
    const int passes = parameters_.rounds + 1;
    for (int pass = 0; pass < passes; ++pass) {
      field_.offset.copyTo(before_);
      field_.distance.copyTo(distance_before_);
      const int count = static_cast<int>(tiles_.size());
      for (int first = 0; first < count; first += tiles_between_looks) {
        const int some = std::min(tiles_between_looks, count - first);
        parallel_rows(some, 1, [&](int from, int to) {
          for (int i = from; i < to; ++i) pass == 0 ? measure(tiles_[first + i]) : improve(tiles_[first + i], pass);
        });
        if (at) at((pass + static_cast<double>(first + some) / count) / passes);
      }
      if (pass == 0) find_lost(at);
    }
  }

 private:
  // The distances of the offsets that are given.
  void measure(const cv::Rect& tile) {
    for (int y = tile.y; y < tile.br().y; ++y)
      for (int x = tile.x; x < tile.br().x; ++x) {
        if (!field_.wanted(y, x)) continue;
        const cv::Vec2s given = field_.offset(y, x);
        field_.distance(y, x) = MatchField::unmatched;
        attempt(y, x, given);
      }
  }

  // Patches that begin nowhere take a place by chance, or the nearest where few are near enough.
  void find_lost(const std::function<void(double)>& at) {
    std::vector<cv::Point> lost, places;
    for (int y = 0; y < field_.area.height; ++y)
      for (int x = 0; x < field_.area.width; ++x)
        if (field_.wanted(y, x) && field_.distance(y, x) == MatchField::unmatched) lost.emplace_back(x, y);
    if (lost.empty()) return;
    cv::findNonZero(centres_, places);
    if (places.empty()) return;
    parallel_rows(
        static_cast<int>(lost.size()), 16,
        [&](int first, int last) {
          for (int i = first; i < last; ++i) find(lost[i], places);
        },
        at ? [&](double) { at(1.0 / (parameters_.rounds + 1)); } : std::function<void(double)>());
  }

  void find(const cv::Point& patch, const std::vector<cv::Point>& places) {
    const cv::Point target = patch + field_.area.tl();
    const auto offset_of = [&](const cv::Point& place) {
      return cv::Vec2s(static_cast<short>(place.x - target.x), static_cast<short>(place.y - target.y));
    };
    const int& distance = field_.distance(patch);
    for (int i = 0; i < tries_by_chance && distance == MatchField::unmatched; ++i) {
      const double share = random_uniform(parameters_.seed, {target.y, target.x, -1 - i});
      attempt(patch.y, patch.x, offset_of(places[static_cast<size_t>(share * static_cast<double>(places.size()))]));
    }
    if (distance != MatchField::unmatched) return;
    std::vector<cv::Point> reachable;
    for (const cv::Point& place : places)
      if (in_reach(offset_of(place))) reachable.push_back(place);
    if (reachable.empty()) return;
    const auto nearest =
        std::min_element(reachable.begin(), reachable.end(), [&](const cv::Point& a, const cv::Point& b) {
          return (a - target).ddot(a - target) < (b - target).ddot(b - target);
        });
    attempt(patch.y, patch.x, offset_of(*nearest));
  }

  void improve(const cv::Rect& tile, int pass) {
    const bool forwards = pass % 2 == 1;
    const int step = forwards ? -1 : 1;  // towards those that were visited before
    for (int i = 0; i < tile.height; ++i)
      for (int j = 0; j < tile.width; ++j) {
        const int y = forwards ? tile.y + i : tile.br().y - 1 - i, x = forwards ? tile.x + j : tile.br().x - 1 - j;
        if (!field_.wanted(y, x)) continue;
        ask(y, x, y, x + step, tile);
        ask(y, x, y + step, x, tile);
        look_around(y, x, pass);
      }
  }

  // What a neighbour found. Those in other tiles say what they knew when the round began.
  void ask(int y, int x, int row, int column, const cv::Rect& tile) {
    const cv::Point neighbour(column, row);
    if (tile.contains(neighbour)) {
      if (field_.wanted(neighbour) && field_.distance(neighbour) != MatchField::unmatched)
        attempt(y, x, field_.offset(neighbour));
    } else if (cv::Rect(cv::Point(), field_.area.size()).contains(neighbour) && field_.wanted(neighbour) &&
               distance_before_(neighbour) != MatchField::unmatched) {
      attempt(y, x, before_(neighbour));
    }
  }

  void look_around(int y, int x, int pass) {
    if (field_.distance(y, x) == MatchField::unmatched) return;
    Dice dice(random_bits(parameters_.seed, {y + field_.area.y, x + field_.area.x, pass}));
    for (int reach = longest_reach_; reach >= 1; reach /= 2) {
      const cv::Vec2s centre = field_.offset(y, x);
      const int dx = dice.within(reach), dy = dice.within(reach);
      attempt(y, x, {static_cast<short>(centre[0] + dx), static_cast<short>(centre[1] + dy)});
    }
  }

  bool in_reach(const cv::Vec2s& offset) const {
    const double apart = static_cast<double>(offset[0]) * offset[0] + static_cast<double>(offset[1]) * offset[1];
    return apart <= squared_radius_ && apart >= squared_nearest_;
  }

  void attempt(int y, int x, const cv::Vec2s& offset) {
    const cv::Point target = cv::Point(x, y) + field_.area.tl(), source = target + cv::Point(offset[0], offset[1]);
    if (source.x < 0 || source.y < 0 || source.x >= centres_.cols || source.y >= centres_.rows || !centres_(source))
      return;
    if (!in_reach(offset)) return;
    int& best = field_.distance(y, x);
    if (best != MatchField::unmatched && offset == field_.offset(y, x)) return;
    const int distance = distance_(target, source, best);
    if (distance < best) best = distance, field_.offset(y, x) = offset;
  }

  PatchDistance distance_;
  const Mask& centres_;
  MatchField& field_;
  PatchSearch parameters_;
  double squared_radius_, squared_nearest_;
  int longest_reach_;
  std::vector<cv::Rect> tiles_;
  cv::Mat_<cv::Vec2s> before_;
  cv::Mat_<int> distance_before_;
};

}  // namespace

void patch_match(const PatchImage& target, const PatchImage& source, const Mask& source_centres, MatchField& field,
                 const PatchSearch& search, const std::function<void(double)>& at) {
  if (!field.area.empty()) Search(target, source, source_centres, field, search).run(at);
}

}  // namespace stillwater
