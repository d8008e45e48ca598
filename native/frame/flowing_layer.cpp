#include "frame/flowing_layer.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "frame/keep_variance.h"

namespace stillwater {
namespace {

constexpr int knots_in_run = Run::longest / Streamlines::apart + 3;

constexpr float furthest = 1e9f;

// What holding a mix within its copies' colours takes from contrast, given back where copies differ; measured on textures
// with a normal distribution.
constexpr float given_back = 0.25f;

// What a band's mix is multiplied by, which has this share of the variance left.
float gain_of(float variance) { return (1 + given_back * (1 - variance)) / std::sqrt(variance); }

// A copy whose weight will be above 0 not further away than this is found too: between knots it counts.
constexpr float soon = 0.05f;  // periods

bool any_way(const Flow& flow) {
  return std::any_of(flow.ways.begin(), flow.ways.end(), [](double way) { return way != 0; });
}

Four four(const cv::Vec4f& v) { return Four{v[0], v[1], v[2], v[3]}; }

// Between which knots the places of one run lie.
class BetweenKnots {
 public:
  BetweenKnots(const SampledRun& at, int count, cv::Size knots) : count_(count) {
    constexpr float spacing = 1.0f / Streamlines::apart;
    const auto last_row = static_cast<float>(knots.height - 1), last_column = static_cast<float>(knots.width - 1);
    const float row = std::clamp(at.y[0] * spacing, 0.0f, last_row);
    top_ = std::min(static_cast<int>(row), std::max(0, knots.height - 2));
    bottom_ = std::min(top_ + 1, knots.height - 1);
    down_ = row - static_cast<float>(top_);
    first_ = std::min(static_cast<int>(std::clamp(at.x[0] * spacing, 0.0f, last_column)), std::max(0, knots.width - 2));
    for (int i = 0; i < count; ++i) {
      const float column = std::clamp(at.x[i] * spacing, 0.0f, last_column);
      const int left = std::min(static_cast<int>(column), std::max(0, knots.width - 2));
      column_[i] = left - first_;
      across_[i] = column - static_cast<float>(left);
    }
    columns_ = std::min(column_[count - 1] + 2, knots.width - first_);
  }

  void read(const Rgba& knots, Four* out) const {
    Four line[knots_in_run] = {};
    for (int k = 0; k < columns_; ++k) {
      const Four upper = four(knots(top_, first_ + k)), lower = four(knots(bottom_, first_ + k));
      line[k] = upper + down_ * (lower - upper);
    }
    line[columns_] = line[columns_ - 1];
    for (int i = 0; i < count_; ++i) {
      const Four left = line[column_[i]];
      out[i] = left + across_[i] * (line[column_[i] + 1] - left);
    }
  }

