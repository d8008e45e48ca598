#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "appearance/cell_curves.h"
#include "core/image.h"

namespace stillwater {

/// Three planes and the bands of their pyramids, for match_texture.
class TexturePyramid {
 public:
  /// `change(channel, band, samples, x, y)`: may change the samples; called by several threads, each with its own band.
  using Change = std::function<void(int channel, int band, const Samples& samples, const CellAxis& x, const CellAxis& y)>;

  /// Steerable. The frame goes on mirrored for `margin` pixels and more, which blend into the opposite side's mirror image,
  /// so that it begins anew without a step.
  static std::unique_ptr<TexturePyramid> steerable(cv::Size frame, cv::Size grid, int scales, int orientations);
  static std::unique_ptr<TexturePyramid> laplacian(cv::Size frame, cv::Size grid, int scales);
  static constexpr int margin = 24;

  virtual ~TexturePyramid() = default;
  virtual int bands() const = 0;

  /// The last band is a small picture: values, not differences.
  bool is_picture(int band) const { return band + 1 == bands(); }

  void change_pixels(const Change& change);

  /// Takes the planes apart, changes all bands, and puts them together again.
  virtual void change_bands(const Change& change) = 0;

  /// How much the pixels and a band's samples are seen, of the frame's alpha; empty where it is 1 everywhere.
  void weigh(const Plane& alpha);
  Plane pixel_weight() const { return weights_.empty() ? Plane() : weights_.front(); }
  Plane band_weight(int band) const { return weights_.empty() ? Plane() : weights_[level_of(band)]; }

  std::array<Plane, 3> planes;  ///< of the frame's size, to be filled by the caller

 protected:
  TexturePyramid(cv::Size frame, cv::Size grid);
  virtual int level_of(int band) const = 0;  ///< halvings
  cv::Size frame_, grid_;

 private:
  std::vector<Plane> weights_;  // one a level
};

}  // namespace stillwater
