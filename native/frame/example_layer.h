#pragma once

#include <memory>

#include "frame/example_plate.h"

namespace stillwater {

/// A layer that flows like a clip, at one moment: all of it is made at once, as its texture is matched as a whole. Its
/// outline stands still.
class ExampleLayer final : public LayerMotion {
 public:
  ExampleLayer(const ExamplePlate& example, const Plate& plate, const ExampleNow& now);

  bool at_rest() const override { return false; }
  cv::Rect covered(const cv::Rect& tile) const override { return still_->covered(tile); }
  const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const override;
  void flow(float* x, float* y, int count) const override;

 private:
  const ExamplePlate& example_;
  const Plate& plate_;
  ExampleNow now_;
  std::unique_ptr<LayerMotion> still_;
  Source film_;
};

}  // namespace stillwater
