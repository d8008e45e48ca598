#include "frame/example_plate.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "example/local_contrast.h"
#include "example/sample_differences.h"
#include "flow/optical_flow.h"
#include "frame/box_pixels.h"
#include "frame/example_layer.h"
#include "layers/extend_colours.h"

namespace stillwater {
namespace {

constexpr int moments_of_contrast = 6, moments_of_curves = 3;  // looked at, spread over the clip
constexpr double usual_cell = 55;       // px of the picture
constexpr double around_of_cell = 0.6;  // sigma over which contrast is taken, of a cell
constexpr int smallest_cell = 8;        // px of the plate

Field mean_of(const std::vector<Field>& fields) {
  Field mean(fields.front().size(), cv::Vec2f());
  for (const Field& field : fields) mean += field;
  return mean / static_cast<double>(fields.size());
}

Plane coverage_of(const Rgba& pixels) {
  Plane coverage;
  cv::extractChannel(pixels, coverage, 3);
  return coverage;
}

// Of a small plate, cells are not smaller than the pyramid allows.
cv::Size grid_of(const LookParameters& look, const Plate& plate) {
  const auto along = [&](int given, int box, int pixels) {
    const int cells = given > 0 ? given : std::max(1, cvRound(box / usual_cell));
    return std::clamp(cells, 1, std::max(1, plate.scale < 1 ? pixels / smallest_cell : cells));
  };
  return {along(look.grid.width, plate.box.width, plate.source.width()),
          along(look.grid.height, plate.box.height, plate.source.height())};
}

// How strong what of the detail does not stand is around each place, of all of it.
Plane left_of(const Rgb& detail, const Rgb& standing, double around) {
  const auto energy = [around](const Rgb& image) {
    Plane squares(image.size());
    parallel_pixels(image.size(), [&](int y, int x) { squares(y, x) = image(y, x).dot(image(y, x)); });
    cv::GaussianBlur(squares, squares, cv::Size(), around, around, cv::BORDER_REFLECT);
    return squares;
  };
  Plane all = energy(detail);
  const Plane stands = energy(standing);
  parallel_pixels(all.size(), [&](int y, int x) {
    all(y, x) = all(y, x) > 0 ? std::sqrt(std::max(0.0f, 1 - stands(y, x) / all(y, x))) : 1;
  });
  return all;
}

Rgb times(const Rgb& image, const Plane& factor) {
  Rgb product(image.size());
  parallel_pixels(image.size(), [&](int y, int x) { product(y, x) = factor(y, x) * image(y, x); });
  return product;
}

CarriedResiduals carried_over(const Plate& plate, const ExampleSetup& setup, const std::vector<Field>& velocities) {
  const MapPixels pixels{{plate.source.width(), plate.source.height()}, plate.scale, offset_in_box(plate)};
  return {setup.residuals, SourceMap(pixels, setup.patches, setup.strokes, setup.transfer, setup.reach), velocities,
          setup.carried};
}

}  // namespace

ExamplePlate::ExamplePlate(const Plate& plate, const ExampleSetup& setup, const ExampleLook* look)
    : plate_(plate),
      parameters_(setup.look),
      moving_(setup.moving),
      clip_pixel_(setup.transfer.clip_scale * plate.scale),
      texture_(extend_colours(plate.source.pixels())),
      velocities_(scaled_fields(setup.velocities, plate)),
      mean_velocity_(mean_of(velocities_)),
      freeze_(scaled_plane(setup.freeze, plate)),
      carried_(carried_over(plate, setup, velocities_)),
      memory_(setup.memory),
      still_(std::all_of(velocities_.begin(), velocities_.end(), [](const Field& field) { return cv::countNonZero(field.reshape(1)) == 0; })) {
  parameters_.average.average_blur *= plate.scale;
  parameters_.grid = grid_of(setup.look, plate);
  const bool large = std::min(texture_.cols, texture_.rows) >= smallest_matched_side;
  parameters_.matched = large && parameters_.matched && parameters_.repetitions > 0 && parameters_.stylize > 0;
  if (parameters_.matched) target_ = describe(texture_, {.grid = parameters_.grid, .matching = parameters_.matching});
  if (!look) return;
  check::same_size("look.base", look->base, "the layer", texture_);
  check::same_size("look.slope", look->slope, "the layer", texture_);
  check::same_size("look.hold", look->hold, "the layer", texture_);
  look_ = *look;
}

double ExamplePlate::cell() const {
  return std::max(1.0, std::min(static_cast<double>(texture_.cols) / parameters_.grid.width,
                                static_cast<double>(texture_.rows) / parameters_.grid.height));
}

Rgb ExamplePlate::moving_here() const {
  return moving_.empty() ? Rgb(texture_.size(), cv::Vec3f(1, 1, 1)) : carried_.map().mean(moving_);
}

ExampleLook ExamplePlate::make_look(Progress progress) const {
  progress.phase("averaging the picture", 0.1);
  const Rgb average = without_coverage(motion_blur(texture_, mean_velocity_, parameters_.average));
  progress.phase("finding its contrast", 0.5);
  const int steps = carried_.residuals() - 1;
  const auto moment = [&](int i, int of) {
    return ExampleNow{.moment = carried_.parameters().life + static_cast<double>(steps) * i / of};
  };
  std::vector<Rgb> moments;
  for (int i = 0; i < moments_of_contrast; ++i) {
    progress.at(static_cast<double>(i) / moments_of_contrast);
    moments.push_back(carried_.at(moment(i, moments_of_contrast)));
  }
  const Rgb difference = without_coverage(texture_) - average;
  const LocalContrast contrast = local_contrast(difference, moments, coverage_of(plate_.source.pixels()), around_of_cell * cell());
  const Rgb detail = difference - contrast.mean, standing = standing_part(detail, moving_here(), clip_pixel_);
  const Rgb slope = times(contrast.slope, left_of(detail, standing, around_of_cell * cell()));
  ExampleLook look{average + contrast.mean + standing, slope, contrast.hold, {}};
  if (!parameters_.matched) return look;
  progress.phase("finding its texture", 0.4);
  for (int i = 0; i < moments_of_curves; ++i) {
    progress.at(static_cast<double>(i) / moments_of_curves);
    const Rgba film = unmatched(moments[i * moments_of_contrast / moments_of_curves], look);
    TextureCurves curves = texture_curves(film, target_, parameters_.repetitions);
    look.curves = i == 0 ? std::move(curves) : mix(look.curves, curves, 1.0 / (i + 1));
  }
  return look;
}

Rgba ExamplePlate::unmatched(const Rgb& differences, const ExampleLook& look) const {
  Rgba film(differences.size());
  const Plane grey = luma(differences);
  parallel_pixels(film.size(), [&](int y, int x) {
    const cv::Vec3f colour = with_contrast(look.base(y, x), look.slope(y, x), look.hold(y, x), grey(y, x));
    film(y, x) = {std::max(0.0f, colour[0]), std::max(0.0f, colour[1]), std::max(0.0f, colour[2]), 1};
  });
  return film;
}

Rgba ExamplePlate::film(const ExampleNow& now) const {
  Rgba film = unmatched(carried_.at(now), look_);
  if (parameters_.matched) film = match_texture(film, target_, look_.curves, parameters_.stylize);
  if (freeze_.empty()) return film;
  parallel_pixels(film.size(), [&](int y, int x) { film(y, x) += freeze_(y, x) * (texture_(y, x) - film(y, x)); });
  return film;
}

std::unique_ptr<LayerMotion> ExamplePlate::at(const ExampleNow& now) const {
  check_example(now, fields());
  if (still_) return displaced_layer(plate_, {}, {});
  return std::make_unique<ExampleLayer>(*this, plate_, now);
}

}  // namespace stillwater
