#include "layers/inpaint.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <map>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "layers/blend_seams.h"
#include "layers/fill_front.h"
#include "layers/frequent_shifts.h"
#include "layers/graph_cut_shifts.h"
#include "layers/inpaint_level.h"
#include "layers/shift_map.h"
#include "patches/patch_distance.h"
#include "patches/patch_match.h"
#include "patches/vote.h"

namespace stillwater {
namespace {

constexpr int least_patch = 3;
const int coarse_rounds = getenv("CR") ? atoi(getenv("CR")) : 6, fine_rounds = getenv("FR") ? atoi(getenv("FR")) : 2;  // of search and vote
constexpr int seam_rounds = 30;
constexpr double most_cut = 10000;
const size_t most_candidates = getenv("MC") ? atoi(getenv("MC")) : 64, most_frequent = getenv("MF") ? atoi(getenv("MF")) : 60;
// How much less a patch counts for each pixel that it lies deeper in the hole (Wexler et al., 3.1).
constexpr double deeper = 1.3;

// How far a filling has come: the levels' pixels weigh alike.
class Course {
 public:
  Course(Progress& progress, double whole) : progress_(progress), whole_(whole) {}

  // A part that takes `work` of the whole, told its own share done.
  std::function<void(double)> part(double work) {
    const double begin = done_;
    done_ += work;
    return [this, begin, work](double share) { progress_.at((begin + share * work) / whole_); };
  }

 private:
  Progress& progress_;
  double whole_, done_ = 0;
};

bool is_finite(const cv::Vec4f& pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]) && std::isfinite(pixel[3]);
}

void check_numbers(const Rgba& picture, const Mask& hole) {
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (!hole(y, x) && !is_finite(picture(y, x)))
        throw BadInput("picture: pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is not a finite number");
}

Mask as_mask(std::string_view name, const Plane& plane) {
  Mask mask(plane.size());
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x) {
      if (std::isnan(plane(y, x)))
        throw BadInput(std::string(name) + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is not a finite number");
      mask(y, x) = plane(y, x) >= 0.5f ? 255 : 0;
    }
  return mask;
}

void check_parameters(const InpaintParameters& parameters) {
  check::in_range("patch", parameters.patch, least_patch, largest_patch, "px");
  if (parameters.patch % 2 == 0) throw BadInput("patch: " + std::to_string(parameters.patch) + " is not odd (px)");
  if (parameters.radius) check::positive("radius", *parameters.radius, "px");
  check::in_range("grow", parameters.grow, 0, 1000, "px");
}

// The pixels that may be copied.
Mask allowed_pixels(const Mask& hole, const InpaintParameters& parameters) {
  Mask barred;
  const int side = 2 * parameters.grow + 1;
  cv::dilate(hole, barred, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(side, side)));
  Mask allowed = barred == 0;
  if (parameters.source) allowed &= as_mask("source", *parameters.source);
  return allowed;
}

void check_sources(const InpaintLevel& level, const InpaintParameters& parameters) {
  std::ostringstream sentence;
  if (cv::countNonZero(level.centres) == 0) {
    sentence << (parameters.source ? "source" : "hole") << ": there is no patch of " << parameters.patch << " x "
             << parameters.patch << " px to copy from, " << parameters.grow << " px or more from the hole";
    throw BadInput(sentence.str());
  }
  if (!parameters.radius) return;
  const Remoteness remote = most_remote(level, parameters.patch);
  if (remote.distance <= *parameters.radius) return;
  sentence << "radius: within " << *parameters.radius << " px of (" << remote.centre.x << ", " << remote.centre.y
           << ") there is nothing to copy from; the nearest is " << std::ceil(remote.distance) << " px away";
  throw BadInput(sentence.str());
}

// How much each patch counts: those near what is known and those that fit well more.
Plane weights_of(const MatchField& field, const Mask& hole) {
  cv::Mat_<float> depth;
  Mask padded;
  cv::copyMakeBorder(hole, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  std::vector<int> distances;
  for (int y = 0; y < field.area.height; ++y)
    for (int x = 0; x < field.area.width; ++x)
      if (field.wanted(y, x) && field.distance(y, x) != MatchField::unmatched) distances.push_back(field.distance(y, x));
  Plane weights = Plane::zeros(field.area.size());
  if (distances.empty()) return weights;
  const auto quartile = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 3 / 4);
  std::nth_element(distances.begin(), quartile, distances.end());
  const double spread = std::max(1.0, static_cast<double>(*quartile));
  parallel_rows(field.area.height, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < field.area.width; ++x) {
        if (!field.wanted(y, x) || field.distance(y, x) == MatchField::unmatched) continue;
        const double deep = std::min(60.0f, depth(y + field.area.y + 1, x + field.area.x + 1));
        weights(y, x) = static_cast<float>(std::pow(deeper, -deep) * std::exp(-field.distance(y, x) / (2 * spread)));
      }
  });
  return weights;
}

