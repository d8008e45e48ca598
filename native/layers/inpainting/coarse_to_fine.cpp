#include "layers/inpainting/coarse_to_fine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "layers/inpainting/fill_front.h"
#include "layers/inpainting/frequent_shifts.h"
#include "layers/inpainting/graph_cut_shifts.h"
#include "layers/inpainting/shift_map.h"
#include "patches/patch_match.h"
#include "patches/vote.h"

namespace stillwater {
namespace {

constexpr int coarse_rounds = 3, fine_rounds = 1;  // of search and vote
constexpr int passes = 2;                          // of a search
constexpr double most_cut = 4000;                  // pixels of a hole that is cut anew
constexpr size_t most_found = 64, most_in_front = 200, most_frequent = 60, most_settled = 4000;  // shifts tried
constexpr int settled_reach = 8;
constexpr int settling_rounds = 30;
// How much less a patch counts for each pixel that it lies deeper in the hole (Wexler et al., 3.1).
constexpr double deeper = 1.3;
constexpr float deepest = 60;
// A patch counts at least exp(-this): a pixel that only misfits cover still gets what they say.
constexpr double least_likely = 20;

using At = std::function<void(double)>;

// How far a filling has come, made of parts that take some work each.
class Course {
 public:
  Course(const At& at, double whole) : at_(at), whole_(whole) {}

  At part(double work) {
    const double begin = done_;
    done_ += work;
    if (!at_) return {};
    return [this, begin, work](double share) { at_(std::min(1.0, (begin + share * work) / whole_)); };
  }

 private:
  const At& at_;
  double whole_, done_ = 0;
};

// Of a distance that three quarters of the matched patches stay below.
double usual_distance(const MatchField& field) {
  std::vector<int> distances;
  for (int y = 0; y < field.area.height; ++y)
    for (int x = 0; x < field.area.width; ++x)
      if (field.wanted(y, x) && field.distance(y, x) != MatchField::unmatched)
        distances.push_back(field.distance(y, x));
  if (distances.empty()) return 1;
  const auto quartile = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 3 / 4);
  std::nth_element(distances.begin(), quartile, distances.end());
  return std::max(1.0, static_cast<double>(*quartile));
}

// How much each patch counts: those near what is known and those that fit well more.
Plane weights_of(const MatchField& field, const Mask& hole) {
  Plane depth, weights = Plane::zeros(field.area.size());
  Mask padded;  // the picture's sides don't close a hole
  cv::copyMakeBorder(hole, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const double spread = 2 * usual_distance(field);
  parallel_rows(field.area.height, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < field.area.width; ++x) {
        if (!field.wanted(y, x) || field.distance(y, x) == MatchField::unmatched) continue;
        const double deep = std::min(deepest, depth(y + field.area.y + 1, x + field.area.x + 1));
        const double unlike = std::min(least_likely, field.distance(y, x) / spread);
        weights(y, x) = static_cast<float>(std::pow(deeper, -deep) * std::exp(-unlike));
      }
  });
  return weights;
}

void refresh_bytes(InpaintLevel& level) {
  parallel_rows(level.hole.rows, 64, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < level.hole.cols; ++x)
        if (level.hole(y, x)) level.bytes(y, x) = as_bytes(level.colour(y, x));
  });
}

// A field that begins with the shifts of the pixels at the patches' centres, or of the nearest pixel of the hole.
MatchField field_of(const ShiftMap& shifts, const InpaintLevel& level, int patch) {
  MatchField field = MatchField::of(centres_that_touch(level.hole, patch));
  const int half = patch / 2;
  parallel_rows(field.area.height, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < field.area.width; ++x) {
        if (!field.wanted(y, x)) continue;
        const cv::Point centre = cv::Point(x, y) + field.area.tl();
        field.offset(y, x) = shifts(centre);
        int nearest = level.hole(centre) ? 0 : std::numeric_limits<int>::max();
        for (int j = -half; j <= half && nearest > 0; ++j)
          for (int i = -half; i <= half; ++i)
            if (j * j + i * i < nearest && level.hole(centre.y + j, centre.x + i))
              nearest = j * j + i * i, field.offset(y, x) = shifts(centre.y + j, centre.x + i);
      }
  });
  return field;
}

class Filling {
 public:
  Filling(std::vector<InpaintLevel>& levels, const CoarseToFineParameters& parameters, const At& at)
      : levels_(levels), parameters_(parameters), cut_level_(cut_level()), course_(at, whole_work()) {}

  ShiftMap run() {
    const size_t last = levels_.size() - 1;
    const FillFrontParameters front{.patch = parameters_.patch, .seed = parameters_.seed};
    MatchField field =
        field_of(fill_front(levels_[last], front, course_.part(work(last))), levels_[last], parameters_.patch);
    for (size_t i = last;; --i) {
      for (int round = 0; round < rounds(i); ++round) {
        search(i, round, field);
        take_vote(levels_[i], field, course_.part(work(i)));
      }
      search(i, rounds(i), field);
      if (i == cut_level_) field = cut_anew(levels_[i], field);
      if (i == 0) return settled(levels_[0], field);
      field = finer(field, levels_[i - 1]);
    }
  }

