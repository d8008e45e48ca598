#pragma once

#include <array>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// A piece of the clip's residuals on the picture: a square, turned and moved. Places are index coordinates.
struct PlacedPatch {
  cv::Vec2f target;  ///< its middle, picture
  cv::Vec2f source;  ///< the same place in the clip
  float turn = 0;    ///< radians by which the clip's content is turned on the picture, from x to y
};

/// A clone stroke: what lies along `source` in the clip comes along `target` in the picture (RECIPE.md, `transfer`).
struct CloneStroke {
  std::vector<Point> source, target;  ///< clip and picture coordinates; at least one point each
  double width = 20;                  ///< px of the picture, above 0
  double alpha = 1;                   ///< 0..1
};

struct TransferParameters {
  int patch = 16;            ///< px of the picture, 4..128
  double clip_scale = 1;     ///< picture px for a px of the clip
  bool best_last = true;     ///< which patches lie on top: the best matches, or the worst
};

/// The pixels of a map: pixel i looks at the picture's place (i + offset + 0.5) / scale.
struct MapPixels {
  cv::Size size;
  double scale = 1;  ///< above 0
  Point offset = {};
};

/// Where each pixel of a picture takes the clip's residuals from: up to four places, each with its weight. Patches lie over
/// one another in the order given, feathered towards their sides; clone strokes lie over them.
///
/// What two places that have nothing to do with each other are mixed of varies less than they do: weights are raised so
/// that the mix has the variance of one of them, where residuals are alike by exp(-d^2 / 2 reach^2) at the distance d.
class SourceMap {
 public:
  static constexpr int most = 4;
  struct Taken {
    float x = 0, y = 0, weight = 0;  ///< index coordinates of the clip
  };
  using Pixel = std::array<Taken, most>;

  /// `reach`: px of the clip. Throws BadInput where parameters are out of range, or a stroke has no points.
  SourceMap(const MapPixels& pixels, const std::vector<PlacedPatch>& patches, const std::vector<CloneStroke>& strokes,
            const TransferParameters& parameters, double reach);

  cv::Size size() const { return size_; }
  const Pixel& at(int y, int x) const { return pixels_[static_cast<size_t>(y) * size_.width + x]; }

  /// What is known of each place of the clip as it lies on the picture: the mean of what a pixel takes; 0 where it takes
  /// nothing. Bilinear; beyond the clip's sides mirrored.
  Rgb mean(const Rgb& known) const;

  /// A frame of residuals as it lies on the picture, bilinear; beyond the clip's sides mirrored.
  Rgba gather(const Rgb& residual) const;

 private:
  struct Laying;

  void keep_variance(double reach);

  cv::Size size_;
  std::vector<Pixel> pixels_;
};

/// A clip that lies on its own frames.
SourceMap identical_map(cv::Size clip);

}  // namespace stillwater
