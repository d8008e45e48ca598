#include "flow/stroke_points.h"

#include <algorithm>
#include <cmath>

namespace stillwater {
namespace {

constexpr double cancelled = 0.1;  // directions that add up to less say nothing
constexpr int none = -1;

/// The pixels so far, and which of them lies where.
class Canvas {
 public:
  explicit Canvas(cv::Size picture) : point_at_(picture, none) {}

  void paint(const PaintedTrack& painted) {
    paint_over(painted);
    const std::size_t before = pixels_.size();
    for (const Station& station : painted.track->stations) {
      const cv::Vec2d value = painted.directed ? station.tangent : cv::Vec2d(painted.speed, 0);
      lay(station.x, station.y, value, painted.strength, before);
      if (station.radius < 1) continue;
      // Just inside the brush's rim, across the way; a dot's rim is taken on its four sides.
      const double rim = station.radius - 0.5;
      const cv::Vec2d across = painted.directed ? cv::Vec2d(-station.tangent[1], station.tangent[0]) : cv::Vec2d(0, 1);
      for (const double side : {-rim, rim})
        lay(station.x + side * across[0], station.y + side * across[1], value, painted.strength, before);
      if (painted.directed) continue;
      for (const double side : {-rim, rim}) lay(station.x + side, station.y, value, painted.strength, before);
    }
  }

  std::vector<StrokePixel> said() const {
    std::vector<StrokePixel> said;
    for (const StrokePixel& pixel : pixels_)
      if (pixel.strength > 0) said.push_back(pixel);
    return said;
  }

 private:
  void paint_over(const PaintedTrack& painted) {
    for (StrokePixel& pixel : pixels_) {
      const cv::Point2d centre(pixel.index.x + 0.5, pixel.index.y + 0.5);
      if (!painted.track->box.contains(centre)) continue;
      const Nearest nearest = nearest_on(*painted.track, centre.x, centre.y);
      if (nearest.distance > std::max(0.5, nearest.radius)) continue;
      const cv::Vec2d value = painted.directed ? nearest.tangent : cv::Vec2d(painted.speed, 0);
      const double below = pixel.strength * (1 - painted.strength), strength = below + painted.strength;
      const cv::Vec2d mixed = (pixel.value * below + value * painted.strength) / strength;
      const double size = cv::norm(mixed);
      pixel.value = painted.directed && size >= cancelled ? mixed / size : mixed;
      pixel.strength = painted.directed && size < cancelled ? 0 : strength;
    }
  }

  /// A pixel of the stroke itself is laid anew where it comes back to it; one of an earlier stroke is painted over already.
  void lay(double x, double y, cv::Vec2d value, double strength, std::size_t own) {
    const cv::Point index(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
    if (!cv::Rect({0, 0}, point_at_.size()).contains(index)) return;
    int& point = point_at_(index);
    if (point == none) {
      point = static_cast<int>(pixels_.size());
      pixels_.push_back({index, value, strength});
    } else if (static_cast<std::size_t>(point) >= own) {
      pixels_[point].value = value;
    }
  }

  Labels point_at_;
  std::vector<StrokePixel> pixels_;
};

}  // namespace

std::vector<StrokePixel> stroke_pixels(const std::vector<PaintedTrack>& tracks, cv::Size picture) {
  Canvas canvas(picture);
  for (const PaintedTrack& painted : tracks) canvas.paint(painted);
  return canvas.said();
}

}  // namespace stillwater