 private:
  // The finest level on which cuts through the whole hole take little time.
  size_t cut_level() const {
    for (size_t i = 0; i < levels_.size(); ++i)
      if (work(i) <= most_cut) return i;
    return levels_.size() - 1;
  }

  int rounds(size_t level) const { return level < cut_level_ ? fine_rounds : coarse_rounds; }
  double work(size_t level) const { return cv::countNonZero(levels_[level].hole); }
  double cutting_work() const { return 40 * work(cut_level_); }

  double whole_work() const {
    double sum = work(levels_.size() - 1) + cutting_work() + 6 * work(0);
    for (size_t i = 0; i < levels_.size(); ++i) sum += work(i) * (2 * rounds(i) + 2);
    return sum;
  }

  void search(size_t level, int round, MatchField& field) {
    const PatchSearch how{.patch = parameters_.patch,
                          .rounds = passes,
                          .radius = levels_[level].radius,
                          .seed = parameters_.seed + 1000 * level + static_cast<std::uint64_t>(round)};
    patch_match(levels_[level].bytes, levels_[level].bytes, levels_[level].centres, field, how,
                course_.part(work(level)));
  }

  void take_vote(InpaintLevel& level, const MatchField& field, const At& at) const {
    vote(field, parameters_.patch, weights_of(field, level.hole), level.colour, level.hole, level.colour, at);
    refresh_bytes(level);
  }

  MatchField cut_anew(InpaintLevel& level, const MatchField& found) {
    ShiftMap shifts =
        agreed_shifts(found, weights_of(found, level.hole), parameters_.patch, level.hole, course_.part(0));
    const SeamCost cost(level);
    const std::vector<cv::Vec2s> tried = candidates(level, shifts);
    expand_shifts(cost, level.hole, tried, {.sweeps = 2}, shifts, course_.part(0.75 * cutting_work()));
    copy_shifted(shifts, level.hole, level.colour);
    refresh_bytes(level);
    MatchField field = field_of(shifts, level, parameters_.patch);
    search(cut_level_, rounds(cut_level_) + 1, field);
    return field;
  }

  std::vector<cv::Vec2s> candidates(const InpaintLevel& level, const ShiftMap& found) {
    std::vector<cv::Vec2s> shifts = most_used(found, level.hole, most_found);
    InpaintLevel other = level;
    other.bytes = PatchImage(level.colour);
    const ShiftMap front =
        fill_front(other, {.patch = parameters_.patch, .seed = parameters_.seed}, course_.part(0.15 * cutting_work()));
    const FrequentShiftsParameters frequent{
        .patch = parameters_.patch, .seed = parameters_.seed, .most = most_frequent};
    for (const std::vector<cv::Vec2s>& more : {most_used(front, level.hole, most_in_front),
                                               frequent_shifts(level, frequent, course_.part(0.1 * cutting_work()))})
      for (const cv::Vec2s& shift : more)
        if (std::find(shifts.begin(), shifts.end(), shift) == shifts.end()) shifts.push_back(shift);
    return shifts;
  }

  // The next level begins with what the field says there, sharp.
  MatchField finer(const MatchField& field, InpaintLevel& level) {
    MatchField large = twice_as_large(field, centres_that_touch(level.hole, parameters_.patch));
    for (int y = 0; y < large.area.height; ++y)
      for (int x = 0; x < large.area.width; ++x) {
        const cv::Point source =
            cv::Point(x, y) + large.area.tl() + cv::Point(large.offset(y, x)[0], large.offset(y, x)[1]);
        const bool there = cv::Rect(cv::Point(), level.hole.size()).contains(source) && level.centres(source);
        if (large.wanted(y, x) && there) large.distance(y, x) = 0;
      }
    take_vote(level, large, course_.part(work(0) / 2));
    return large;
  }

  ShiftMap settled(const InpaintLevel& level, const MatchField& field) {
    ShiftMap shifts =
        agreed_shifts(field, weights_of(field, level.hole), parameters_.patch, level.hole, course_.part(work(0)));
    const SeamCost cost(level);
    const ExpansionParameters nearby{.sweeps = 2, .reach = settled_reach};
    expand_shifts(cost, level.hole, most_used(shifts, level.hole, most_settled), nearby, shifts,
                  course_.part(3 * work(0)));
    settle_seams(cost, level.hole, settling_rounds, shifts, course_.part(work(0)));
    return shifts;
  }

  std::vector<InpaintLevel>& levels_;
  const CoarseToFineParameters& parameters_;
  size_t cut_level_;
  Course course_;
};

}  // namespace

ShiftMap fill_coarse_to_fine(std::vector<InpaintLevel>& levels, const CoarseToFineParameters& parameters,
                             const At& at) {
  return Filling(levels, parameters, at).run();
}

}  // namespace stillwater
