#pragma once

#include "core/image.h"

namespace stillwater {

using Mask = cv::Mat_<unsigned char>;  ///< H x W, 0 = no

/// An image as patches of it are compared: four bytes a pixel, whole numbers, so that the better of two patches is the
/// same on every machine. What lies outside of 0 .. 1 counts as 0 or 1.
///
/// Behind each row lie 32 bytes more that may be read, so that kernels needn't look where a row ends.
class PatchImage {
 public:
  PatchImage() = default;
  explicit PatchImage(const cv::Size& size);

  /// Of premultiplied colours: red, green, blue, alpha times 255.
  explicit PatchImage(const Rgba& image);

  cv::Vec4b& operator()(int y, int x) { return view_(y, x); }
  const cv::Vec4b& operator()(int y, int x) const { return view_(y, x); }

  const unsigned char* at(int y, int x) const { return view_.ptr<unsigned char>(y) + 4 * x; }
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(view_.step); }
  int width() const { return view_.cols; }
  int height() const { return view_.rows; }

 private:
  cv::Mat_<cv::Vec4b> whole_, view_;
};

/// A premultiplied pixel as four bytes.
cv::Vec4b as_bytes(const cv::Vec4f& pixel);

/// Pixels (not 0) around which a whole patch of `allowed` pixels lies, inside the image.
Mask patch_centres(const Mask& allowed, int patch);

/// Pixels (not 0) whose patch lies inside the image and holds a pixel of `region`.
Mask centres_that_touch(const Mask& region, int patch);

}  // namespace stillwater
