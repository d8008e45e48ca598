#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "core/fft.h"
#include "core/image.h"

namespace stillwater {

/// The steerable pyramid's filters for one size, sampled over the half spectrum, and the way of one band through them.
/// Source: Simoncelli and Freeman 1995, "The steerable pyramid"; Karasaridis and Simoncelli 1996.
///
///     r = 1 at the sides' Nyquist frequency, theta the frequency's direction, o orientations, s = 0 .. scales - 1:
///     highpass   H(r)                            H rises from 0 at r = 1/2 to 1 at r = 1, a cosine in log2 r
///     band s, b  L(r) L(2r) .. L(2^s r) H(2^(s+1) r) c cos^(o-1)(theta - pi b / o) (-i)^(o-1),       L^2 + H^2 = 1
///     lowpass    L(r) .. L(2^scales r)
///
/// Level s has ceil(side / 2^s) pixels a side and holds all frequencies of its bands, so that nothing is lost for any
/// size, odd ones too. Squares of all filters add up to 1: a tight frame, and the same filters lead back.
class SteerableFilters {
 public:
  /// Kept for the sizes asked for last. Throws BadInput where sides are not 1 .. largest_side, `scales` is not
  /// 1 .. 12 or leaves a lowpass of less than 2 pixels a side, or `orientations` is not 1 .. 16.
  static std::shared_ptr<const SteerableFilters> of(cv::Size size, int scales, int orientations);

  int scales() const { return scales_; }
  int orientations() const { return orientations_; }

  /// Bands in one row: highpass, scale 0's orientations, scale 1's, ..., lowpass.
  int bands() const { return scales_ * orientations_ + 2; }
  int level_of(int band) const;
  cv::Size size_of(int band) const { return levels_[level_of(band)].size(); }
  const RealFft2& transform() const { return levels_.front(); }
  const RealFft2& transform_of(int band) const { return levels_[level_of(band)]; }

  /// Numbers of the picture's spectrum that lie near each other, for analyse(): the columns one after the other.
  FftSpectrum spectrum_of(const float* picture, size_t stride) const;

  /// The picture's spectrum -> the band's coefficients, in size_of(band).width numbers a row. For one thread.
  void analyse(int band, const FftSpectrum& picture, float* coefficients) const;

  /// The same times -i sgn(cos(theta - pi b / o)): the band's quadrature partner, the imaginary part of a complex pyramid.
  void analyse_quadrature(int band, const FftSpectrum& picture, float* coefficients) const;

  /// All bands, each by transform_of(band).along() -> the picture.
  void synthesise(const std::vector<const FftRows*>& bands, float* picture, size_t stride) const;

 private:
  SteerableFilters(cv::Size size, int scales, int orientations);
  void sample(int band);
  const float* filter(int band, int kx) const { return &filters_[band][static_cast<size_t>(kx) * size_of(band).height]; }
  void weigh(int band, const FftSpectrum& picture, const FftColumns& columns) const;
  void add(int band, const FftRows& rows, const FftColumns& picture) const;
  void synthesise(const std::vector<const FftRows*>& bands, const FftColumns& picture) const;

  int scales_, orientations_;
  std::vector<RealFft2> levels_;             // one a scale, and the lowpass's
  std::vector<std::vector<float>> filters_;  // one a band, column by column as its spectrum; bands without (-i)^(o-1)
};

}  // namespace stillwater
