#include "layers/matting/coarse_to_fine.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "layers/matting/affine_alpha.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
// Keeps a from growing where colours hardly change (colour squared).
constexpr double ridge = 1e-5;

bool flat_around(const Plane& matte, int y, int x) {
  const float value = matte(y, x);
  for (int ny = std::max(0, y - 1); ny <= std::min(matte.rows - 1, y + 1); ++ny)
    for (int nx = std::max(0, x - 1); nx <= std::min(matte.cols - 1, x + 1); ++nx)
      if (matte(ny, nx) != value) return false;
  return true;
}

// What was unknown and is decided by a matte, with all that is within two pixels of it, becomes known.
Trimap decided(const Trimap& trimap, const Plane& matte, float near) {
  cv::Mat low, high;
  const cv::Mat around = cv::Mat::ones(5, 5, CV_8U);
  cv::dilate(matte, high, around);
  cv::erode(matte, low, around);
  Trimap result = trimap.clone();
  const cv::Mat unknown = trimap == known::unknown;
  result.setTo(known::background, unknown & (high <= near));
  result.setTo(known::foreground, unknown & (low >= 1 - near));
  return result;
}

bool has_both(const Trimap& trimap) {
  const TrimapCount total = count(trimap);
  return total.foreground > 0 && total.background > 0;
}

bool can_be_solved_at_once(const Trimap& trimap, const CoarseToFineOptions& options) {
  const long long unknown = count(trimap).unknown;
  const bool scribbled = 4 * unknown > 3 * static_cast<long long>(trimap.total());
  return unknown <= (scribbled ? options.at_once_scribbled : options.at_once);
}

}  // namespace

Rgba half_of(const Rgba& picture) {
  Rgba half((picture.rows + 1) / 2, (picture.cols + 1) / 2);
  parallel_rows(half.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const cv::Vec4f *top = picture[2 * y], *bottom = picture[std::min(picture.rows - 1, 2 * y + 1)];
      for (int x = 0; x < half.cols; ++x) {
        const int left = 2 * x, right = std::min(picture.cols - 1, left + 1);
        half(y, x) = ((top[left] + top[right]) + (bottom[left] + bottom[right])) * 0.25f;
      }
    }
  });
  return half;
}

Trimap half_of(const Trimap& trimap) {
  Trimap half((trimap.rows + 1) / 2, (trimap.cols + 1) / 2);
  for (int y = 0; y < half.rows; ++y)
    for (int x = 0; x < half.cols; ++x) {
      bool foreground = false, background = false;
      for (int ny = 2 * y; ny <= std::min(trimap.rows - 1, 2 * y + 1); ++ny)
        for (int nx = 2 * x; nx <= std::min(trimap.cols - 1, 2 * x + 1); ++nx) {
          foreground |= trimap(ny, nx) == known::foreground;
          background |= trimap(ny, nx) == known::background;
        }
      half(y, x) = foreground == background ? known::unknown : foreground ? known::foreground : known::background;
    }
  return half;
}

Plane enlarge_matte(const Plane& matte, const Rgba& half, const Rgba& picture) {
  cv::Mat_<cv::Vec4f> affine(matte.size()), large;
  parallel_rows(matte.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < matte.cols; ++x)
        if (flat_around(matte, y, x)) {
          affine(y, x) = {0, 0, 0, matte(y, x)};
        } else {
          const AffineAlpha fit = fit_affine_alpha(half, matte, {x, y}, 1, ridge);
          affine(y, x) = cv::Vec4d(fit.slope[0], fit.slope[1], fit.slope[2], fit.offset);
        }
  });
  cv::blur(affine, affine, cv::Size(3, 3), cv::Point(-1, -1), cv::BORDER_REPLICATE);
  cv::resize(affine, large, cv::Size(2 * matte.cols, 2 * matte.rows), 0, 0, cv::INTER_LINEAR);
  Plane result(picture.size());
  parallel_rows(picture.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const cv::Vec4f &a = large(y, x), &colour = picture(y, x);
        result(y, x) = std::clamp(a[0] * colour[0] + a[1] * colour[1] + a[2] * colour[2] + a[3], 0.0f, 1.0f);
      }
  });
  return result;
}

Plane coarse_to_fine(const Rgba& picture, const Trimap& trimap, const CoarseToFineOptions& options,
                     const SolveLevel& solve) {
  const bool enlarge_only = options.finest > 1;
  const bool small = std::min(picture.rows, picture.cols) < 8;
  if (small || (!enlarge_only && can_be_solved_at_once(trimap, options))) return solve(picture, trimap, {});
  const Trimap half_trimap = half_of(trimap);
  if (!has_both(half_trimap)) return solve(picture, trimap, {});
  const Rgba half = half_of(picture);
  CoarseToFineOptions further = options;
  further.finest = std::max(1, options.finest / 2);
  const Plane start = enlarge_matte(coarse_to_fine(half, half_trimap, further, solve), half, picture);
  if (!enlarge_only) return solve(picture, decided(trimap, start, static_cast<float>(options.decided)), start);
  Plane matte = grey_of(trimap);
  start.copyTo(matte, trimap == known::unknown);
  return matte;
}

}  // namespace stillwater
