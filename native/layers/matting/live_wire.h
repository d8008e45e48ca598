#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// Pulls a closed outline to the picture's edges, nowhere further than `reach` px: between anchors along it, each on
/// the strongest edge near by, goes the cheapest way from pixel to pixel (Dijkstra), cheap along edges. Then the ways'
/// middles are the anchors, once, so that no anchor that was badly placed remains (Mortensen and Barrett 1995,
/// "Intelligent scissors for image composition"; its cost here is the gradient's alone, the largest of red, green and
/// blue).
///
/// `outline`: three points or more, picture coordinates. Gives a closed outline again; parts outside of the picture
/// stay as they are drawn.
std::vector<Point> snap_outline(const Rgba& picture, const std::vector<Point>& outline, double reach);

}  // namespace stillwater
