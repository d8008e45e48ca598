#include "layers/push_pull.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

// A pixel that knows a quarter of its surroundings speaks for them: holes close with what is near.
constexpr float trust = 4;

template <class Pixel>
float coverage(const Pixel& pixel) {
  return pixel[Pixel::channels - 1];
}

template <class Pixel>
cv::Mat_<Pixel> pushed(const cv::Mat_<Pixel>& level) {
  cv::Mat_<Pixel> smaller;
  cv::pyrDown(level, smaller);
  for (Pixel& pixel : smaller)
    if (coverage(pixel) > 0) pixel *= std::min(1.0f, trust * coverage(pixel)) / coverage(pixel);
  return smaller;
}

template <class Pixel>
void lay_over(cv::Mat_<Pixel>& level, const cv::Mat_<Pixel>& below) {
  auto under = below.begin();
  for (Pixel& pixel : level) {
    if (coverage(pixel) < 1) pixel += (1 - coverage(pixel)) * *under;
    ++under;
  }
}

template <class Pixel>
void push_and_pull(cv::Mat_<Pixel>& known) {
  check::not_empty("known", known);
  std::vector<cv::Mat_<Pixel>> levels{known};
  while (levels.back().cols > 1 || levels.back().rows > 1) levels.push_back(pushed(levels.back()));
  Pixel& last = levels.back()(0, 0);
  if (!(coverage(last) > 0)) throw BadInput("known: nothing is known that could fill the rest");
  last /= coverage(last);
  for (size_t i = levels.size() - 1; i > 0; --i) {
    cv::Mat_<Pixel> enlarged;
    cv::pyrUp(levels[i], enlarged, cv::Size(2 * levels[i].cols, 2 * levels[i].rows));
    levels.pop_back();
    lay_over<Pixel>(levels[i - 1], enlarged(cv::Rect(0, 0, levels[i - 1].cols, levels[i - 1].rows)));
  }
}

}  // namespace

void fill_by_push_pull(Rgba& known) { push_and_pull(known); }
void fill_by_push_pull(cv::Mat_<cv::Vec2f>& known) { push_and_pull(known); }

Rgba push_pull(const Rgba& known) {
  Rgba filled = known.clone();
  push_and_pull(filled);
  return filled;
}

cv::Rect surroundings(const Plane& region) {
  const cv::Rect box = cv::boundingRect(region > 0);
  if (box.empty()) return box;
  const int margin = std::max(32, std::max(box.width, box.height) / 4);
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect(0, 0, region.cols, region.rows);
}

}  // namespace stillwater
