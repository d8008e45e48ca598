#pragma once

#include <array>
#include <memory>

#include "frame/flowing_plate.h"

namespace stillwater {

using Four = float __attribute__((vector_size(16)));

/// A layer that flows, at one moment. Its outline stands still; what does not move is the still layer's own pixels. Where
/// copies are sampled, and what is left of their mix beside the finest band, is found on the knots of the streamlines
/// and interpolated.
class FlowingLayer final : public LayerMotion {
 public:
  /// `flow`: as FlowPaths::taken() says.
  FlowingLayer(const FlowingPlate& flowing, const Plate& plate, const Flow& flow);

  bool at_rest() const override { return !mixed_ && flow_.step == 0; }
  cv::Rect covered(const cv::Rect& tile) const override { return still_->covered(tile); }
  const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const override;
  void flow(float* x, float* y, int count) const override;

 private:
  struct Mixing;

  bool find_moving(const SampledRun& at, const unsigned char* needed, const cv::Vec4f* still, int count,
                   unsigned char* moving) const;
  void make_knots();
  void make_knot(int row, int column);
  void keep_contrast(int row, int column, const std::array<float, flow_copies>& weights,
                     const std::array<cv::Vec2f, flow_copies>& origins);
  void mix(const SampledRun& at, const unsigned char* moving, int count, Four* out) const;

  const FlowingPlate& flowing_;
  const Plate& plate_;
  Flow flow_;
  std::unique_ptr<LayerMotion> still_;
  bool mixed_;  ///< else it looks as in the still picture
  std::array<Rgba, flow_copies / 2> origins_;  ///< of copies p and p + 4: x, y of each, minus here
  Rgba states_;  ///< phase, gain of the finest band, share of half and of quarter lives
  Rgba rest_;    ///< colour beside gain times the mix
};

}  // namespace stillwater
