#include "example/match_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/flann.hpp>
#include <set>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "flow/streamline.h"

namespace stillwater {
namespace {

constexpr int side = 5, samples = side * side;
constexpr double kept_variance = 0.99;
constexpr int nearest = 24, tried = 24;
constexpr int most_places = 120;  // of the clip, along its longer side

constexpr double turning = 0.3, flatness = 0.1, breaking = 0.25, repeating = 0.02;
constexpr double slow = 0.25;  // of the median speed, squared: differences of what is slower do not matter
constexpr double pi = std::numbers::pi;
constexpr double standing = 1e-3;  // px: what is slower has no direction

/// A patch of some flow: how it runs, as seen along its own mean direction.
struct Described {
  double angle = 0;
  bool moves = false;
  std::array<float, size_t{2} * samples> vectors{};
};

cv::Vec2d turned(const cv::Vec2d& v, double cosine, double sine) {
  return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]};
}

// `place`: index coordinates; `width` of the patch, px of this flow; `unit`: its median speed.
Described described(const SteadyFlow& flow, cv::Vec2d place, double width, double unit) {
  const auto offset = [&](int k) { return width * (k - (side - 1) / 2) / side; };
  Described patch;
  cv::Vec2d mean;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) mean += flow.at(place[0] + offset(column), place[1] + offset(row));
  patch.moves = cv::norm(mean) / samples > standing;
  patch.angle = patch.moves ? std::atan2(mean[1], mean[0]) : 0;
  const double cosine = std::cos(patch.angle), sine = std::sin(patch.angle);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const cv::Vec2d away = turned({offset(column), offset(row)}, cosine, sine);
      const cv::Vec2d along = turned(flow.at(place[0] + away[0], place[1] + away[1]), cosine, -sine) / unit;
      const int i = 2 * (row * side + column);
      patch.vectors[i] = static_cast<float>(along[0]);
      patch.vectors[i + 1] = static_cast<float>(along[1]);
    }
  return patch;
}

double median_speed(const Field& flow) {
  std::vector<double> speeds;
  for (const cv::Vec2f& v : flow)
    if (const double speed = cv::norm(v); speed > standing) speeds.push_back(speed);
  if (speeds.empty()) return 1;
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

/// Evenly spaced places and the patches around them.
struct Patches {
  std::vector<cv::Vec2f> places;
  std::vector<Described> patches;
  int columns = 0;

  cv::Mat1f vectors() const {
    cv::Mat1f rows(static_cast<int>(patches.size()), 2 * samples);
    for (int i = 0; i < rows.rows; ++i) std::copy(patches[i].vectors.begin(), patches[i].vectors.end(), rows[i]);
    return rows;
  }
};

Patches patches_of(const Field& velocity, cv::Point2d first, double step, cv::Size count, double width) {
  const SteadyFlow flow(velocity);
  const double unit = median_speed(velocity);
  Patches made{{}, std::vector<Described>(static_cast<size_t>(count.area())), count.width};
  for (int row = 0; row < count.height; ++row)
    for (int column = 0; column < count.width; ++column)
      made.places.emplace_back(static_cast<float>(first.x + column * step), static_cast<float>(first.y + row * step));
  parallel_rows(count.height, 1, [&](int from, int to) {
    for (int i = from * count.width; i < to * count.width; ++i)
      made.patches[i] = described(flow, cv::Vec2d(made.places[i]), width, unit);
  });
  return made;
}

// Of the picture, half a patch apart, from side to side.
Patches of_picture(const Field& velocity, int patch) {
  const double step = patch / 2.0;
  const cv::Size count(static_cast<int>(std::ceil(velocity.cols / step)) + 1, static_cast<int>(std::ceil(velocity.rows / step)) + 1);
  return patches_of(velocity, {0, 0}, step, count, patch);
}

// Of the clip, wholly inside of it.
Patches of_clip(const Field& velocity, double patch) {
  const double step = std::max(2.0, std::max(velocity.cols, velocity.rows) / static_cast<double>(most_places));
  const auto along = [&](int length) { return static_cast<int>((length - patch) / step) + 1; };
  return patches_of(velocity, {patch / 2 - 0.5, patch / 2 - 0.5}, step, {along(velocity.cols), along(velocity.rows)}, patch);
}

/// The clip's patches by likeness.
class Search {
 public:
  explicit Search(const cv::Mat1f& vectors) : components_(vectors, cv::noArray(), cv::PCA::DATA_AS_ROW, kept_variance) {
    components_.project(vectors, projected_);
    index_ = cv::makePtr<cv::flann::GenericIndex<Distance>>(projected_, cvflann::KDTreeSingleIndexParams(10, false));
  }

  // A row of places for each patch, nearest first.
  cv::Mat1i nearest_to(const cv::Mat1f& vectors) {
    cv::Mat1f looked_for;
    components_.project(vectors, looked_for);
    const int count = std::min(nearest, projected_.rows);
    cv::Mat1i places(vectors.rows, count);
    cv::Mat1f distances(vectors.rows, count);
    index_->knnSearch(looked_for, places, distances, count, cvflann::SearchParams(-1, 0, true));
    return places;
  }

 private:
  using Distance = cvflann::L2<float>;
  cv::PCA components_;
  cv::Mat1f projected_;
  cv::Ptr<cv::flann::GenericIndex<Distance>> index_;
};

// How far the vectors of two patches are apart, the second one turned by `angle`: squares, as a share of their own.
double distance(const Described& a, const Described& b, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  double off = 0, all = 0;
  for (size_t i = 0; i < a.vectors.size(); i += 2) {
    const cv::Vec2d one(a.vectors[i], a.vectors[i + 1]), other = turned({b.vectors[i], b.vectors[i + 1]}, cosine, sine);
    off += (one - other).dot(one - other);
    all += one.dot(one) + other.dot(other);
  }
  return off / (all + slow * samples);
}

float high_energy(const Plane& energy) {
  std::vector<float> values(energy.begin(), energy.end());
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), high, values.end());
  return *high;
}

