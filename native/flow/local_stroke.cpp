#include "flow/local_stroke.h"

#include <algorithm>
#include <cmath>

namespace stillwater {
namespace {

constexpr double reach = 2;  // of the half width: where the matte ends

struct Box {
  int left, top, right, bottom;
};

Box pixels_between(double left, double top, double right, double bottom, cv::Size size) {
  const auto cut = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most))); };
  return {cut(std::floor(left), size.width), cut(std::floor(top), size.height), cut(std::ceil(right), size.width),
          cut(std::ceil(bottom), size.height)};
}

float falling(double distance, double radius) {
  const double t = std::clamp((reach - distance / radius) / (reach - 1), 0.0, 1.0);
  return static_cast<float>(t * t * (3 - 2 * t));
}

}  // namespace

LocalLayer local_layer(const StrokeTrack& track, double alpha, cv::Size picture) {
  double widest = 1;
  for (const Station& station : track.stations) widest = std::max(widest, station.radius);
  const double grown = (reach - 1) * widest + 1;
  const Box all = pixels_between(track.box.x - grown, track.box.y - grown, track.box.x + track.box.width + grown,
                                 track.box.y + track.box.height + grown, picture);
  LocalLayer layer;
  layer.box = {all.left, all.top, all.right - all.left, all.bottom - all.top};
  if (layer.box.empty()) return layer;
  layer.matte = Plane::zeros(layer.box.size());
  layer.tangent = Field::zeros(layer.box.size());
  Plane nearest_yet(layer.box.size(), std::numeric_limits<float>::infinity());
  for (std::size_t piece = 0; piece < pieces(track); ++piece) {
    const Station& from = track.stations[piece];
    const Station& to = track.stations[std::min(piece + 1, track.stations.size() - 1)];
    const double far = reach * std::max({from.radius, to.radius, 1.0});
    const Box part = pixels_between(std::min(from.x, to.x) - far, std::min(from.y, to.y) - far, std::max(from.x, to.x) + far,
                                    std::max(from.y, to.y) + far, picture);
    for (int y = std::max(part.top, all.top); y < std::min(part.bottom, all.bottom); ++y)
      for (int x = std::max(part.left, all.left); x < std::min(part.right, all.right); ++x) {
        const Nearest nearest = nearest_on_piece(track, piece, x + 0.5, y + 0.5);
        const int v = y - all.top, u = x - all.left;
        if (nearest.distance > nearest_yet(v, u)) continue;
        nearest_yet(v, u) = static_cast<float>(nearest.distance);
        layer.matte(v, u) = static_cast<float>(alpha) * falling(nearest.distance, std::max(1.0, nearest.radius));
        layer.tangent(v, u) = nearest.tangent;
      }
  }
  return layer;
}

}  // namespace stillwater