 private:
  int count_, top_, bottom_, first_, columns_;
  float down_;
  int column_[Run::longest];
  float across_[Run::longest];
};

}  // namespace

FlowingLayer::FlowingLayer(const FlowingPlate& flowing, const Plate& plate, const Flow& flow)
    : flowing_(flowing),
      plate_(plate),
      flow_(flow),
      still_(displaced_layer(plate, {}, {})),
      mixed_(!flowing.paths().still() && any_way(flow)) {
  if (flowing.paths().still()) flow_.step = 0;
  if (mixed_) make_knots();
}

void FlowingLayer::make_knots() {
  const cv::Size knots = flowing_.paths().knots();
  const int pairs = flowing_.paths().short_lives() ? flow_copies / 2 : 1;
  for (int pair = 0; pair < pairs; ++pair) origins_[pair].create(knots);
  states_.create(knots);
  rest_.create(knots);
  parallel_rows(knots.height, 4, [&](int first, int last) {
    for (int row = first; row < last; ++row)
      for (int column = 0; column < knots.width; ++column) make_knot(row, column);
  });
}

void FlowingLayer::make_knot(int row, int column) {
  const FlowPaths& paths = flowing_.paths();
  const float phase = paths.phase(row, column) + static_cast<float>(flow_.cycle);
  const std::array<float, flow_lives> lives = paths.lives(row, column);
  std::array<float, flow_copies> weights{};
  std::array<cv::Vec2f, flow_copies> origins{};
  for (int pair = 0; pair < flow_copies / 2 && !origins_[pair].empty(); ++pair) {
    for (const int copy : {pair, pair + flow_copies / 2}) {
      const float age = age_of(copy, phase);
      weights[copy] = weight_of(copy, age, lives);
      if (paths.short_lives() && weights[copy] == 0 && std::abs(age) > soon &&
          weight_of(copy, std::abs(age) - soon, {1, 1, 1}) == 0)
        continue;
      origins[copy] = paths.origin(flow_, row, column, way_at(flow_, age));
    }
    const cv::Vec2f &one = origins[pair], &other = origins[pair + flow_copies / 2];
    origins_[pair](row, column) = {one[0], one[1], other[0], other[1]};
  }
  states_(row, column) = {phase, 1, lives[1], lives[2]};
  rest_(row, column) = {};
  if (flowing_.lively_) keep_contrast(row, column, weights, origins);
}

void FlowingLayer::keep_contrast(int row, int column, const std::array<float, flow_copies>& weights,
                                 const std::array<cv::Vec2f, flow_copies>& origins) {
  constexpr int bands = FlowingPlate::bands;
  std::array<cv::Vec4f, bands> means{};
  std::array<float, bands> variances{};
  for (int copy = 0; copy < flow_copies; ++copy) {
    const float weight = weights[copy];
    if (weight == 0) continue;
    const float x = static_cast<float>(column * Streamlines::apart) + origins[copy][0];
    const float y = static_cast<float>(row * Streamlines::apart) + origins[copy][1];
    for (int band = 0; band < bands; ++band) {
      means[band] += weight * flowing_.means_[band].at(x, y);
      variances[band] += weight * weight;
    }
    for (int other = 0; other < copy; ++other) {
      if (weights[other] == 0) continue;
      const cv::Vec2f between = origins[other] - origins[copy];
      const float apart = std::hypot(between[0], between[1]);
      for (int band = 0; band < bands; ++band)
        variances[band] += 2 * weight * weights[other] * flowing_.likeness(band, apart);
    }
  }
  cv::Vec4f rest = means[bands - 1];
  for (int band = bands - 1; band > 0; --band)
    rest = rest + gain_of(variances[band]) * (means[band - 1] - means[band]);
  const float gain = gain_of(variances[0]);
  rest_(row, column) = rest - gain * means[0];
  states_(row, column)[1] = gain;
}

const cv::Vec4f* FlowingLayer::draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const {
  const cv::Vec4f* still = still_->draw(run, needed, room);
  if (!still || !mixed_) return still;
  const SampledRun at(plate_, nullptr, run);
  std::array<unsigned char, Run::longest> moving;
  if (!find_moving(at, needed, still, run.count, moving.data())) return still;
  std::array<Four, Run::longest> mixed;
  mix(at, moving.data(), run.count, mixed.data());
  for (int i = 0; i < run.count; ++i) {
    const float coverage = still[i][3];
    Four colour = four(still[i]);
    if (moving[i]) colour = mixed[i] * coverage, colour[3] = coverage;
    room[i] = {colour[0], colour[1], colour[2], colour[3]};
  }
  return room;
}

// Which pixels of a run are a mix of copies; false where none is.
bool FlowingLayer::find_moving(const SampledRun& at, const unsigned char* needed, const cv::Vec4f* still, int count,
                               unsigned char* moving) const {
  const cv::Size pixels = flowing_.paths().pixels();
  const auto nearest = [](float place, int size) { return std::clamp(static_cast<int>(place + 0.5f), 0, size - 1); };
  const unsigned char* moves = flowing_.paths().moving_row(nearest(at.y[0], pixels.height));
  unsigned char any = 0;
  for (int i = 0; i < count; ++i) {
    moving[i] = needed[i] & static_cast<unsigned char>(still[i][3] > 0) & moves[nearest(at.x[i], pixels.width)];
    any |= moving[i];
  }
  return any != 0;
}

/// The copies of one run, mixed one after the other.
struct FlowingLayer::Mixing {
  const SampledRun& at;
  const unsigned char* moving;
  int count;
  Four states[Run::longest], sum[Run::longest] = {}, darkest[Run::longest], brightest[Run::longest];
  float phases[Run::longest], halves[Run::longest], quarters[Run::longest];
  bool short_lives = false;

