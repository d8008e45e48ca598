#pragma once

#include <memory>

#include "core/image.h"

/// How one layer is displaced at one moment, both ways. What sway, ripple, bob and drift implement, and all that
/// the layers that follow another one need of it.
///
///     still picture  --map-->  picture at this moment        (forward displacement, METHODS.md 1)
///     still picture <--unmap-- picture at this moment        (where to sample)
///
/// Points are picture pixels in two parallel arrays and are changed in place. An object stands for one moment,
/// never changes once made, and is read by many threads.
namespace stillwater {

class Displacement {
 public:
  virtual ~Displacement() = default;

  /// True where map and unmap are exactly the identity.
  virtual bool at_rest() const = 0;

  /// No point of the picture is displaced further than this, pixels.
  virtual float reach() const = 0;

  /// Picture pixels outside of which nothing of `box` (of the still picture) is displaced to.
  virtual cv::Rect spread(const cv::Rect& box) const;

  virtual void map(float* x, float* y, int count) const = 0;
  virtual void unmap(float* x, float* y, int count) const = 0;

  /// unmap() of `count` points that lie `step` apart on one row, from (x0, y0) on; the results go to x, y.
  /// Overridden where a row is cheaper than its points.
  virtual void unmap_row(float x0, float y0, float step, int count, float* x, float* y) const;
};

/// `base` as it looks in a mirror: reflected about the line through both ends of `axis` (a reflection in water, of
/// what stands on it). Throws BadInput for an axis without length.
std::shared_ptr<const Displacement> mirrored(std::shared_ptr<const Displacement> base, const Segment& axis);

/// First the one, then, on top of it, the other. Null stands for no displacement, in the arguments and the answer.
std::shared_ptr<const Displacement> chained(std::shared_ptr<const Displacement> first,
                                            std::shared_ptr<const Displacement> then);

/// The map as an array: for each pixel of a picture of this size, where it is sampled minus where it is.
Field displacement_map(const Displacement& displacement, int width, int height);

/// The same forwards: where the point of the still picture goes, minus where it was.
Field forward_map(const Displacement& displacement, int width, int height);

}  // namespace stillwater
