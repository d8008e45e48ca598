#include "appearance/match_texture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "appearance/texture_pyramid.h"
#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int channels = 3;
constexpr int smallest_cell = 8, usual_cell = 55;
constexpr int fewest_coefficients = 2, usual_coefficients = 4;  // a side of a cell, at the coarsest scale

std::string shape(cv::Size size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

/// The shorter side of a cell, px.
int cell_side(cv::Size picture, cv::Size grid) {
  return std::min(picture.width / grid.width, picture.height / grid.height);
}

void check_picture(std::string_view name, const Rgba& picture) {
  check::not_empty(name, picture);
  if (std::min(picture.cols, picture.rows) < smallest_matched_side)
    throw BadInput(std::string(name) + ": " + shape(picture.size()) + " is not at least " + std::to_string(smallest_matched_side) +
                   " pixels a side");
  check::finite_colours(name, picture);
}

void check_cells(cv::Size picture, cv::Size grid, int scales) {
  const int side = cell_side(picture, grid);
  if (side < smallest_cell)
    throw BadInput("grid: " + shape(grid) + " is not one whose cells have at least " + std::to_string(smallest_cell) +
                   " pixels a side in a picture of " + shape(picture));
  if (side >> (scales - 1) < fewest_coefficients)
    throw BadInput("scales: " + std::to_string(scales) + " is not a number that leaves " +
                   std::to_string(fewest_coefficients) + " coefficients a side of cells of " + std::to_string(side) +
                   " pixels");
}

int cells_along(int side) { return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) / usual_cell))); }

int usual_scales(int cell) {
  int scales = 1;
  while (scales < 4 && cell >> scales >= usual_coefficients) ++scales;
  return scales;
}

/// Less alpha than this is nothing that is seen.
constexpr float least_alpha = 1.0f / 512;

bool seen(const cv::Vec4f& p) { return p[3] > least_alpha; }

cv::Vec3f colour_of(const cv::Vec4f& p) { return cv::Vec3f(p[0], p[1], p[2]) * (1 / p[3]); }

/// Mean and principal axes of the picture's colours.
void find_axes(const Rgba& picture, TextureTarget& target) {
  cv::Vec3d sum(0, 0, 0);
  double all = 0;
  for (const cv::Vec4f& p : picture) {
    if (!seen(p)) continue;
    sum += cv::Vec3d(p[0], p[1], p[2]);
    all += p[3];
  }
  if (all <= 0) throw BadInput("picture: one of which nothing is seen, alpha 0 everywhere, is not a texture");
  const cv::Vec3d mean = sum / all;
  cv::Matx33d covariance = cv::Matx33d::zeros();
  for (const cv::Vec4f& p : picture) {
    if (!seen(p)) continue;
    const cv::Vec3d away = cv::Vec3d(colour_of(p)) - mean;
    covariance += p[3] * (away * away.t());
  }
  cv::Mat values, axes;
  cv::eigen(cv::Mat(covariance), values, axes);
  target.mean = mean;
  target.axes = cv::Matx33d(axes.ptr<double>());
}

Plane alpha_of(const Rgba& frame) {
  Plane alpha;
  cv::extractChannel(frame, alpha, 3);
  return alpha;
}

/// What is not seen has the mean colour.
std::unique_ptr<TexturePyramid> pyramid_of(const Rgba& frame, const TextureTarget& target) {
  auto pyramid = target.matching == TextureMatching::steerable
                     ? TexturePyramid::steerable(frame.size(), target.grid, target.scales, target.orientations)
                     : TexturePyramid::laplacian(frame.size(), target.grid, target.scales);
  parallel_rows(frame.rows, 32, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < frame.cols; ++x) {
        const cv::Vec4f& p = frame(y, x);
        const cv::Vec3f along = seen(p) ? target.axes * (colour_of(p) - target.mean) : cv::Vec3f();
        for (int channel = 0; channel < channels; ++channel) pyramid->planes[channel](y, x) = along[channel];
      }
  });
  const Plane alpha = alpha_of(frame);
  if (cv::countNonZero(alpha < 1) > 0) pyramid->weigh(alpha);
  return pyramid;
}

