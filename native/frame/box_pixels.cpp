#include "frame/box_pixels.h"

#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "flow/streamline.h"

namespace stillwater {

std::vector<Field> scaled_fields(const std::vector<Field>& velocities, const Plate& plate) {
  std::vector<Field> scaled;
  for (const Field& velocity : velocities) {
    check::not_empty("flow", velocity);
    if (velocity.size() != plate.box.size()) throw BadInput("flow: a field that does not fit the layer's box");
    const cv::Size size(plate.source.width(), plate.source.height());
    if (plate.scale == 1) {
      scaled.push_back(velocity.clone());
      continue;
    }
    const SteadyFlow flow(velocity);
    Field& field = scaled.emplace_back(size);
    parallel_pixels(size, [&](int y, int x) {
      const double picture_x = (x + plate.origin.x + 0.5) / plate.scale, picture_y = (y + plate.origin.y + 0.5) / plate.scale;
      field(y, x) = plate.scale * flow.at(picture_x - plate.box.x - 0.5, picture_y - plate.box.y - 0.5);
    });
  }
  return scaled;
}

Plane scaled_plane(const Plane& plane, const Plate& plate) {
  if (plane.empty() || plate.scale == 1) return plane.clone();
  if (plane.size() != plate.box.size()) throw BadInput("freeze: does not fit the layer's box");
  Plane scaled(plate.source.height(), plate.source.width());
  const Point offset = offset_in_box(plate);
  const cv::Matx23d to_box(1 / plate.scale, 0, (offset.x + 0.5) / plate.scale - 0.5, 0, 1 / plate.scale,
                           (offset.y + 0.5) / plate.scale - 0.5);
  cv::warpAffine(plane, scaled, to_box, scaled.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return scaled;
}

Point offset_in_box(const Plate& plate) {
  return {plate.origin.x - plate.box.x * plate.scale, plate.origin.y - plate.box.y * plate.scale};
}

}  // namespace stillwater
