#pragma once

#include <array>
#include <memory>
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

/// A line of pixels on the plane, in samples of the tile.
struct FootprintLine {
  double step = 1;  ///< from one pixel to the next
  double y = 0;
  double across = 0, along = 0;  ///< the footprint's standard deviations, samples; across <= along
  double shear_step = 0;         ///< of the shear, from one pixel to the next
};

class Ripmap {
 public:
  static constexpr int block = 64;  ///< pixels that a line answers at once

  /// `spline` holds coefficients of a periodic cubic B-spline (WaveTile::spline).
  explicit Ripmap(const InverseFft2& spline);

  /// No filtered value lies further from 0.
  float bound() const { return bound_; }

  class Line;

 private:
  struct Level {
    int width, height, stride;
    float* samples;  ///< rows continue periodically to the stride

    float* row(int y) const { return samples + static_cast<size_t>(y) * stride; }
  };

  const Level& level(int along_x, int along_y) const { return levels_[along_y * (along_y + 1) / 2 + along_x]; }
  void lay_out_levels();
  void copy(const InverseFft2& spline);
  void halve(int along_y);

  int size_, top_;                    ///< top: the coarsest level of both axes
  std::vector<Level> levels_;         ///< (x, y) with x <= y
  std::unique_ptr<float[]> samples_;  ///< of all levels
  float bound_ = 0;
};

/// A line of pixels on the plane, with what all its blocks have in common.
class Ripmap::Line {
 public:
  /// Refers to the map.
  Line(const Ripmap& map, const FootprintLine& line);

  /// Filtered values at `block` pixels from x on (samples of the tile); `shear`: at the first of them.
  void filtered(double x, double shear, float* values) const;

 private:
  static constexpr int most_taps = 12;

  void filtered_with_shear(double x, double shear, float* values) const;

  const Level* level_ = nullptr;  ///< null: the whole tile lies within a pixel
  int size_;                      ///< of the tile
  double scale_x_, step_;         ///< step: from one pixel to the next, samples of the level
  double shear_change_;           ///< along a block
  bool blends_;                   ///< the change is seen
  int passes_;                    ///< of smoothing along the line
  float side_;                    ///< what each gives to both neighbours
  double lean_;                   ///< of the taps, samples a line, for a shear of 1
  int taps_ = 0;
  std::array<const float*, most_taps> rows_;
  std::array<double, most_taps> beside_;  ///< lines from the line to the tap
  std::array<float, most_taps> weights_;
};

}  // namespace stillwater
