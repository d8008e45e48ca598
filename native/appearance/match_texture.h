#pragma once

#include <opencv2/core/matx.hpp>
#include <vector>

#include "appearance/cell_curves.h"
#include "core/image.h"

/// A frame gets the texture of a picture: the histograms of its pyramid's bands, place by place.
/// Source: Heeger and Bergen 1995, "Pyramid-based texture analysis/synthesis"; Okabe et al. 2009, 4 (per cell of a grid).
///
///     frame -> three planes (principal axes of the picture's colours) -> pixels matched
///           -> [ pyramid -> each band matched -> collapsed -> pixels matched ] x repetitions -> colours
///
/// The whole frame has one pyramid, and the cells differ in their histograms (cell_curves.h): so cells have no borders, where
/// pyramids of parts would ring, and neighbours' statistics run into each other.
///
/// Pixels count as much as they are seen: alpha weighs the histograms, and bands' coefficients count by alpha around them. What
/// is not seen has the mean colour, so that its own changes nothing. A frame without alpha goes the fast way.
namespace stillwater {

/// A picture with a shorter side has too few details of any size to be matched, px.
inline constexpr int smallest_matched_side = 16;

enum class TextureMatching {
  steerable,  ///< for the final picture
  laplacian,  ///< for a quick look: no orientations
};

struct DescribeParameters {
  cv::Size grid = {0, 0};  ///< cells across and down, each at least 8 px a side; 0 x 0: cells of about 55 px
  int scales = 0;          ///< of the pyramid; 0: 4, or as many as leave a cell 4 coefficients a side
  int orientations = 4;    ///< 1 .. 16, of the steerable pyramid
  TextureMatching matching = TextureMatching::steerable;
};

/// What is kept of the picture. Its size is not kept: a frame of another size has the same grid.
struct TextureTarget {
  struct PlaneStatistics {
    Bins bins;
    CellShares shares;
  };

  cv::Size grid;
  int scales, orientations;
  TextureMatching matching;
  cv::Vec3f mean;
  cv::Matx33f axes;  ///< rows: the principal axes of the colours, the strongest first
  std::vector<PlaneStatistics> pixels;  ///< one a channel
  std::vector<PlaneStatistics> bands;   ///< channel by channel, finest first
};

/// Throws BadInput where the picture is less than 16 px a side, not finite or not seen at all, cells are smaller than 8 px, or
/// `scales` leaves a cell less than 2 coefficients a side.
TextureTarget describe(const Rgba& picture, const DescribeParameters& parameters = {});

/// The curves that one frame was matched by, in the order of their use. They can serve other frames: a film that takes its
/// curves from a few frames, and between those a mixture, doesn't flicker, and each of its frames still stands alone.
struct TextureCurves {
  std::vector<CellCurves> pixels;  ///< repetition by repetition (and once before), channel by channel
  std::vector<CellCurves> bands;   ///< repetition by repetition, channel by channel, finest first
};

/// `repetitions` 1 .. 50. Throws BadInput where the frame is too small for the target's grid and scales, or not finite.
TextureCurves texture_curves(const Rgba& frame, const TextureTarget& target, int repetitions = 3);

/// (1 - share) a + share b. `share` 0 .. 1. Throws BadInput where they are not of the same target and repetitions.
TextureCurves mix(const TextureCurves& a, const TextureCurves& b, double share);

/// The frame by these curves; `stylize` 0 (the frame) .. 1 (matched). Alpha stays. Throws BadInput as texture_curves().
Rgba match_texture(const Rgba& frame, const TextureTarget& target, const TextureCurves& curves, double stylize = 1);

/// The frame by its own curves.
Rgba match_texture(const Rgba& frame, const TextureTarget& target, int repetitions = 3, double stylize = 1);

}  // namespace stillwater
