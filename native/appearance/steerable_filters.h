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

  /// The picture's spectrum -> the band's, scaled so that transform_of(band).inverse() gives the coefficients.
  void analyse(int band, const std::complex<float>* picture, std::complex<float>* spectrum) const;

  /// The same times -i sgn(cos(theta - pi b / o)): the band's quadrature partner, the imaginary part of a complex pyramid.
  void analyse_quadrature(int band, const std::complex<float>* picture, std::complex<float>* spectrum) const;

  /// Adds what all bands' spectra (unnormalised) give to rows [first, last) of the picture's spectrum, which begins as
  /// anything; scaled so that transform().inverse() gives the picture.
  void synthesise(const std::vector<const std::complex<float>*>& bands, int first, int last,
                  std::complex<float>* picture) const;

 private:
  SteerableFilters(cv::Size size, int scales, int orientations);
  void sample(int band);

  int scales_, orientations_;
  std::vector<RealFft2> levels_;             // one a scale, and the lowpass's
  std::vector<std::vector<float>> filters_;  // one a band, over its level's half spectrum; bands without (-i)^(o-1)
};

}  // namespace stillwater
