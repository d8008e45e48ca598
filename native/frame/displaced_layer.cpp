#include "frame/displaced_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stillwater {
namespace {

using SharedDisplacement = std::shared_ptr<const Displacement>;

bool rests(const SharedDisplacement& displacement) { return !displacement || displacement->at_rest(); }

class DisplacedLayer final : public TravellingLayer {
 public:
  DisplacedLayer(const Plate& plate, SharedDisplacement now, const Travel& travel)
      : TravellingLayer(plate, travel), now_(rests(now) ? nullptr : std::move(now)), bounds_(bounds(now_.get())) {}

  bool at_rest() const override { return !now_ && TravellingLayer::at_rest(); }

  cv::Rect covered(const cv::Rect& tile) const override {
    const cv::Rect part = tile & bounds_;
    return part.empty() || plate_.source.is_clear(where_sampled(part)) ? cv::Rect() : part;
  }

  const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const override {
    const int column = run.x - static_cast<int>(plate_.origin.x), row = run.y - static_cast<int>(plate_.origin.y);
    if (!now_ && plate_.scale == plate_.output_scale && plate_.source.holds(column, row, run.count))
      return plate_.source.run_at(column, row, run.count);
    if (plate_.source.is_clear(where_sampled(cv::Rect(run.x, run.y, run.count, 1)))) return nullptr;
    SampledRun at(plate_, now_.get(), run);
    return plate_.source.sample(at.x, at.y, needed, run.count, room) ? room : nullptr;
  }

 private:
  // Pixels of the plate around those from which a part of the output may be sampled.
  cv::Rect where_sampled(const cv::Rect& part) const {
    const double to_plate = plate_.scale / plate_.output_scale;
    const double reach = (now_ ? now_->reach() : 0.0) * plate_.scale + 1;
    const auto left = static_cast<int>(std::floor(part.x * to_plate - plate_.origin.x - reach));
    const auto top = static_cast<int>(std::floor(part.y * to_plate - plate_.origin.y - reach));
    const auto right = static_cast<int>(std::ceil(part.br().x * to_plate - plate_.origin.x + reach));
    const auto bottom = static_cast<int>(std::ceil(part.br().y * to_plate - plate_.origin.y + reach));
    return {left, top, right - left, bottom - top};
  }

  SharedDisplacement now_;  // null at rest
  cv::Rect bounds_;
};

}  // namespace

SampledRun::SampledRun(const Plate& plate, const Displacement* displacement, const Run& run) {
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

bool TravellingLayer::at_rest() const { return rests(travel_.now) && rests(travel_.after); }

void TravellingLayer::flow(float* x, float* y, int count) const {
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

cv::Rect TravellingLayer::bounds(const Displacement* displacement) const {
  const cv::Rect box = displacement ? displacement->spread(plate_.box) : plate_.box;
  const double scale = plate_.output_scale;
  const auto low = [&](int at) { return static_cast<int>(std::floor(at * scale)) - 2; };
  const auto high = [&](int at) { return static_cast<int>(std::ceil(at * scale)) + 2; };
  cv::Rect reached(cv::Point(low(box.x), low(box.y)), cv::Point(high(box.br().x), high(box.br().y)));
  if (plate_.endless_x) reached.x = 0, reached.width = std::numeric_limits<int>::max();
  if (plate_.endless_y) reached.y = 0, reached.height = std::numeric_limits<int>::max();
  return reached;
}

std::unique_ptr<LayerMotion> displaced_layer(const Plate& plate, const Placement& now, const Travel& travel) {
  return std::make_unique<DisplacedLayer>(plate, now.first, travel);
}

}  // namespace stillwater
