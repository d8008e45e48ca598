#include "example/sample_differences.h"

#include <algorithm>

#include "layers/displace.h"

namespace stillwater {

Rgba as_covering(const Rgb& differences) {
  Rgba covering(differences.size());
  std::transform(differences.begin(), differences.end(), covering.begin(),
                 [](const cv::Vec3f& colour) { return cv::Vec4f(colour[0], colour[1], colour[2], 1); });
  return covering;
}

Rgb without_coverage(const Rgba& covering) {
  Rgb differences(covering.size());
  std::transform(covering.begin(), covering.end(), differences.begin(),
                 [](const cv::Vec4f& colour) { return cv::Vec3f(colour[0], colour[1], colour[2]); });
  return differences;
}

Rgb sample_differences(const Rgb& differences, const Field& map, Beyond beyond) {
  return without_coverage(displace(as_covering(differences), map, beyond, beyond));
}

}  // namespace stillwater
