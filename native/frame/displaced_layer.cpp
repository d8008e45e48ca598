#include "frame/displaced_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stillwater {
namespace {

using SharedDisplacement = std::shared_ptr<const Displacement>;

bool rests(const SharedDisplacement& displacement) { return !displacement || displacement->at_rest(); }

// Where a run of output pixels is sampled, in the plate's index coordinates.
struct SampledRun {
  float x[Run::longest], y[Run::longest];

  SampledRun(const Plate& plate, const Displacement* displacement, const Run& run) {
    // Whole vectors: a few places more cost less than a remainder done one by one.
    const int count = (run.count + 7) / 8 * 8;
    const double step = 1 / plate.output_scale;
    const auto x0 = static_cast<float>((run.x + 0.5) * step), y0 = static_cast<float>((run.y + 0.5) * step);
    if (displacement) {
      displacement->unmap_row(x0, y0, static_cast<float>(step), count, x, y);
    } else {
      for (int i = 0; i < count; ++i) x[i] = static_cast<float>((run.x + i + 0.5) * step);
      std::fill_n(y, count, y0);
    }
    const auto scale = static_cast<float>(plate.scale);
    const auto left = static_cast<float>(plate.origin.x + 0.5), top = static_cast<float>(plate.origin.y + 0.5);
    for (int i = 0; i < count; ++i) {
      x[i] = x[i] * scale - left;
      y[i] = y[i] * scale - top;
    }
  }
};

bool sample(const Plate& plate, const SharedDisplacement& displacement, const Run& run, const unsigned char* needed,
            cv::Vec4f* out) {
  const bool still = rests(displacement);
  const int column = run.x - static_cast<int>(plate.origin.x), row = run.y - static_cast<int>(plate.origin.y);
  if (still && plate.scale == plate.output_scale && plate.source.holds(column, row, run.count))
    return plate.source.copy(column, row, run.count, out);
  SampledRun at(plate, still ? nullptr : displacement.get(), run);
  return plate.source.sample(at.x, at.y, needed, run.count, out);
}

int around(int at, int size) { return (at % size + size) % size; }

double brightness_beside_mean(const Plate& plate, const Plate& mean, int x, int y) {
  const cv::Vec4f& colour = *plate.source.at(x, y);
  const cv::Vec4f& usual = *mean.source.at(x, y);
  if (colour[3] <= 0 || usual[3] <= 0) return 0;
  const float share = colour[3] / usual[3];
  return (colour[0] + colour[1] + colour[2]) - share * (usual[0] + usual[1] + usual[2]);
}

// The flow is the same for one copy and for two.
class TravellingLayer : public LayerMotion {
 public:
  TravellingLayer(const Plate& plate, const Travel& travel) : plate_(plate), travel_(travel) {}

  bool at_rest() const override { return rests(travel_.now) && rests(travel_.after); }

  void flow(float* x, float* y, int count) const override {
    const auto scale = static_cast<float>(plate_.output_scale), inverse = 1 / scale;
    float px[Run::longest], py[Run::longest];
    for (int i = 0; i < count; ++i) {
      px[i] = x[i] * inverse;
      py[i] = y[i] * inverse;
    }
    if (!rests(travel_.now)) travel_.now->unmap(px, py, count);
    if (!rests(travel_.after)) travel_.after->map(px, py, count);
    for (int i = 0; i < count; ++i) {
      x[i] = px[i] * scale - x[i];
      y[i] = py[i] * scale - y[i];
    }
  }

 protected:
  const Plate& plate_;

 private:
  Travel travel_;
};

class DisplacedLayer final : public TravellingLayer {
 public:
  DisplacedLayer(const Plate& plate, SharedDisplacement now, const Travel& travel)
      : TravellingLayer(plate, travel), now_(std::move(now)), bounds_(bounds(plate, rests(now_) ? nullptr : now_.get())) {}

  bool at_rest() const override { return rests(now_) && TravellingLayer::at_rest(); }

  cv::Rect covered(const cv::Rect& tile) const override {
    const cv::Rect part = tile & bounds_;
    return part.empty() || plate_.source.is_clear(where_sampled(part)) ? cv::Rect() : part;
  }

  bool draw(const Run& run, const unsigned char* needed, cv::Vec4f* out) const override {
    return sample(plate_, now_, run, needed, out);
  }

 private:
  // Output pixels that the layer can reach at this moment.
  static cv::Rect bounds(const Plate& plate, const Displacement* now) {
    const cv::Rect box = now ? now->spread(plate.box) : plate.box;
    const double scale = plate.output_scale;
    const auto low = [&](int at) { return static_cast<int>(std::floor(at * scale)) - 2; };
    const auto high = [&](int at) { return static_cast<int>(std::ceil(at * scale)) + 2; };
    cv::Rect reached(cv::Point(low(box.x), low(box.y)), cv::Point(high(box.br().x), high(box.br().y)));
    if (plate.endless_x) reached.x = 0, reached.width = std::numeric_limits<int>::max();
    if (plate.endless_y) reached.y = 0, reached.height = std::numeric_limits<int>::max();
    return reached;
  }

