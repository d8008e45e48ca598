#include "patches/match_field.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stillwater {

MatchField MatchField::of(const Mask& centres) {
  MatchField field;
  field.area = cv::boundingRect(centres);
  field.wanted = centres(field.area).clone();
  field.offset = cv::Mat_<cv::Vec2s>::zeros(field.area.size());
  field.distance = cv::Mat_<int>(field.area.size(), unmatched);
  return field;
}

MatchField twice_as_large(const MatchField& field, const Mask& centres) {
  MatchField large = MatchField::of(centres);
  if (field.area.empty()) return large;
  for (int y = 0; y < large.area.height; ++y)
    for (int x = 0; x < large.area.width; ++x) {
      const int row = std::clamp((y + large.area.y) / 2 - field.area.y, 0, field.area.height - 1);
      const int column = std::clamp((x + large.area.x) / 2 - field.area.x, 0, field.area.width - 1);
      const cv::Vec2s& coarse = field.offset(row, column);
      large.offset(y, x) = {static_cast<short>(2 * coarse[0]), static_cast<short>(2 * coarse[1])};
    }
  return large;
}

}  // namespace stillwater
