#pragma once

#include <vector>

#include "core/fft.h"

/// A periodic tile, filtered for the slanting footprints of pixels on a plane seen in perspective: far away a
/// pixel covers hundreds of samples in depth and few across. Levels are halved along each axis on its own (a
/// ripmap), by the cubic B-spline's two-scale weights 1 4 6 4 1.
///
///     kernel along the columns: a cubic B-spline, stretched so that its variance is that of interpolation (1/3)
///     and footprint together, at the level where the stretch lies between 1 and 2.65: variance, not level, decides,
///     so that no seam shows where levels change
///     kernel along the rows: the B-spline of a level, smoothed to its wanted variance
///     shear: the footprint's long axis runs along (shear, 1)
namespace stillwater {

/// A row of pixels on the plane, in samples of the tile.
struct FootprintRow {
  double x = 0, step = 1;  ///< of the first pixel, and from one to the next
  double y = 0;
  double across = 0, along = 0;           ///< the footprint's standard deviations, samples; across <= along
  double shear_first = 0, shear_step = 0; ///< at the first pixel, and from one to the next
};

class Ripmap {
 public:
  static constexpr int block = 64;  ///< pixels that filtered() answers at once

  /// `spline` holds coefficients of a periodic cubic B-spline (WaveTile::spline).
  explicit Ripmap(const InverseFft2& spline);

  /// Filtered values at `block` pixels of a row.
  void filtered(const FootprintRow& row, float* values) const;

  /// No filtered value lies further from 0.
  float bound() const { return bound_; }

 private:
  struct Level {
    int width, height, stride;
    std::vector<float> samples;  ///< rows continue periodically to the stride
  };

  const Level& level(int along_x, int along_y) const { return levels_[along_y * (along_y + 1) / 2 + along_x]; }
  void filtered_with_shear(const FootprintRow& row, double shear, float* values) const;

  int size_, top_;             ///< top: the coarsest level of both axes
  std::vector<Level> levels_;  ///< (x, y) with x <= y
  float bound_ = 0;
};

}  // namespace stillwater
