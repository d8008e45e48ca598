#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

struct SteerableParameters {
  int scales = 4;        ///< 1 .. 12; the shorter side is longer than 2^scales pixels
  int orientations = 4;  ///< 1 .. 16
  bool complex = false;  ///< with the bands' quadrature partners; needs 2 orientations
};

/// A picture in parts by size and orientation; see SteerableFilters for the filters. Beyond its sides the picture begins anew.
/// `bands[scale][orientation]`, scale 0 the finest, ceil(side / 2^scale) pixels a side; orientation b answers to structure
/// whose gradient lies at pi b / orientations from x towards y (down).
struct SteerablePyramid {
  Plane highpass;
  std::vector<std::vector<Plane>> bands;
  std::vector<std::vector<Plane>> quadrature;  ///< as `bands`: the imaginary parts; empty where not complex
  Plane lowpass;
};

/// Throws BadInput where the image is empty or a parameter is out of its range.
SteerablePyramid steerable_pyramid(const Plane& image, const SteerableParameters& parameters = {});

/// The picture that has this pyramid: of the real parts, as `bands` hold all that there is. After any change of coefficients
/// it is the nearest picture (least squares), since the frame is tight. Throws BadInput where sizes do not belong together.
Plane collapse(const SteerablePyramid& pyramid);

}  // namespace stillwater
