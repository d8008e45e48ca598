#include "layers/extend_colours.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "layers/push_pull.h"

namespace stillwater {
namespace {

constexpr float inside = 0.5f;  // of the largest coverage

cv::Vec4f straight(const cv::Vec4f& colour) {
  return {colour[0] / colour[3], colour[1] / colour[3], colour[2] / colour[3], 1};
}

}  // namespace

Rgba extend_colours(const Rgba& layer) {
  check::not_empty("layer", layer);
  if (std::all_of(layer.begin(), layer.end(), [](const cv::Vec4f& colour) { return colour[3] == 1; })) return layer.clone();
  float most = 0;
  for (const cv::Vec4f& colour : layer) most = std::max(most, colour[3]);
  if (most <= 0) throw BadInput("layer: covers nothing (there is no colour to go on with)");
  cv::Mat_<unsigned char> outside(layer.size());
  parallel_pixels(layer.size(), [&](int y, int x) { outside(y, x) = layer(y, x)[3] < inside * most; });
  cv::Mat_<float> distance;
  cv::Mat_<int> nearest;
  cv::distanceTransform(outside, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Point> places(1);  // of each label, which count from 1
  for (int y = 0; y < layer.rows; ++y)
    for (int x = 0; x < layer.cols; ++x) {
      if (outside(y, x)) continue;
      const auto label = static_cast<size_t>(nearest(y, x));
      if (label >= places.size()) places.resize(label + 1);
      places[label] = {x, y};
    }
  Rgba extended(layer.size());
  const cv::Rect whole(cv::Point(), layer.size());
  parallel_pixels(layer.size(), [&](int y, int x) {
    const cv::Point mirrored = 2 * places[nearest(y, x)] - cv::Point(x, y);
    const bool known = whole.contains(mirrored) && !outside(mirrored);
    extended(y, x) = known ? straight(layer(mirrored)) : cv::Vec4f();
  });
  fill_by_push_pull(extended);
  return extended;
}

}  // namespace stillwater
