#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// Where the pen was, and how hard it was pressed, 0..1: scales the stroke's width.
struct StrokePoint {
  double x = 0, y = 0, pressure = 1;
};

/// A line drawn over the picture. One point is a dot.
struct Stroke {
  std::vector<StrokePoint> points;
  double width = 10;  ///< px, the full width at pressure 1
};

/// Which pixels are drawn on: 255, else 0.
using Mask = cv::Mat_<unsigned char>;

/// Draws a stroke into a mask: a pixel is drawn on where its centre lies within half the width of the line, which
/// narrows and widens evenly between points. However thin a line is, it is nowhere thinner than a pixel: it has no
/// gaps, and each point draws on the pixel it lies in. What lies outside of the mask is left out. Gives a box around
/// what was drawn.
///
/// Throws BadInput, with `name` in its sentence, for a stroke without points, a place that is not a finite number, a
/// pressure outside 0..1, and a width that is not within 0 .. 16384.
cv::Rect draw(const Stroke& stroke, const std::string& name, Mask& mask);

}  // namespace stillwater
