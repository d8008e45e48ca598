#pragma once

#include "layers/displacement.h"

/// A layer displaced as a whole.
namespace stillwater {

/// By an offset, pixels.
class Translation : public Displacement {
 public:
  explicit Translation(Point offset);

  bool at_rest() const override;
  float reach() const override;
  void map(float* x, float* y, int count) const override;
  void unmap(float* x, float* y, int count) const override;

 private:
  float x_, y_;
};

/// Turned by `angle` (radians, clockwise as seen on the screen) about `pivot`, then moved by `shift`, pixels.
class RigidMotion : public Displacement {
 public:
  /// `picture`: what reach() answers for.
  RigidMotion(Point pivot, double angle, Point shift, cv::Size picture);

  bool at_rest() const override;
  float reach() const override;
  void map(float* x, float* y, int count) const override;
  void unmap(float* x, float* y, int count) const override;

 private:
  Point pivot_, shift_;
  float sine_, versine_;  // versine: cosine - 1
  float reach_;
};

}  // namespace stillwater