/// Chooses a place of the clip for one patch of the picture after the other.
class Choice {
 public:
  Choice(const ClipMotion& clip, const TransferParameters& parameters)
      : clip_(clip),
        flow_(clip.velocity),
        unit_(median_speed(clip.velocity)),
        clip_scale_(parameters.clip_scale),
        width_(parameters.patch / parameters.clip_scale),
        high_energy_(high_energy(clip.energy)),
        taken_(cv::Mat1i::zeros(static_cast<int>(clip.velocity.rows / width_) + 1,
                                static_cast<int>(clip.velocity.cols / width_) + 1)) {}

  /// `neighbours`: those laid already.
  void begin(cv::Vec2f target, const Described& wanted, std::vector<const PlacedPatch*> neighbours) {
    wanted_ = &wanted;
    neighbours_ = std::move(neighbours);
    best_ = {target, {}, 0};
    least_ = std::numeric_limits<double>::max();
    for (const PlacedPatch* neighbour : neighbours_) offer_going_on(*neighbour);
  }

  void offer(cv::Vec2f source, const Described& there) {
    const bool both = wanted_->moves && there.moves;
    const double turn = both ? std::remainder(wanted_->angle - there.angle, 2 * pi) : 0.0;
    offer(cv::Vec2d(source), turn, distance(*wanted_, there, 0));
  }

  PlacedPatch take() {
    ++taken_(cell(cv::Vec2d(best_.source)));
    return best_;
  }

  double apart() const { return best_apart_; }
  double cost() const { return least_; }

 private:
  // The place that a neighbour, laid as it is, has under this patch.
  void offer_going_on(const PlacedPatch& neighbour) {
    const cv::Vec2d source = under(neighbour);
    const double half = width_ / 2 - 0.5;
    if (source[0] < half || source[1] < half || source[0] > clip_.velocity.cols - 1 - half ||
        source[1] > clip_.velocity.rows - 1 - half)
      return;
    const Described there = described(flow_, source, width_, unit_);
    const double off = wanted_->moves && there.moves ? there.angle + neighbour.turn - wanted_->angle : 0;
    offer(source, neighbour.turn, distance(*wanted_, there, off));
  }

  void offer(cv::Vec2d source, double turn, double apart) {
    const double lively = high_energy_ > 0 ? std::min(1.0f, energy_at(source) / high_energy_) : 1;
    double cost = apart + turning * (1 - std::cos(turn)) + flatness * (1 - lively) + repeating * taken_(cell(source));
    for (const PlacedPatch* neighbour : neighbours_)
      if (!goes_on(*neighbour, source, turn)) cost += breaking;
    if (cost >= least_) return;
    least_ = cost;
    best_apart_ = apart;
    best_.source = cv::Vec2f(source);
    best_.turn = static_cast<float>(turn);
  }

  cv::Vec2d under(const PlacedPatch& neighbour) const {
    const cv::Vec2d away(best_.target - neighbour.target);
    return cv::Vec2d(neighbour.source) + turned(away, std::cos(neighbour.turn), -std::sin(neighbour.turn)) / clip_scale_;
  }

  bool goes_on(const PlacedPatch& neighbour, const cv::Vec2d& source, double turn) const {
    return std::abs(std::remainder(turn - neighbour.turn, 2 * pi)) < 1e-3 && cv::norm(under(neighbour) - source) < 0.1;
  }

  float energy_at(const cv::Vec2d& source) const {
    return clip_.energy(std::clamp(cvRound(source[1]), 0, clip_.energy.rows - 1),
                        std::clamp(cvRound(source[0]), 0, clip_.energy.cols - 1));
  }

