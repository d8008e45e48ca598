#include "layers/inpainting/inpaint.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "layers/inpainting/blend_seams.h"
#include "layers/inpainting/coarse_to_fine.h"
#include "layers/inpainting/inpaint_level.h"
#include "layers/inpainting/shift_map.h"
#include "patches/patch_distance.h"

namespace stillwater {
namespace {

constexpr int least_patch = 3;
bool is_finite(const cv::Vec4f& pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]) && std::isfinite(pixel[3]);
}

void check_numbers(const Rgba& picture, const Mask& hole) {
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (!hole(y, x) && !is_finite(picture(y, x)))
        throw BadInput("picture: pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") is not a finite number");
}

Mask as_mask(std::string_view name, const Plane& plane) {
  Mask mask(plane.size());
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x) {
      if (std::isnan(plane(y, x)))
        throw BadInput(std::string(name) + ": pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                       ") is not a finite number");
      mask(y, x) = plane(y, x) >= 0.5f ? 255 : 0;
    }
  return mask;
}

void check_parameters(const InpaintParameters& parameters) {
  check::in_range("patch", parameters.patch, least_patch, largest_patch, "px");
  if (parameters.patch % 2 == 0) throw BadInput("patch: " + std::to_string(parameters.patch) + " is not odd (px)");
  if (parameters.radius) check::positive("radius", *parameters.radius, "px");
  check::in_range("grow", parameters.grow, 0, 1000, "px");
}

// The pixels that may be copied.
Mask allowed_pixels(const Mask& hole, const InpaintParameters& parameters) {
  Mask barred;
  const int side = 2 * parameters.grow + 1;
  cv::dilate(hole, barred, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(side, side)));
  Mask allowed = barred == 0;
  if (parameters.source) allowed &= as_mask("source", *parameters.source);
  return allowed;
}

void check_sources(const InpaintLevel& level, const InpaintParameters& parameters) {
  std::ostringstream sentence;
  if (cv::countNonZero(level.centres) == 0) {
    sentence << (parameters.source ? "source" : "hole") << ": there is no patch of " << parameters.patch << " x "
             << parameters.patch << " px to copy from, " << parameters.grow << " px or more from the hole";
    throw BadInput(sentence.str());
  }
  if (!parameters.radius) return;
  const Remoteness remote = most_remote(level, parameters.patch);
  if (remote.distance <= *parameters.radius) return;
  sentence << "radius: within " << *parameters.radius << " px of (" << remote.centre.x << ", " << remote.centre.y
           << ") there is nothing to copy from; the nearest is " << std::ceil(remote.distance) << " px away";
  throw BadInput(sentence.str());
}

// A picture narrower than a patch goes on mirrored.
struct Margins {
  int x, y;

  Margins(const cv::Size& size, int patch) : x(std::max(0, patch - size.width)), y(std::max(0, patch - size.height)) {}

  template <class Image>
  Image widened(const Image& image) const {
    if (x == 0 && y == 0) return image;
    Image wide;
    cv::copyMakeBorder(image, wide, 0, y, 0, x, cv::BORDER_REFLECT);
    return wide;
  }
};

}  // namespace

Rgba inpaint(const Rgba& picture, const Plane& hole, const InpaintParameters& parameters, Progress progress) {
  check::not_empty("picture", picture);
  check::same_size("hole", hole, "the picture", picture);
  if (parameters.source) check::same_size("source", *parameters.source, "the picture", picture);
  check_parameters(parameters);
  const Mask open = as_mask("hole", hole);
  check_numbers(picture, open);
  const int count = cv::countNonZero(open);
  if (count == 0) return picture.clone();
  if (count == picture.rows * picture.cols)
    throw BadInput("hole: it covers the whole picture; nothing is left to copy from");

  if (parameters.patch > std::max(picture.cols, picture.rows)) {
    throw BadInput("patch: " + std::to_string(parameters.patch) + " is larger than the picture, " +
                   std::to_string(picture.cols) + " x " + std::to_string(picture.rows) + " (px)");
  }

  progress.phase("filling the hole", 0.9);
  const Margins margins(picture.size(), parameters.patch);
  std::vector<InpaintLevel> levels =
      inpaint_levels(margins.widened(picture), margins.widened(open), margins.widened(allowed_pixels(open, parameters)),
                     parameters.patch, parameters.radius.value_or(0), [&] { progress.at(0); });
  InpaintLevel& finest = levels[0];
  check_sources(finest, parameters);
  const CoarseToFineParameters how{.patch = parameters.patch, .seed = parameters.seed};
  const ShiftMap shifts = fill_coarse_to_fine(levels, how, [&](double share) { progress.at(share); });
  copy_shifted(shifts, finest.hole, finest.colour);

  progress.phase("blending the seams", 0.1);
  if (parameters.blend)
    blend_seams(shifts, finest.hole, finest.colour, *parameters.blend, [&](double share) { progress.at(share); });
  progress.at(1);
  return Rgba(finest.colour(cv::Rect(cv::Point(), picture.size()))).clone();
}

}  // namespace stillwater
