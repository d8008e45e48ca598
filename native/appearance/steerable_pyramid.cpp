#include "appearance/steerable_pyramid.h"

#include <algorithm>
#include <string>

#include "appearance/steerable_filters.h"
#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

/// OpenCV's own memory is aligned; memory of others may not be.
bool usable(const Plane& plane) { return plane.isContinuous() && fft_aligned(plane[0]); }

/// `spectrum` is lost.
Plane plane_of(const RealFft2& transform, std::complex<float>* spectrum) {
  Plane plane(transform.size());
  if (usable(plane)) {
    transform.inverse(spectrum, plane[0]);
  } else {
    const FftFloats values = fft_floats(transform.pixels());
    transform.inverse(spectrum, values.get());
    std::copy_n(values.get(), transform.pixels(), plane[0]);
  }
  return plane;
}

FftSpectrum spectrum_of(const RealFft2& transform, const Plane& plane) {
  FftSpectrum spectrum = fft_spectrum(transform.numbers());
  if (usable(plane)) {
    transform.forward(const_cast<float*>(plane[0]), spectrum.get());
    return spectrum;
  }
  const FftFloats values = fft_floats(transform.pixels());
  for (int y = 0; y < plane.rows; ++y) std::copy_n(plane[y], plane.cols, values.get() + static_cast<size_t>(y) * plane.cols);
  transform.forward(values.get(), spectrum.get());
  return spectrum;
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
  const FftSpectrum picture = spectrum_of(filters->transform(), image);

  SteerablePyramid pyramid;
  pyramid.bands.assign(parameters.scales, std::vector<Plane>(parameters.orientations));
  if (parameters.complex) pyramid.quadrature = pyramid.bands;
  const auto planes = in_a_row(pyramid);
  parallel_rows(filters->bands(), 1, [&](int band, int) {
    const RealFft2& transform = filters->transform_of(band);
    const FftSpectrum spectrum = fft_spectrum(transform.numbers());
    filters->analyse(band, picture.get(), spectrum.get());
    *planes[band] = plane_of(transform, spectrum.get());
    if (!parameters.complex || band == 0 || band + 1 == filters->bands()) return;
    filters->analyse_quadrature(band, picture.get(), spectrum.get());
    pyramid.quadrature[(band - 1) / parameters.orientations][(band - 1) % parameters.orientations] =
        plane_of(transform, spectrum.get());
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

  std::vector<FftSpectrum> spectra(filters->bands());
  parallel_rows(filters->bands(), 1,
                [&](int band, int) { spectra[band] = spectrum_of(filters->transform_of(band), *planes[band]); });
  std::vector<const std::complex<float>*> bands;
  for (const FftSpectrum& spectrum : spectra) bands.push_back(spectrum.get());

  const RealFft2& transform = filters->transform();
  const FftSpectrum picture = fft_spectrum(transform.numbers());
  parallel_rows(transform.size().height, 32,
                [&](int first, int last) { filters->synthesise(bands, first, last, picture.get()); });
  return plane_of(transform, picture.get());
}

}  // namespace stillwater
