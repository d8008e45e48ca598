#pragma once

#include <vector>

#include "layers/matting/stroke.h"
#include "layers/matting/trimap.h"

namespace stillwater {

/// Strokes on what is cut out, and beside it.
struct Scribbles {
  std::vector<Stroke> foreground, background;
};

/// Known where the strokes are, unknown everywhere else.
///
/// Throws BadInput where there is no stroke of one kind, or none of them touches the picture; where two strokes
/// contradict each other, with their numbers and the place; and for strokes that draw() refuses.
Trimap trimap_from_scribbles(const cv::Size& picture, const Scribbles& scribbles);

/// An outline drawn around what is cut out; it closes itself.
struct Lasso {
  std::vector<Point> outline;  ///< three points or more, not all on one line
  double feather = 8;          ///< px, 0 .. 1000: so far on both sides of the outline is unknown
  double snap = 0;             ///< px, 0 .. 1000: how far the outline may be pulled to edges (snap_outline)
};

/// Inside is foreground (every place that the outline goes round, however often), outside background, unknown within
/// `feather` of the outline. With a feather of 0 nothing is unknown: a pixel is inside where its centre is.
///
/// `picture` matters where the outline snaps. Throws BadInput for less than three points, places that are not finite
/// numbers, numbers out of range, and where no pixel is left inside or outside.
Trimap trimap_from_lasso(const Rgba& picture, const Lasso& lasso);

}  // namespace stillwater
