#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "frame/displaced_layer.h"

namespace stillwater {

/// Both copies of a layer that drifts in a loop, cross-faded with variance kept, so that contrast does not sink half
/// way (keep_variance.h). M is the layer, blurred: what does not change where the copies differ; rho is measured at the
/// distance of the copies. Of straight colours; coverage dissolves.
class CrossFade {
 public:
  /// M of a layer with these pixels, on a coarse grid. `sigma`: of the blur, pixels (mean_sigma_of()).
  static Rgba mean_of(const Rgba& pixels, double sigma, bool endless_x, bool endless_y);
  static double mean_sigma_of(int picture_width, double scale);

  /// Of the layer with this plate, whose mean_of() is given.
  CrossFade(const Plate& plate, const Rgba& mean);

  /// The layer at one moment. `plate`: the same. The answer refers to both.
  std::unique_ptr<LayerMotion> at(const Plate& plate, const Placement& now, const Travel& travel) const;

 private:
  friend class CrossFadedLayer;

  void sample_mean(float* x, float* y, const unsigned char* needed, int count, cv::Vec4f* out) const;
  std::vector<float> beside_mean(const Plate& plate, int row) const;
  double measured_likeness(const Plate& plate, cv::Point apart) const;
  double likeness(const Plate& plate, cv::Point apart) const;

  Source mean_;                   ///< on a coarse grid: nothing small is left in it
  float columns_ = 1, rows_ = 1;  ///< of the mean for one of the plate
  mutable std::mutex mutex_;
  mutable std::map<std::pair<int, int>, double> likeness_;  ///< by the distance of the copies, measured once: a loop has two
};

}  // namespace stillwater
