#include "patches/patch_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int spare_pixels = 8;  // 32 bytes

void clear_border(Mask& mask, int width) {
  const Mask inside = mask.clone();
  mask.setTo(0);
  const cv::Rect inner(width, width, mask.cols - 2 * width, mask.rows - 2 * width);
  if (inner.width > 0 && inner.height > 0) inside(inner).copyTo(mask(inner));
}

}  // namespace

PatchImage::PatchImage(const cv::Size& size)
    : whole_(cv::Mat_<cv::Vec4b>::zeros(size.height, size.width + spare_pixels)),
      view_(whole_.colRange(0, size.width)) {}

PatchImage::PatchImage(const Rgba& image) : PatchImage(image.size()) {
  parallel_rows(image.rows, 64, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < image.cols; ++x) view_(y, x) = as_bytes(image(y, x));
  });
}

cv::Vec4b as_bytes(const cv::Vec4f& pixel) {
  cv::Vec4b bytes;
  for (int c = 0; c < 4; ++c) bytes[c] = static_cast<unsigned char>(std::clamp(pixel[c], 0.0f, 1.0f) * 255.0f + 0.5f);
  return bytes;
}

Mask patch_centres(const Mask& allowed, int patch) {
  Mask centres;
  cv::erode(allowed, centres, Mask::ones(patch, patch), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  clear_border(centres, patch / 2);
  return centres;
}

Mask centres_that_touch(const Mask& region, int patch) {
  Mask centres;
  cv::dilate(region, centres, Mask::ones(patch, patch), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  clear_border(centres, patch / 2);
  return centres;
}

}  // namespace stillwater