  // Pixels of the plate around those from which a part of the output may be sampled.
  cv::Rect where_sampled(const cv::Rect& part) const {
    const double to_plate = plate_.scale / plate_.output_scale;
    const double reach = (rests(now_) ? 0.0 : now_->reach()) * plate_.scale + 1;
    const auto left = static_cast<int>(std::floor(part.x * to_plate - plate_.origin.x - reach));
    const auto top = static_cast<int>(std::floor(part.y * to_plate - plate_.origin.y - reach));
    const auto right = static_cast<int>(std::ceil(part.br().x * to_plate - plate_.origin.x + reach));
    const auto bottom = static_cast<int>(std::ceil(part.br().y * to_plate - plate_.origin.y + reach));
    return {left, top, right - left, bottom - top};
  }

  SharedDisplacement now_;
  cv::Rect bounds_;
};

// How alike the layer is to itself `apart` plate pixels away: correlation of its differences from the mean, 0 .. 1.
double likeness(const Plate& plate, const Plate& mean, const Point& apart) {
  constexpr int step = 4;
  double both = 0, square = 0;
  for (int y = 0; y < plate.source.height(); y += step)
    for (int x = 0; x < plate.source.width(); x += step) {
      const int other_x = around(x + static_cast<int>(std::lround(apart.x)), plate.source.width());
      const int other_y = around(y + static_cast<int>(std::lround(apart.y)), plate.source.height());
      const double here = brightness_beside_mean(plate, mean, x, y);
      both += here * brightness_beside_mean(plate, mean, other_x, other_y);
      square += here * here;
    }
  return square > 0 ? std::clamp(both / square, 0.0, 1.0) : 0.0;
}

// What differences from the mean are multiplied by, so that two copies, mixed, vary as much as one.
float variance_gain(const Plate& plate, const Plate& mean, const Placement& now) {
  if (plate.source.empty()) return 1;
  const Point apart{(now.second_drifted.x - now.drifted.x) * plate.scale, (now.second_drifted.y - now.drifted.y) * plate.scale};
  const double other = now.second_share, one = 1 - other;
  return static_cast<float>(1 / std::sqrt(one * one + other * other + 2 * one * other * likeness(plate, mean, apart)));
}

class CrossFadedLayer final : public TravellingLayer {
 public:
  CrossFadedLayer(const Plate& plate, const Plate& mean, const Placement& now, const Travel& travel)
      : TravellingLayer(plate, travel), mean_(mean), copies_(now), gain_(variance_gain(plate, mean, now)) {}

  bool at_rest() const override { return false; }

  cv::Rect covered(const cv::Rect& tile) const override { return tile; }

  bool draw(const Run& run, const unsigned char* needed, cv::Vec4f* out) const override {
    cv::Vec4f second[Run::longest], first_mean[Run::longest], second_mean[Run::longest];
    sample_or_clear(plate_, copies_.first, run, needed, out);
    sample_or_clear(plate_, copies_.second, run, needed, second);
    sample_or_clear(mean_, copies_.first, run, needed, first_mean);
    sample_or_clear(mean_, copies_.second, run, needed, second_mean);
    const auto other = static_cast<float>(copies_.second_share);
    const float one = 1 - other;
    for (int i = 0; i < run.count; ++i) {
      if (!needed[i]) continue;
      const cv::Vec4f plain = one * out[i] + other * second[i];
      const cv::Vec4f mean = one * first_mean[i] + other * second_mean[i];
      out[i] = lively(plain, mean);
    }
    return true;
  }

 private:
  // Straight colours are what differs from the mean; coverage dissolves.
  cv::Vec4f lively(const cv::Vec4f& plain, const cv::Vec4f& mean) const {
    if (plain[3] <= 0 || mean[3] <= 0) return plain;
    const cv::Vec4f expected = mean * (plain[3] / mean[3]);
    const cv::Vec4f colour = expected + gain_ * (plain - expected);
    return {colour[0], colour[1], colour[2], plain[3]};
  }

  static void sample_or_clear(const Plate& plate, const SharedDisplacement& displacement, const Run& run,
                              const unsigned char* needed, cv::Vec4f* out) {
    if (!sample(plate, displacement, run, needed, out)) std::fill_n(out, run.count, cv::Vec4f());
  }

  const Plate& mean_;
  Placement copies_;
  float gain_;
};

}  // namespace

std::unique_ptr<LayerMotion> displaced_layer(const Plate& plate, const Placement& now, const Travel& travel) {
  return std::make_unique<DisplacedLayer>(plate, now.first, travel);
}

std::unique_ptr<LayerMotion> cross_faded_layer(const Plate& plate, const Plate& mean, const Placement& now,
                                               const Travel& travel) {
  return std::make_unique<CrossFadedLayer>(plate, mean, now, travel);
}

}  // namespace stillwater
