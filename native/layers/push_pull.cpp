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

Rgba pushed(const Rgba& level) {
  Rgba smaller;
  cv::pyrDown(level, smaller);
  for (cv::Vec4f& pixel : smaller)
    if (pixel[3] > 0) pixel *= std::min(1.0f, trust * pixel[3]) / pixel[3];
  return smaller;
}

void lay_over(Rgba& level, const Rgba& below) {
  auto under = below.begin();
  for (cv::Vec4f& pixel : level) {
    if (pixel[3] < 1) pixel += (1 - pixel[3]) * *under;
    ++under;
  }
}

}  // namespace

Rgba push_pull(const Rgba& known) {
  check::not_empty("known", known);
  std::vector<Rgba> levels{known.clone()};
  while (levels.back().cols > 1 || levels.back().rows > 1) levels.push_back(pushed(levels.back()));
  cv::Vec4f& last = levels.back()(0, 0);
  if (!(last[3] > 0)) throw BadInput("known: nothing is known that could fill the rest");
  last /= last[3];
  for (size_t i = levels.size() - 1; i > 0; --i) {
    Rgba enlarged;
    cv::pyrUp(levels[i], enlarged, cv::Size(2 * levels[i].cols, 2 * levels[i].rows));
    lay_over(levels[i - 1], enlarged(cv::Rect(0, 0, levels[i - 1].cols, levels[i - 1].rows)));
  }
  return levels[0];
}

}  // namespace stillwater
