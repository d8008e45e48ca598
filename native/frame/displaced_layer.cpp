#include "frame/displaced_layer.h"

#include <algorithm>
#include <cmath>
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
  SampledRun at(plate, rests(displacement) ? nullptr : displacement.get(), run);
  return plate.source.sample(at.x, at.y, needed, run.count, out);
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
      : TravellingLayer(plate, travel), now_(std::move(now)) {}

  bool at_rest() const override { return rests(now_) && TravellingLayer::at_rest(); }

  bool may_cover(const cv::Rect& tile) const override {
    const double to_plate = plate_.scale / plate_.output_scale;
    const double reach = (rests(now_) ? 0.0 : now_->reach()) * plate_.scale + 1;
    const auto left = static_cast<int>(std::floor(tile.x * to_plate - plate_.origin.x - reach));
    const auto top = static_cast<int>(std::floor(tile.y * to_plate - plate_.origin.y - reach));
    const auto right = static_cast<int>(std::ceil(tile.br().x * to_plate - plate_.origin.x + reach));
    const auto bottom = static_cast<int>(std::ceil(tile.br().y * to_plate - plate_.origin.y + reach));
    return !plate_.source.is_clear(cv::Rect(left, top, right - left, bottom - top));
  }

  bool draw(const Run& run, const unsigned char* needed, cv::Vec4f* out) const override {
    return sample(plate_, now_, run, needed, out);
  }

 private:
  SharedDisplacement now_;
};

class CrossFadedLayer final : public TravellingLayer {
 public:
  CrossFadedLayer(const Plate& plate, const Plate& mean, const Placement& now, const Travel& travel)
      : TravellingLayer(plate, travel), mean_(mean), copies_(now) {}

  bool at_rest() const override { return false; }

  bool may_cover(const cv::Rect&) const override { return true; }

  bool draw(const Run& run, const unsigned char* needed, cv::Vec4f* out) const override {
    cv::Vec4f second[Run::longest], first_mean[Run::longest], second_mean[Run::longest];
    sample_or_clear(plate_, copies_.first, run, needed, out);
    sample_or_clear(plate_, copies_.second, run, needed, second);
    sample_or_clear(mean_, copies_.first, run, needed, first_mean);
    sample_or_clear(mean_, copies_.second, run, needed, second_mean);
    const auto other = static_cast<float>(copies_.second_share);
    const float one = 1 - other, kept = 1 / std::sqrt(one * one + other * other);
    for (int i = 0; i < run.count; ++i) {
      if (!needed[i]) continue;
      const cv::Vec4f plain = one * out[i] + other * second[i];
      cv::Vec4f mean = one * first_mean[i] + other * second_mean[i];
      mean *= mean[3] > 0 ? plain[3] / mean[3] : 0;  // the layer's colour here, as far as it covers
      for (int c = 0; c < 3; ++c) out[i][c] = std::max(0.0f, mean[c] + kept * (plain[c] - mean[c]));
      out[i][3] = plain[3];
    }
    return true;
  }

 private:
  static void sample_or_clear(const Plate& plate, const SharedDisplacement& displacement, const Run& run,
                              const unsigned char* needed, cv::Vec4f* out) {
    if (!sample(plate, displacement, run, needed, out)) std::fill_n(out, run.count, cv::Vec4f());
  }

  const Plate& mean_;
  Placement copies_;
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
