#pragma once

#include <optional>
#include <opencv2/core.hpp>

#include "core/image.h"

/// How the picture sees the water: a level plane under a pinhole camera whose principal point is the picture's
/// centre. A horizon and a field of view make the plane metric (METHODS.md 1; Criminisi et al. 2000, "Single view
/// metrology", 2: the horizon is the plane's vanishing line l, and n ~ K^T l points up).
namespace stillwater {

/// The recipe's `view`.
struct View {
  std::optional<Segment> horizon;  ///< any line of the picture's plane, inside or outside the picture
  double fov = 50;                 ///< horizontal, degrees, 5 .. 150
  double height = 1.7;             ///< of the eye over the water, metres

  /// True where part of `box` (picture pixels) lies below the horizon.
  bool any_water(cv::Rect box) const;
};

/// The plane in *level coordinates*: picture pixels counted from the principal point, turned so that the horizon
/// runs along x and the water lies at larger y.
///
///            e2 (away)                      horizon ________________ y = horizon()
///             |                                        water
///     eye ____|____ e1 (right)                       .          .        s = cosine (y - horizon) / focal
///      | height                                    .              .      lambda = height / s
///     foot = (0, 0) of the ground               .                    .   ground = lambda (r.e1, r.e2)
///
/// The water lies at the side of the horizon where y of the picture grows; at the right of an upright horizon.
class WaterPlane {
 public:
  /// Throws BadInput: no horizon or one of zero length, fov or height out of range, a picture without pixels.
  WaterPlane(const View& view, cv::Size picture);

  Point level(Point picture) const;
  Point picture(Point level) const;

  double horizon() const { return horizon_; }  ///< y of the horizon
  double focal() const { return focal_; }      ///< pixels
  double height() const { return height_; }    ///< metres
  double cosine() const { return cosine_; }    ///< of the camera's pitch
  double up_z() const { return up_z_; }        ///< the up direction along the optical axis; below 0 looking down

  /// s of the class comment; above 0 on the water. Its product with a distance along the optical axis is the
  /// height of the eye.
  double slant(double level_y) const { return cosine_ * (level_y - horizon_) / focal_; }

  /// Where the plane is seen at a picture point below the horizon: metres to the right and away, from the foot of
  /// the eye. Throws BadInput on or above the horizon.
  Point ground(Point picture) const;

  /// Where a point of the ground, raised by `rise` metres, is seen. Throws BadInput behind the camera.
  Point seen(Point ground, double rise) const;

 private:
  Point centre_, along_;  // along: the horizon's direction to the right
  double focal_, height_, horizon_, cosine_, up_z_;
};

}  // namespace stillwater