  cv::Point cell(const cv::Vec2d& source) const {
    return {std::clamp(static_cast<int>(source[0] / width_), 0, taken_.cols - 1),
            std::clamp(static_cast<int>(source[1] / width_), 0, taken_.rows - 1)};
  }

  const ClipMotion& clip_;
  SteadyFlow flow_;
  double unit_, clip_scale_, width_;
  float high_energy_;
  cv::Mat1i taken_;
  const Described* wanted_ = nullptr;
  std::vector<const PlacedPatch*> neighbours_;
  PlacedPatch best_;
  double least_ = 0, best_apart_ = 0;
};

/// Lays the patches one after the other: the one that costs least first, and from there always the neighbour of a laid one
/// that costs least: so what is connected grows from where the flows agree best.
class Growth {
 public:
  Growth(const Patches& wanted, const Patches& there, const cv::Mat1i& found, Choice choice)
      : wanted_(wanted), there_(there), found_(found), choice_(std::move(choice)), count_(static_cast<int>(wanted.patches.size())),
        laid_(count_, 0), placed_(count_), apart_(count_) {}

  void run() {
    int first = 0;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < count_; ++i) {
      choose(i);
      if (choice_.cost() < least) least = choice_.cost(), first = i;
    }
    waiting_.insert({least, first});
    while (!waiting_.empty()) {
      const int i = waiting_.begin()->second;
      waiting_.erase(waiting_.begin());
      if (laid_[i]) continue;
      choose(i);
      placed_[i] = choice_.take();
      apart_[i] = choice_.apart();
      laid_[i] = 1;
      for (const int other : around(i)) {
        if (laid_[other]) continue;
        choose(other);
        waiting_.insert({choice_.cost(), other});
      }
    }
  }

  const std::vector<PlacedPatch>& placed() const { return placed_; }
  const std::vector<double>& apart() const { return apart_; }

 private:
  std::vector<int> around(int i) const {
    std::vector<int> others;
    const int column = i % wanted_.columns;
    if (column > 0) others.push_back(i - 1);
    if (column + 1 < wanted_.columns) others.push_back(i + 1);
    if (i >= wanted_.columns) others.push_back(i - wanted_.columns);
    if (i + wanted_.columns < count_) others.push_back(i + wanted_.columns);
    return others;
  }

  void choose(int i) {
    std::vector<const PlacedPatch*> neighbours;
    for (const int other : around(i))
      if (laid_[other]) neighbours.push_back(&placed_[other]);
    choice_.begin(wanted_.places[i], wanted_.patches[i], std::move(neighbours));
    const auto offer = [&](int place) { choice_.offer(there_.places[place], there_.patches[place]); };
    for (int k = 0; k < found_.cols; ++k) offer(found_(i, k));
    for (int k = 0; k < tried; ++k) offer(static_cast<int>(random_bits(0, {i, k}) % there_.patches.size()));
  }

  const Patches& wanted_;
  const Patches& there_;
  const cv::Mat1i& found_;
  Choice choice_;
  int count_;
  std::vector<unsigned char> laid_;
  std::vector<PlacedPatch> placed_;
  std::vector<double> apart_;
  std::set<std::pair<double, int>> waiting_;
};

void check_arguments(const Field& velocity, const ClipMotion& clip, const TransferParameters& parameters) {
  check::in_range("patch", parameters.patch, 4, 128, "px");
  check::positive("clip_scale", parameters.clip_scale);
  check::not_empty("velocity", velocity);
  check::same_size("clip.energy", clip.energy, "clip.velocity", clip.velocity);
  if (!cv::checkRange(velocity)) throw BadInput("velocity: not finite everywhere");
  const double width = parameters.patch / parameters.clip_scale;
  if (std::min(clip.velocity.rows, clip.velocity.cols) < width)
    throw BadInput("patch: " + std::to_string(parameters.patch) + " px is not within the clip's " +
                   std::to_string(clip.velocity.cols) + " x " + std::to_string(clip.velocity.rows) + " px, laid at clip_scale");
}

}  // namespace

std::vector<PlacedPatch> match_patches(const Field& velocity, const ClipMotion& clip, const TransferParameters& parameters) {
  check_arguments(velocity, clip, parameters);
  const Patches wanted = of_picture(velocity, parameters.patch);
  const Patches there = of_clip(clip.velocity, parameters.patch / parameters.clip_scale);
  const cv::Mat1i found = Search(there.vectors()).nearest_to(wanted.vectors());
  const auto count = static_cast<int>(wanted.patches.size());
  Growth growth(wanted, there, found, Choice(clip, parameters));
  growth.run();
  const std::vector<PlacedPatch>& placed = growth.placed();
  const std::vector<double>& apart = growth.apart();
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return parameters.best_last ? apart[a] > apart[b] : apart[a] < apart[b];
  });
  std::vector<PlacedPatch> laid;
  for (const int i : order) laid.push_back(placed[i]);
  return laid;
}

}  // namespace stillwater
