#pragma once

#include <opencv2/core.hpp>

/// Images, and the rules that hold for every function of the engine. Headers state only exceptions.
///
/// - Rows run top to bottom. An integer array index is a pixel's centre: index i is x = i + 0.5 in picture
///   coordinates, where (0, 0) is the top left corner of the top left pixel. All C++ functions take and give
///   *picture coordinates* (x right, y down) unless a name says `index`.
/// - Colour is display-referred (sRGB curve), float, 1 = white, not clamped above. Files are converted at the
///   border of picture/ only.
/// - `Rgba` is premultiplied everywhere inside the engine; the Python border is straight. Alpha is 0..1.
/// - A `Field` holds pixels: flow (where the point seen here is one frame later, minus here) or a displacement
///   map (where to sample, minus here).
/// - At output scale s, output pixel i looks at (i + 0.5) / s in picture coordinates.
/// - Functions never change their inputs; a cv::Mat_ argument may be a view of memory that somebody else owns.
namespace stillwater {

using Rgba = cv::Mat_<cv::Vec4f>;   ///< H x W, premultiplied red, green, blue, alpha
using Rgb = cv::Mat_<cv::Vec3f>;    ///< H x W, red, green, blue: opaque, or differences of colours
using Plane = cv::Mat_<float>;      ///< H x W, a matte or any single quantity
using Field = cv::Mat_<cv::Vec2f>;  ///< H x W, (x, y) in pixels
using Labels = cv::Mat_<int>;       ///< H x W, label map

struct Point {
  double x = 0, y = 0;
};

/// A straight piece from `from` to `to`: an armature (root, tip) or a horizon.
struct Segment {
  Point from, to;
};

/// The largest side that any picture may have, in pixels.
inline constexpr int largest_side = 16384;

}  // namespace stillwater