  Mixing(const SampledRun& places, const unsigned char* wanted, int length) : at(places), moving(wanted), count(length) {}

  void take_states() {
    for (int i = 0; i < count; ++i) {
      phases[i] = states[i][0], halves[i] = states[i][2], quarters[i] = states[i][3];
      short_lives = short_lives || halves[i] + quarters[i] > 0;
      darkest[i] = Four{} + furthest, brightest[i] = Four{} - furthest;
    }
  }

  // False where the copy is not seen.
  bool weigh(int copy, float* weights, unsigned char* seen) const {
    for (int i = 0; i < count; ++i)
      weights[i] = weight_of(copy, age_of(copy, phases[i]), {1 - halves[i] - quarters[i], halves[i], quarters[i]});
    unsigned char any = 0;
    for (int i = 0; i < count; ++i) {
      seen[i] = static_cast<unsigned char>(moving[i] != 0) & static_cast<unsigned char>(weights[i] > 0);
      any |= seen[i];
    }
    return any != 0;
  }

  // A mix within the colours of its copies: beyond all of them fire turns green, and smoke grey.
  Four held(int i, const Four& mixed) const {
    const Four low = mixed > darkest[i] ? mixed : darkest[i];
    return low < brightest[i] ? low : brightest[i];
  }

  void add(const Source& texture, const Four* origins, int side, const float* weights, const unsigned char* seen) {
    float x[Run::longest] = {}, y[Run::longest] = {};
    for (int i = 0; i < count; ++i) {
      x[i] = at.x[i] + origins[i][2 * side];
      y[i] = at.y[i] + origins[i][2 * side + 1];
    }
    std::array<cv::Vec4f, Run::longest> colours;
    texture.sample(x, y, seen, count, colours.data());
    for (int i = 0; i < count; ++i) {
      if (!seen[i]) continue;
      const Four colour = four(colours[i]);
      sum[i] += weights[i] * colour;
      darkest[i] = colour < darkest[i] ? colour : darkest[i];
      brightest[i] = colour > brightest[i] ? colour : brightest[i];
    }
  }
};

// Opaque colours where `moving` is not 0.
void FlowingLayer::mix(const SampledRun& at, const unsigned char* moving, int count, Four* out) const {
  const BetweenKnots between(at, count, flowing_.paths().knots());
  Mixing mixing(at, moving, count);
  between.read(states_, mixing.states);
  mixing.take_states();
  Four origins[Run::longest];
  float weights[Run::longest];
  unsigned char seen[Run::longest];
  for (int pair = 0; pair < (mixing.short_lives ? flow_copies / 2 : 1); ++pair) {
    bool read = false;
    for (int side = 0; side < 2; ++side) {
      if (!mixing.weigh(pair + side * flow_copies / 2, weights, seen)) continue;
      if (!read) between.read(origins_[pair], origins);
      read = true;
      mixing.add(flowing_.texture_, origins, side, weights, seen);
    }
  }
  Four rest[Run::longest];
  between.read(rest_, rest);
  for (int i = 0; i < count; ++i) {
    out[i] = mixing.held(i, mixing.states[i][1] * mixing.sum[i] + rest[i]);
  }
}

void FlowingLayer::flow(float* x, float* y, int count) const {
  const double scale = plate_.scale / plate_.output_scale;
  for (int i = 0; i < count; ++i) {
    const cv::Vec2d here(x[i] * scale - plate_.origin.x - 0.5, y[i] * scale - plate_.origin.y - 0.5);
    const cv::Vec2d way = flowing_.paths().still() ? cv::Vec2d() : flowing_.paths().to_next(flow_, here);
    x[i] = static_cast<float>(way[0] / scale);
    y[i] = static_cast<float>(way[1] / scale);
  }
}

}  // namespace stillwater
