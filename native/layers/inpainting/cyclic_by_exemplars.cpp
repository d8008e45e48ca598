#include "layers/inpainting/cyclic_by_exemplars.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/check.h"
#include "layers/cyclic.h"
#include "layers/inpainting/inpaint.h"

namespace stillwater {
namespace {

// Tone may lead a long way from the end to the beginning, and no edge stays at either.
constexpr BlendParameters along_the_strip{.screen = 0.02f, .step_of_tone = 10.0f, .border = 16.0f};
// Share of the image's steps, from one column to the next, that those into the strip must not be above; a little less,
// for what they are asked to be they are nearly.
constexpr double usual_share = 0.999, nearly = 0.75;

float usual_step(const Rgba& image) {
  std::vector<float> steps;
  for (int y = 0; y < image.rows; ++y)
    for (int x = 1; x < image.cols; ++x)
      for (int c = 0; c < 3; ++c) steps.push_back(std::abs(image(y, x)[c] - image(y, x - 1)[c]));
  if (steps.empty()) return along_the_strip.steepest;
  const auto at = steps.begin() + static_cast<std::ptrdiff_t>(usual_share * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), at, steps.end());
  return static_cast<float>(nearly * *at);
}

BlendParameters blend_of(const Rgba& image) {
  BlendParameters blend = along_the_strip;
  blend.steepest = usual_step(image);
  return blend;
}

// The image cut in its middle and put together with its strip between the ends, so that what was its border lies
// inside.
template <class Pixel>
cv::Mat_<Pixel> turned(const cv::Mat_<Pixel>& image, const cv::Point& by) {
  cv::Mat_<Pixel> result(image.size());
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) result((y + by.y) % image.rows, (x + by.x) % image.cols) = image(y, x);
  return result;
}

class Synthesis {
 public:
  Synthesis(const CyclicParameters& parameters, Progress& progress) : parameters_(parameters), progress_(progress) {}

  Rgba filled(const Rgba& image, const Plane& hole, const BlendParameters& blend, double weight) {
    const InpaintParameters how{
        .patch = parameters_.patch, .radius = {}, .seed = parameters_.seed, .grow = 0, .source = {}, .blend = blend};
    progress_.phase("making it endless", weight);
    return inpaint(image, hole, how, Progress([this](const std::string&, double share) {
                     progress_.at(share);
                     return true;
                   }));
  }

  Rgba continued_to_the_right(const Rgba& image, double weight) {
    const cv::Size period(cyclic_period(image.cols), image.rows);
    const cv::Rect there(cv::Point(), image.size());
    Rgba whole = Rgba::zeros(period);
    Plane hole = Plane::ones(period);
    image.copyTo(whole(there));
    hole(there).setTo(0);
    const int by = period.width - image.cols / 2;
    return turned(filled(turned(whole, {by, 0}), turned(hole, {by, 0}), blend_of(image), weight),
                  {period.width - by, 0});
  }

  // The strip below an image that wraps along x was filled as if it did not: where its ends meet it is filled once
  // more.
  Rgba with_closed_corner(const Rgba& whole, int known_rows, double weight) {
    const int strip = whole.rows - known_rows, width = std::min(whole.cols / 2, std::max(strip, 4 * parameters_.patch));
    const cv::Point by(whole.cols / 2, whole.rows / 2);
    Plane hole = Plane::zeros(whole.size());
    hole(cv::Rect(0, known_rows, width / 2, strip)).setTo(1);
    hole(cv::Rect(whole.cols - width / 2, known_rows, width / 2, strip)).setTo(1);
    return turned(filled(turned(whole, by), turned(hole, by), blend_of(whole), weight),
                  {whole.cols - by.x, whole.rows - by.y});
  }

 private:
  const CyclicParameters& parameters_;
  Progress& progress_;
};

Rgba transposed(const Rgba& image) { return Rgba(image.t()); }

}  // namespace

Rgba make_cyclic_by_exemplars(const Rgba& image, const CyclicParameters& parameters, Progress progress) {
  check::not_empty("image", image);
  if (parameters.known) check::same_size("known", *parameters.known, "the image", image);
  Synthesis synthesis(parameters, progress);
  const bool both = parameters.along_x && parameters.along_y, hidden = parameters.known.has_value();
  const double hidden_weight = hidden ? 0.2 : 0, strip_weight = (1 - hidden_weight) / (both ? 3 : 1);
  Rgba whole =
      hidden ? synthesis.filled(image, Plane(1 - *parameters.known), BlendParameters(), hidden_weight) : image.clone();
  const auto wide_enough = [&](int side) { return side >= 2 * parameters.patch; };
  if (parameters.along_x)
    whole = wide_enough(whole.cols) ? synthesis.continued_to_the_right(whole, strip_weight)
                                    : make_cyclic(whole, true, false);
  if (parameters.along_y) {
    whole = wide_enough(whole.rows) ? transposed(synthesis.continued_to_the_right(transposed(whole), strip_weight))
                                    : make_cyclic(whole, false, true);
    if (both && wide_enough(std::min(image.cols, image.rows)))
      whole = synthesis.with_closed_corner(whole, image.rows, strip_weight);
  }
  return whole;
}

}  // namespace stillwater
