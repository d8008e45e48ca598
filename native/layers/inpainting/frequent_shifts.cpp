#include "layers/inpainting/frequent_shifts.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "patches/match_field.h"
#include "patches/patch_match.h"

namespace stillwater {
namespace {

constexpr int not_near = 15;  // 1/n of the picture's longer side: He and Sun's tau
constexpr int search_rounds = 4;
constexpr double blur = 1.4142;
constexpr int peak_reach = 4;  // nothing within so many pixels is as high as a peak

cv::Rect around_hole(const Mask& hole) {
  const cv::Rect box = cv::boundingRect(hole);
  const int margin = std::max(box.width, box.height);
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect(cv::Point(), hole.size());
}

struct Peak {
  float height;
  cv::Vec2s shift;
};

std::vector<Peak> peaks_of(const cv::Mat_<float>& histogram, const cv::Point& zero) {
  cv::Mat_<float> highest;
  const int side = 2 * peak_reach + 1;
  cv::dilate(histogram, highest, cv::Mat_<unsigned char>::ones(side, side));
  std::vector<Peak> peaks;
  for (int y = 0; y < histogram.rows; ++y)
    for (int x = 0; x < histogram.cols; ++x)
      if (histogram(y, x) > 0 && histogram(y, x) >= highest(y, x))
        peaks.push_back({histogram(y, x), {static_cast<short>(x - zero.x), static_cast<short>(y - zero.y)}});
  std::stable_sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) { return a.height > b.height; });
  return peaks;
}

}  // namespace

std::vector<cv::Vec2s> frequent_shifts(const InpaintLevel& level, const FrequentShiftsParameters& parameters,
                                       const std::function<void(double)>& at) {
  const cv::Size size = level.hole.size();
  Mask wanted = Mask::zeros(size);
  const cv::Rect part = around_hole(level.hole);
  level.centres(part).copyTo(wanted(part));
  MatchField field = MatchField::of(wanted);
  const double tau = std::max(size.width, size.height) / static_cast<double>(not_near);
  patch_match(level.bytes, level.bytes, level.centres, field,
              {.patch = parameters.patch,
               .rounds = search_rounds,
               .radius = level.radius,
               .nearest = tau,
               .seed = parameters.seed},
              at);
  cv::Mat_<float> histogram = cv::Mat_<float>::zeros(2 * size.height + 1, 2 * size.width + 1);
  for (int y = 0; y < field.area.height; ++y)
    for (int x = 0; x < field.area.width; ++x)
      if (field.wanted(y, x) && field.distance(y, x) != MatchField::unmatched)
        histogram(field.offset(y, x)[1] + size.height, field.offset(y, x)[0] + size.width) += 1;
  cv::GaussianBlur(histogram, histogram, cv::Size(), blur, blur, cv::BORDER_CONSTANT);
  std::vector<cv::Vec2s> shifts;
  for (const Peak& peak : peaks_of(histogram, {size.width, size.height})) {
    if (shifts.size() == parameters.most) break;
    shifts.push_back(peak.shift);
  }
  return shifts;
}

}  // namespace stillwater
