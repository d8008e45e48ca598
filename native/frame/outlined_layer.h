#pragma once

#include <memory>

#include "frame/displaced_layer.h"
#include "frame/outlines.h"

namespace stillwater {

/// A layer whose outline moves: what another LayerMotion draws of an opaque plate, covered as the outline says.
class OutlinedLayer final : public LayerMotion {
 public:
  /// `outline`: of the plate's pixels; it and the plate must outlive this.
  OutlinedLayer(std::unique_ptr<LayerMotion> inside, const Plate& plate, const Bytes& outline)
      : inside_(std::move(inside)), plate_(plate), outline_(outline) {}

  bool at_rest() const override { return false; }
  cv::Rect covered(const cv::Rect& tile) const override { return inside_->covered(tile); }
  const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const override;
  void flow(float* x, float* y, int count) const override { inside_->flow(x, y, count); }

 private:
  float coverage(float x, float y) const;

  std::unique_ptr<LayerMotion> inside_;
  const Plate& plate_;
  Bytes outline_;
};

}  // namespace stillwater