void refresh_bytes(InpaintLevel& level) {
  for (int y = 0; y < level.hole.rows; ++y)
    for (int x = 0; x < level.hole.cols; ++x)
      if (level.hole(y, x)) level.bytes(y, x) = as_bytes(level.colour(y, x));
}

// The shifts that most pixels have, most first.
std::vector<cv::Vec2s> most_used(const ShiftMap& shifts, const Mask& hole, size_t most) {
  std::map<std::pair<int, int>, int> count;
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x)
      if (hole(y, x)) ++count[{shifts(y, x)[0], shifts(y, x)[1]}];
  std::vector<std::pair<std::pair<int, int>, int>> all(count.begin(), count.end());
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<cv::Vec2s> used;
  for (size_t i = 0; i < std::min(most, all.size()); ++i)
    used.push_back({static_cast<short>(all[i].first.first), static_cast<short>(all[i].first.second)});
  return used;
}

// A field that begins with the shifts of the pixels at the patches' centres, or of the nearest pixel of the hole.
MatchField field_of(const ShiftMap& shifts, const InpaintLevel& level, int patch) {
  MatchField field = MatchField::of(centres_that_touch(level.hole, patch));
  const int half = patch / 2;
  for (int y = 0; y < field.area.height; ++y)
    for (int x = 0; x < field.area.width; ++x) {
      const cv::Point centre = cv::Point(x, y) + field.area.tl();
      if (!field.wanted(y, x)) continue;
      int nearest = std::numeric_limits<int>::max();
      for (int j = -half; j <= half; ++j)
        for (int i = -half; i <= half; ++i)
          if (j * j + i * i < nearest && level.hole(centre.y + j, centre.x + i))
            nearest = j * j + i * i, field.offset(y, x) = shifts(centre.y + j, centre.x + i);
    }
  return field;
}

class Filling {
 public:
  Filling(std::vector<InpaintLevel>& levels, const InpaintParameters& parameters, Progress& progress)
      : levels_(levels), parameters_(parameters), course_(progress, whole_work()) {}

  MatchField run() {
    const size_t last = levels_.size() - 1;
    const FillFrontParameters front{.patch = parameters_.patch, .seed = parameters_.seed};
    const ShiftMap shifts = fill_front(levels_[last], front, course_.part(work(last)));
    MatchField field = field_of(shifts, levels_[last], parameters_.patch);
    for (size_t i = last;; --i) {
      for (int round = 0; round < rounds(i); ++round) {
        search(i, round, field);
        vote(field, parameters_.patch, weights_of(field, levels_[i].hole), levels_[i].colour, levels_[i].hole, levels_[i].colour);
        refresh_bytes(levels_[i]);
      }
      if (i == structure_level()) {
        search(i, rounds(i), field);
        field = cut_anew(levels_[i], field);
      }
      if (i == 0) break;
      field = finer(field, levels_[i - 1]);
    }
    search(0, rounds(0), field);
    return field;
  }

 private:
  int rounds(size_t level) const { return level == 0 ? fine_rounds : coarse_rounds; }
  double work(size_t level) const { return cv::countNonZero(levels_[level].hole); }

  double whole_work() const {
    double sum = work(levels_.size() - 1);
    for (size_t i = 0; i < levels_.size(); ++i) sum += work(i) * (rounds(i) + (i == 0 ? 1 : 0));
    return sum;
  }

  void search(size_t, int round, MatchField& field, InpaintLevel& level) {
    patch_match(level.bytes, level.bytes, level.centres, field, {.patch = parameters_.patch, .rounds = 1, .radius = level.radius, .seed = parameters_.seed + static_cast<std::uint64_t>(round)});
  }

  void search(size_t level, int round, MatchField& field) {
    const PatchSearch how{.patch = parameters_.patch, .rounds = 2, .radius = levels_[level].radius,
                          .seed = parameters_.seed + 1000 * level + static_cast<std::uint64_t>(round)};
    patch_match(levels_[level].bytes, levels_[level].bytes, levels_[level].centres, field, how, course_.part(work(level)));
  }

