#include "appearance/laplacian_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

std::string shape(const Plane& plane) { return std::to_string(plane.cols) + " x " + std::to_string(plane.rows); }

cv::Size half(cv::Size size) { return {(size.width + 1) / 2, (size.height + 1) / 2}; }

}  // namespace

std::vector<Plane> laplacian_pyramid(const Plane& image, int scales) {
  check::not_empty("image", image);
  check::in_range("scales", scales, 1, 12);
  if (std::min(image.cols, image.rows) <= 1 << scales)
    throw BadInput("scales: " + std::to_string(scales) + " is not a number of halvings that leaves 2 pixels a side of " +
                   shape(image));
  std::vector<Plane> levels{image};
  for (int scale = 0; scale < scales; ++scale) {
    Plane smaller, larger;
    cv::pyrDown(levels.back(), smaller, half(levels.back().size()));
    cv::pyrUp(smaller, larger, levels.back().size());
    levels.back() = Plane(levels.back() - larger);
    levels.push_back(smaller);
  }
  return levels;
}

Plane collapse(const std::vector<Plane>& laplacian) {
  if (laplacian.empty()) throw BadInput("levels: 0 is not at least 1");
  Plane picture = laplacian.back();
  check::not_empty("levels", picture);
  for (size_t level = laplacian.size() - 1; level-- > 0;) {
    if (half(laplacian[level].size()) != picture.size())
      throw BadInput("levels: " + shape(picture) + " is not half of " + shape(laplacian[level]));
    Plane larger;
    cv::pyrUp(picture, larger, laplacian[level].size());
    picture = Plane(larger + laplacian[level]);
  }
  return picture;
}

}  // namespace stillwater
