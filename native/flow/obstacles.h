#pragma once

#include "core/image.h"

/// What a painted flow may not run through: the outline of its layer, and what is held still.
namespace stillwater {

/// How far an obstacle is felt: 0.012 of the picture's diagonal, at least 4 px.
double obstacle_reach(cv::Size picture);

/// Where a flow may not cross: at each pixel the outline's normal times the root of the share of the flow across it that is
/// taken out, so that v - (v . wall) wall slides along. The share is 1 at the outline and outside, and falls smoothly to 0
/// obstacle_reach() inside. The outline is where the matte falls below `outside`; the picture's sides are none: a fluid may
/// run out of the picture.
///
/// `matte`: 0..1. Throws BadInput where it is outside of 0..1, or nowhere as much as `outside`.
Field wall_along(const Plane& matte);
inline constexpr float outside = 0.1f;  ///< less of a layer than this is none

/// v without its part through the wall.
inline cv::Vec2f slide(const cv::Vec2f& v, const cv::Vec2f& wall) { return v - v.dot(wall) * wall; }

/// 0..1, by which speeds are multiplied: 1 - freeze where it is below a half, 0 where it is more, and falling smoothly to that
/// over obstacle_reach() around. Throws BadInput where `freeze` is outside of 0..1.
Plane stillness_factor(const Plane& freeze);

}  // namespace stillwater
