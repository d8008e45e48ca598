#include "layers/inpainting/inpaint_level.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"

namespace stillwater {
namespace {

// A hole this many patches across is filled in one go.
constexpr double patches_across = 1.5;
// A level is at least so many patches large, and has so many to copy from.
constexpr int least_patches = 4, least_sources = 64;

// Half as large: (1 3 3 1) / 8 along both axes, of what is known.
void halve(const InpaintLevel& fine, InpaintLevel& coarse) {
  const cv::Size size((fine.hole.cols + 1) / 2, (fine.hole.rows + 1) / 2);
  coarse.colour.create(size);
  coarse.hole.create(size);
  coarse.allowed.create(size);
  constexpr float weights[4] = {1, 3, 3, 1};
  parallel_rows(size.height, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < size.width; ++x) {
        cv::Vec4f sum(0, 0, 0, 0);
        float known = 0;
        int inside = 0, open = 0, barred = 0;
        for (int j = 0; j < 4; ++j)
          for (int i = 0; i < 4; ++i) {
            const int row = 2 * y - 1 + j, column = 2 * x - 1 + i;
            if (row < 0 || column < 0 || row >= fine.hole.rows || column >= fine.hole.cols) continue;
            const bool is_open = fine.hole(row, column) != 0, covered = i % 3 != 0 && j % 3 != 0;
            if (covered) ++inside, open += is_open, barred += fine.allowed(row, column) == 0;
            if (is_open) continue;
            const float weight = weights[j] * weights[i];
            sum += weight * fine.colour(row, column);
            known += weight;
          }
        coarse.colour(y, x) = known > 0 ? sum * (1 / known) : cv::Vec4f(0, 0, 0, 0);
        coarse.hole(y, x) = 2 * open >= inside ? 255 : 0;
        coarse.allowed(y, x) = barred > 0 ? 0 : 255;
      }
  });
}

double half_width(const Mask& hole) {
  cv::Mat_<float> depth;
  Mask padded;  // the picture's sides don't close a hole
  cv::copyMakeBorder(hole, padded, 1, 1, 1, 1, cv::BORDER_REPLICATE);
  cv::distanceTransform(padded, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double deepest = 0;
  cv::minMaxLoc(depth, nullptr, &deepest);
  return deepest;
}

bool usable(const InpaintLevel& level, int patch) {
  if (std::min(level.hole.cols, level.hole.rows) < least_patches * patch) return false;
  if (cv::countNonZero(level.hole) == 0 || cv::countNonZero(level.centres) < least_sources) return false;
  return level.radius == 0 || most_remote(level, patch).distance <= level.radius;
}

}  // namespace

std::vector<InpaintLevel> inpaint_levels(const Rgba& picture, const Mask& hole, const Mask& allowed, int patch,
                                         double radius, const std::function<void()>& still_wanted) {
  std::vector<InpaintLevel> levels(1);
  levels[0] = {picture.clone(), {}, hole, allowed, patch_centres(allowed, patch), radius};
  while (2 * half_width(levels.back().hole) > patches_across * patch) {
    still_wanted();
    InpaintLevel coarse;
    halve(levels.back(), coarse);
    coarse.centres = patch_centres(coarse.allowed, patch);
    coarse.radius = levels.back().radius / 2;
    if (!usable(coarse, patch)) break;
    levels.push_back(coarse);
  }
  still_wanted();
  for (InpaintLevel& level : levels) level.bytes = PatchImage(level.colour);
  return levels;
}

Remoteness most_remote(const InpaintLevel& level, int patch) {
  cv::Mat_<float> distance;
  const Mask no_source = level.centres == 0;
  if (cv::countNonZero(level.centres) == 0) return {1e9, {}};
  cv::distanceTransform(no_source, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double furthest = 0;
  cv::Point where;
  cv::minMaxLoc(distance, nullptr, &furthest, nullptr, &where, centres_that_touch(level.hole, patch));
  return {furthest, where};
}

}  // namespace stillwater
