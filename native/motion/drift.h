#pragma once

#include "motion/rigid.h"
#include "motion/wind.h"

/// Clouds: a layer that passes for ever (Chuang et al. 2005, 3.1; RECIPE.md, `loop` and `drift`).
namespace stillwater {

/// The recipe's `drift`, resolved: the velocity enters through its integral.
struct Drift {
  Point offset;       ///< travelled since frame 1, pixels
  Point loop_offset;  ///< gained over one loop, pixels (looping only)
};

/// Where the layer's one or two copies lie.
struct DriftCopies {
  Point first, second;      ///< offset of each copy, pixels
  double second_share = 0;  ///< 0 .. 1, weight of the second copy; 0 = the first alone
  Point start_over;         ///< way after which the first copy may start over where it was; (0, 0) = it never does
};

/// Without a loop one copy at the offset. A loop closes by whole turns of the cyclic layer, its way stretched evenly,
/// where that changes the speed by no more than 10 %. Else by two copies half a loop apart, each of which starts over
/// while the other stands alone: the first in the middle of the loop, the second at its ends.
/// At the loop's first frame the first copy stands alone at the plain offset.
///
/// `period`: width and height of the cyclic layer, pixels. Throws BadInput where it is not above 0.
DriftCopies drift(const Drift& drift, const Moment& moment, Point period);

}  // namespace stillwater