  // The finest level on which cuts through the whole hole take little time.
  size_t structure_level() const {
    for (size_t i = 0; i < levels_.size(); ++i)
      if (work(i) <= most_cut) return i;
    return levels_.size() - 1;
  }

  MatchField cut_anew(InpaintLevel& level, const MatchField& found) {
    const SeamCost cost(level);
    ShiftMap shifts = agreed_shifts(found, weights_of(found, level.hole), parameters_.patch, level.hole);
    InpaintLevel other = level;
    other.bytes = PatchImage(level.colour);
    ShiftMap first = fill_front(other, {.patch = parameters_.patch, .seed = parameters_.seed}, {});
    std::vector<cv::Vec2s> candidates = most_used(shifts, level.hole, most_candidates), more = most_used(first, level.hole, most_candidates);
    candidates.insert(candidates.end(), more.begin(), more.end());
    const std::vector<cv::Vec2s> often = frequent_shifts(level, {.patch = parameters_.patch, .seed = parameters_.seed, .most = most_frequent});
    candidates.insert(candidates.end(), often.begin(), often.end());
    const auto e0 = seam_energy(cost, level.hole, shifts), e1 = seam_energy(cost, level.hole, first);
    if (e1 < e0) shifts = first;
    expand_shifts(cost, level.hole, candidates, 2, shifts);
    if (getenv("DBG")) fprintf(stderr, "level %dx%d hole %d em %ld greedy %ld cut %ld (%zu)\n", level.hole.cols, level.hole.rows, cv::countNonZero(level.hole), (long)e0, (long)e1, (long)seam_energy(cost, level.hole, shifts), candidates.size());
    copy_shifted(shifts, level.hole, level.colour);
    refresh_bytes(level);
    MatchField field = field_of(shifts, level, parameters_.patch);
    search(0, 99, field, level);
    return field;
  }

  // The next level begins with what the field says there, sharp.
  MatchField finer(const MatchField& field, InpaintLevel& level) const {
    MatchField large = twice_as_large(field, centres_that_touch(level.hole, parameters_.patch));
    for (int y = 0; y < large.area.height; ++y)
      for (int x = 0; x < large.area.width; ++x) {
        const cv::Point source = cv::Point(x, y) + large.area.tl() + cv::Point(large.offset(y, x)[0], large.offset(y, x)[1]);
        const bool there = cv::Rect(cv::Point(), level.hole.size()).contains(source) && level.centres(source);
        if (large.wanted(y, x) && there) large.distance(y, x) = 0;
      }
    vote(large, parameters_.patch, weights_of(large, level.hole), level.colour, level.hole, level.colour);
    refresh_bytes(level);
    return large;
  }

  std::vector<InpaintLevel>& levels_;
  const InpaintParameters& parameters_;
  Course course_;
};

}  // namespace

Rgba inpaint(const Rgba& picture, const Plane& hole, const InpaintParameters& parameters, Progress progress) {
  check::not_empty("picture", picture);
  check::same_size("hole", hole, "the picture", picture);
  if (parameters.source) check::same_size("source", *parameters.source, "the picture", picture);
  check_parameters(parameters);
  const Mask open = as_mask("hole", hole);
  check_numbers(picture, open);
  const int count = cv::countNonZero(open);
  if (count == 0) return picture.clone();
  if (count == picture.rows * picture.cols) throw BadInput("hole: it covers the whole picture; nothing is left to copy from");

  progress.phase("filling the hole", 0.9);
  std::vector<InpaintLevel> levels =
      inpaint_levels(picture, open, allowed_pixels(open, parameters), parameters.patch, parameters.radius.value_or(0));
  check_sources(levels[0], parameters);
  const MatchField field = Filling(levels, parameters, progress).run();

  progress.phase("blending the seams", 0.1);
  InpaintLevel& finest = levels[0];
  ShiftMap shifts = agreed_shifts(field, weights_of(field, finest.hole), parameters.patch, finest.hole);
  settle_seams(SeamCost(finest), finest.hole, seam_rounds, shifts, [&](double share) { progress.at(0.5 * share); });
  copy_shifted(shifts, finest.hole, finest.colour);
  if (parameters.blend) blend_seams(shifts, finest.hole, finest.colour, [&](double share) { progress.at(0.5 + 0.5 * share); });
  return finest.colour;
}

}  // namespace stillwater