TextureTarget::PlaneStatistics statistics_of(const Samples& plane, const CellAxis& x, const CellAxis& y, bool even,
                                              const Plane& weight) {
  float largest = 0;
  for (int j = 0; j < y.inside; ++j)
    for (int i = 0; i < x.inside; ++i) largest = std::max(largest, std::abs(plane.data[j * plane.stride + i]));
  const Bins bins = Bins::of(0, largest, even);
  return {bins, cell_shares(plane, x, y, bins, weight)};
}

/// Walks the method's steps on a frame; `pixels` and `bands` change each plane, told the repetition.
void repeat(TexturePyramid& pyramid, int repetitions,
            const std::function<void(int step, int channel, const Samples&, const CellAxis&, const CellAxis&)>& pixels,
            const std::function<void(int step, int channel, int band, const Samples&, const CellAxis&, const CellAxis&)>& bands) {
  for (int step = 0; step <= repetitions; ++step) {
    if (step > 0)
      pyramid.change_bands([&](int channel, int band, const Samples& samples, const CellAxis& x, const CellAxis& y) {
        bands(step - 1, channel, band, samples, x, y);
      });
    pyramid.change_pixels([&](int channel, int, const Samples& samples, const CellAxis& x, const CellAxis& y) {
      pixels(step, channel, samples, x, y);
    });
  }
}

Rgba coloured(const TexturePyramid& pyramid, const TextureTarget& target, const Rgba& frame, double stylize) {
  Rgba matched(frame.size());
  const auto share = static_cast<float>(stylize);
  const cv::Matx33f back = target.axes.t();
  parallel_rows(frame.rows, 32, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < frame.cols; ++x) {
        const cv::Vec3f along(pyramid.planes[0](y, x), pyramid.planes[1](y, x), pyramid.planes[2](y, x));
        const cv::Vec3f colour = back * along + target.mean;
        const cv::Vec4f& old = frame(y, x);
        for (int c = 0; c < channels; ++c) matched(y, x)[c] = old[c] + share * (old[3] * std::max(0.0f, colour[c]) - old[c]);
        matched(y, x)[3] = old[3];
      }
  });
  return matched;
}

int bands_of(const TextureTarget& target) { return static_cast<int>(target.bands.size()) / channels; }

void check_frame(const Rgba& frame, const TextureTarget& target) {
  check_picture("frame", frame);
  check_cells(frame.size(), target.grid, target.scales);
}

/// The walk that makes curves of a frame and applies them; what is left in the pyramid is the matched frame.
TextureCurves match_by_own(TexturePyramid& pyramid, const TextureTarget& target, int repetitions) {
  TextureCurves curves;
  const int bands = bands_of(target);
  curves.pixels.resize(static_cast<size_t>(repetitions + 1) * channels);
  curves.bands.resize(static_cast<size_t>(repetitions) * channels * bands);
  const auto match = [](const TextureTarget::PlaneStatistics& wanted, const Samples& samples, const CellAxis& x,
                        const CellAxis& y, const Plane& weight) {
    CellCurves made = cell_curves(cell_shares(samples, x, y, wanted.bins, weight), wanted.shares, wanted.bins);
    apply(made, x, y, wanted.bins, samples);
    return made;
  };
  repeat(
      pyramid, repetitions,
      [&](int step, int channel, const Samples& samples, const CellAxis& x, const CellAxis& y) {
        curves.pixels[step * channels + channel] = match(target.pixels[channel], samples, x, y, pyramid.pixel_weight());
      },
      [&](int step, int channel, int band, const Samples& samples, const CellAxis& x, const CellAxis& y) {
        const int plane = channel * bands + band;
        curves.bands[step * channels * bands + plane] = match(target.bands[plane], samples, x, y, pyramid.band_weight(band));
      });
  return curves;
}

}  // namespace

