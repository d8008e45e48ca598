#include "appearance/steerable_pyramid.h"

#include <algorithm>
#include <string>

#include "appearance/steerable_filters.h"
#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

/// Planes of these sizes in one piece of memory: it goes back in one piece too, and comes again without fresh pages.
std::vector<Plane> planes_of(const SteerableFilters& filters) {
  int numbers = 0;
  for (int band = 0; band < filters.bands(); ++band) numbers += filters.size_of(band).area();
  Plane all(1, numbers);
  std::vector<Plane> planes;
  for (int band = 0, first = 0; band < filters.bands(); ++band) {
    const cv::Size size = filters.size_of(band);
    planes.push_back(all.colRange(first, first + size.area()).reshape(1, size.height));
    first += size.area();
  }
  return planes;
}

/// The pyramid's planes in the filters' order.
template <class Pyramid>
auto in_a_row(Pyramid& pyramid) {
  std::vector<decltype(&pyramid.highpass)> planes{&pyramid.highpass};
  for (auto& scale : pyramid.bands)
    for (auto& band : scale) planes.push_back(&band);
  planes.push_back(&pyramid.lowpass);
  return planes;
}

}  // namespace

SteerablePyramid steerable_pyramid(const Plane& image, const SteerableParameters& parameters) {
  check::not_empty("image", image);
  if (parameters.complex && parameters.orientations < 2)
    throw BadInput("orientations: 1 is not at least 2, which a complex pyramid needs");
  const auto filters = SteerableFilters::of(image.size(), parameters.scales, parameters.orientations);
  const FftSpectrum picture = filters->spectrum_of(image[0], image.step1());

  SteerablePyramid pyramid;
  pyramid.bands.assign(parameters.scales, std::vector<Plane>(parameters.orientations));
  const std::vector<Plane> coefficients = planes_of(*filters);
  const auto planes = in_a_row(pyramid);
  for (int band = 0; band < filters->bands(); ++band) *planes[band] = coefficients[band];
  if (parameters.complex) pyramid.quadrature = pyramid.bands;
  parallel_rows(filters->bands(), 1, [&](int band, int) {
    filters->analyse(band, picture, (*planes[band])[0]);
    if (!parameters.complex || band == 0 || band + 1 == filters->bands()) return;
    Plane& partner = pyramid.quadrature[(band - 1) / parameters.orientations][(band - 1) % parameters.orientations];
    partner = Plane(filters->size_of(band));
    filters->analyse_quadrature(band, picture, partner[0]);
  });
  return pyramid;
}

Plane collapse(const SteerablePyramid& pyramid) {
  check::not_empty("highpass", pyramid.highpass);
  const int scales = static_cast<int>(pyramid.bands.size());
  const int orientations = scales ? static_cast<int>(pyramid.bands.front().size()) : 0;
  const auto filters = SteerableFilters::of(pyramid.highpass.size(), scales, orientations);
  const auto planes = in_a_row(pyramid);
  if (static_cast<int>(planes.size()) != filters->bands())
    throw BadInput("bands: not the same number of orientations at every scale");
  for (int band = 0; band < filters->bands(); ++band)
    if (planes[band]->size() != filters->size_of(band))
      throw BadInput("bands: " + std::to_string(planes[band]->cols) + " x " + std::to_string(planes[band]->rows) +
                     " is not this band's size, " + std::to_string(filters->size_of(band).width) + " x " +
                     std::to_string(filters->size_of(band).height));

  std::vector<FftRows> rows(filters->bands());
  parallel_rows(filters->bands(), 1, [&](int band, int) {
    rows[band] = filters->transform_of(band).along((*planes[band])[0], planes[band]->step1());
  });
  std::vector<const FftRows*> bands;
  for (const FftRows& band : rows) bands.push_back(&band);
  Plane picture(filters->transform().size());
  filters->synthesise(bands, picture[0], picture.cols);
  return picture;
}

}  // namespace stillwater
