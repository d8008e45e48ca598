#include "example/local_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "flow/optical_flow.h"

namespace stillwater {
namespace {

constexpr float most_gain = 3;  // times the whole picture's
constexpr float least_weight = 1e-3f;
constexpr float held_at = 2.5f;  // deviations

template <class Pixel>
cv::Mat_<Pixel> blurred(const cv::Mat_<Pixel>& image, double sigma) {
  cv::Mat_<Pixel> blurred_image;
  cv::GaussianBlur(image, blurred_image, cv::Size(), sigma, sigma, cv::BORDER_REFLECT);
  return blurred_image;
}

Rgb times(const Rgb& colours, const Plane& factor) {
  Rgb product(colours.size());
  std::transform(colours.begin(), colours.end(), factor.begin(), product.begin(),
                 [](const cv::Vec3f& colour, float by) { return by * colour; });
  return product;
}

/// Weighted means around each place.
class Around {
 public:
  Around(const Plane& weight, double sigma)
      : sigma_(sigma), weight_(weight + least_weight), all_(blurred(weight_, sigma)) {}

  Plane mean(const Plane& values) const { return blurred(Plane(values.mul(weight_)), sigma_) / all_; }

  Rgb mean(const Rgb& values) const {
    std::vector<Plane> channels(3);
    cv::split(values, channels);
    for (Plane& channel : channels) channel = mean(channel);
    Rgb means;
    cv::merge(channels, means);
    return means;
  }

  double whole(const Plane& values) const { return cv::sum(values.mul(weight_))[0] / cv::sum(weight_)[0]; }

 private:
  double sigma_;
  Plane weight_, all_;
};

}  // namespace

LocalContrast local_contrast(const Rgb& difference, const std::vector<Rgb>& moments, const Plane& weight, double around) {
  check::positive("around", around, "px");
  check::same_size("weight", weight, "difference", difference);
  if (moments.empty()) throw BadInput("moments: none is not at least one");
  const Around places(weight, around);
  LocalContrast found;
  found.mean = places.mean(difference);
  const Rgb own = difference - found.mean;
  const Plane own_grey = luma(own), own_square = own_grey.mul(own_grey);
  Plane film_square(difference.size(), 0.0f);
  for (const Rgb& moment : moments) {
    check::same_size("moments", moment, "difference", difference);
    const Plane grey = luma(moment);
    film_square += grey.mul(grey) / static_cast<double>(moments.size());
  }
  const double whole = places.whole(film_square);
  found.slope = Rgb(difference.size(), cv::Vec3f());
  found.hold = Plane(difference.size(), 0.0f);
  if (!(whole > 0)) return found;
  const auto most = static_cast<float>(most_gain * std::sqrt(places.whole(own_square) / whole));
  const Plane wanted = places.mean(own_square), has = places.mean(film_square);
  const Rgb together = places.mean(times(own, own_grey));
  const auto nothing = static_cast<float>(1e-6 * whole), colourless = static_cast<float>(1e-9);
  for (int y = 0; y < found.slope.rows; ++y)
    for (int x = 0; x < found.slope.cols; ++x) {
      const float square = std::max(0.0f, wanted(y, x));
      const float gain = std::min(most, std::sqrt(square / std::max(nothing, has(y, x))));
      found.hold(y, x) = held_at * std::sqrt(std::max(nothing, has(y, x)));
      found.slope(y, x) = gain / (square + colourless) * together(y, x);
    }
  return found;
}

}  // namespace stillwater