TextureTarget describe(const Rgba& picture, const DescribeParameters& parameters) {
  check_picture("picture", picture);
  TextureTarget target;
  target.matching = parameters.matching;
  target.orientations = parameters.orientations;
  target.grid = parameters.grid;
  if (target.grid == cv::Size(0, 0)) target.grid = {cells_along(picture.cols), cells_along(picture.rows)};
  check::in_range("grid", std::min(target.grid.width, target.grid.height), 1, largest_side, "cells");
  check::in_range("scales", parameters.scales, 0, 12);
  check::in_range("orientations", parameters.orientations, 1, 16);
  const int side = cell_side(picture.size(), target.grid);
  target.scales = parameters.scales == 0 ? usual_scales(side) : parameters.scales;
  check_cells(picture.size(), target.grid, target.scales);
  find_axes(picture, target);

  const auto pyramid = pyramid_of(picture, target);
  const int bands = pyramid->bands();
  target.pixels.resize(channels);
  target.bands.resize(static_cast<size_t>(channels) * bands);
  pyramid->change_pixels([&](int channel, int, const Samples& samples, const CellAxis& x, const CellAxis& y) {
    target.pixels[channel] = statistics_of(samples, x, y, true, pyramid->pixel_weight());
  });
  pyramid->change_bands([&](int channel, int band, const Samples& samples, const CellAxis& x, const CellAxis& y) {
    target.bands[channel * bands + band] =
        statistics_of(samples, x, y, pyramid->is_picture(band), pyramid->band_weight(band));
  });
  return target;
}

TextureCurves texture_curves(const Rgba& frame, const TextureTarget& target, int repetitions) {
  check_frame(frame, target);
  check::in_range("repetitions", repetitions, 1, 50);
  const auto pyramid = pyramid_of(frame, target);
  return match_by_own(*pyramid, target, repetitions);
}

TextureCurves mix(const TextureCurves& a, const TextureCurves& b, double share) {
  check::in_range("share", share, 0, 1);
  const auto mixed = [&](const std::vector<CellCurves>& from, const std::vector<CellCurves>& to) {
    bool same = from.size() == to.size();
    for (size_t i = 0; same && i < from.size(); ++i) same = from[i].size() == to[i].size();
    if (!same) throw BadInput("curves: not both of the same target and number of repetitions");
    const auto part = static_cast<float>(share);
    std::vector<CellCurves> result = from;
    parallel_rows(static_cast<int>(from.size()), 4, [&](int first, int last) {
      for (int i = first; i < last; ++i)
        for (size_t k = 0; k < result[i].size(); ++k) result[i][k] += part * (to[i][k] - result[i][k]);
    });
    return result;
  };
  return {mixed(a.pixels, b.pixels), mixed(a.bands, b.bands)};
}

Rgba match_texture(const Rgba& frame, const TextureTarget& target, const TextureCurves& curves, double stylize) {
  check_frame(frame, target);
  check::in_range("stylize", stylize, 0, 1);
  const int bands = bands_of(target), repetitions = static_cast<int>(curves.pixels.size()) / channels - 1;
  if (repetitions < 1 || curves.bands.size() != static_cast<size_t>(repetitions) * channels * bands ||
      curves.pixels.front().size() != target.pixels.front().shares.below.size())
    throw BadInput("curves: not those of this target");
  const auto pyramid = pyramid_of(frame, target);
  repeat(
      *pyramid, repetitions,
      [&](int step, int channel, const Samples& samples, const CellAxis& x, const CellAxis& y) {
        apply(curves.pixels[step * channels + channel], x, y, target.pixels[channel].bins, samples);
      },
      [&](int step, int channel, int band, const Samples& samples, const CellAxis& x, const CellAxis& y) {
        const int plane = channel * bands + band;
        apply(curves.bands[step * channels * bands + plane], x, y, target.bands[plane].bins, samples);
      });
  return coloured(*pyramid, target, frame, stylize);
}

Rgba match_texture(const Rgba& frame, const TextureTarget& target, int repetitions, double stylize) {
  check_frame(frame, target);
  check::in_range("repetitions", repetitions, 1, 50);
  check::in_range("stylize", stylize, 0, 1);
  const auto pyramid = pyramid_of(frame, target);
  match_by_own(*pyramid, target, repetitions);
  return coloured(*pyramid, target, frame, stylize);
}

}  // namespace stillwater
