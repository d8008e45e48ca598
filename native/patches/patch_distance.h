#pragma once

#include "patches/patch_image.h"

namespace stillwater {

/// The largest patch whose distance fits an int, pixels a side.
inline constexpr int largest_patch = 63;

/// Sum of squared differences of two square patches of `patch` (odd) pixels a side, over all four channels, by their
/// centres, which must lie so that the patches are inside their images. Where the sum is not below `limit`, some
/// number that isn't either: a search gives the best so far and loses no time on what is worse.
class PatchDistance {
 public:
  PatchDistance(const PatchImage& target, const PatchImage& source, int patch);

  int operator()(const cv::Point& target, const cv::Point& source, int limit) const {
    return kernel_(target_.at(target.y - half_, target.x - half_), target_.stride(),
                   source_.at(source.y - half_, source.x - half_), source_.stride(), 2 * half_ + 1, limit);
  }

 private:
  using Kernel = int (*)(const unsigned char*, std::ptrdiff_t, const unsigned char*, std::ptrdiff_t, int, int);

  const PatchImage &target_, &source_;
  int half_;
  Kernel kernel_;
};

}  // namespace stillwater
