#include "example/source_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "example/rigid_deformation.h"

namespace stillwater {
namespace {

constexpr float same_place = 0.02f;  // px: what is taken from so near together is taken once
constexpr float least_weight = 0.02f;

// Patches are twice as wide as they are apart; their inner part covers wholly.
constexpr double covering = 0.35, ending = 0.75;  // of the patch's side, from its middle

float feathered(double away, double inner, double outer) {
  const double share = std::clamp((outer - away) / (outer - inner), 0.0, 1.0);
  return static_cast<float>(share * share * (3 - 2 * share));
}

float mirrored(float at, int size) {
  const float period = 2 * static_cast<float>(size);
  float inside = at + 0.5f - period * std::floor((at + 0.5f) / period);
  if (inside > static_cast<float>(size)) inside = period - inside;
  return std::clamp(inside - 0.5f, 0.0f, static_cast<float>(size - 1));
}

cv::Vec3f bilinear(const Rgb& image, float x, float y) {
  x = mirrored(x, image.cols);
  y = mirrored(y, image.rows);
  const int left = std::min(static_cast<int>(x), std::max(0, image.cols - 2)), right = std::min(left + 1, image.cols - 1);
  const int top = std::min(static_cast<int>(y), std::max(0, image.rows - 2)), bottom = std::min(top + 1, image.rows - 1);
  const float across = x - static_cast<float>(left), down = y - static_cast<float>(top);
  const cv::Vec3f *upper = image[top], *lower = image[bottom];
  const cv::Vec3f above = upper[left] + across * (upper[right] - upper[left]);
  const cv::Vec3f below = lower[left] + across * (lower[right] - lower[left]);
  return above + down * (below - above);
}

}  // namespace

/// The map while things are laid onto it.
struct SourceMap::Laying {
  SourceMap& map;
  MapPixels pixels;

  // Lays one place over what a pixel has.
  static void over(Pixel& pixel, float x, float y, float alpha) {
    if (alpha <= 0) return;
    for (Taken& taken : pixel) taken.weight *= 1 - alpha;
    Taken* least = &pixel[0];
    for (Taken& taken : pixel) {
      if (taken.weight > 0 && std::abs(taken.x - x) < same_place && std::abs(taken.y - y) < same_place) {
        taken.weight += alpha;
        return;
      }
      if (taken.weight < least->weight) least = &taken;
    }
    *least = {x, y, alpha};
  }

  // Calls work(pixel, place in the picture) for the pixels of a square around a place of the picture.
  template <class Work>
  void around(double x, double y, double half, const Work& work) {
    const auto pixel_at = [&](double at, double offset) { return (at + 0.5) * pixels.scale - 0.5 - offset; };
    const auto place_of = [&](int pixel, double offset) { return (pixel + offset + 0.5) / pixels.scale - 0.5; };
    const auto low = [&](double at, double offset) {
      return std::max(0, static_cast<int>(std::floor(pixel_at(at - half, offset))));
    };
    const auto high = [&](double at, double offset, int size) {
      return std::min(size - 1, static_cast<int>(std::ceil(pixel_at(at + half, offset))));
    };
    const Point offset = pixels.offset;
    for (int row = low(y, offset.y); row <= high(y, offset.y, pixels.size.height); ++row)
      for (int column = low(x, offset.x); column <= high(x, offset.x, pixels.size.width); ++column)
        work(map.pixels_[static_cast<size_t>(row) * pixels.size.width + column],
             cv::Vec2d(place_of(column, offset.x), place_of(row, offset.y)));
  }

  void lay(const PlacedPatch& patch, const TransferParameters& parameters) {
    const double inner = covering * parameters.patch, outer = ending * parameters.patch;
    const double cosine = std::cos(patch.turn) / parameters.clip_scale, sine = std::sin(patch.turn) / parameters.clip_scale;
    around(patch.target[0], patch.target[1], outer, [&](Pixel& pixel, const cv::Vec2d& place) {
      const double x = place[0] - patch.target[0], y = place[1] - patch.target[1];
      const float alpha = feathered(std::abs(x), inner, outer) * feathered(std::abs(y), inner, outer);
      over(pixel, static_cast<float>(patch.source[0] + cosine * x + sine * y),
           static_cast<float>(patch.source[1] - sine * x + cosine * y), alpha);
    });
  }

  void lay(const CloneStroke& stroke, double clip_scale) {
    const RigidDeformation to_clip(stroke.target, stroke.source, 1 / clip_scale);
    const double half = stroke.width / 2;
    const std::vector<Point>& line = to_clip.from();
    cv::Vec2d low(line[0].x, line[0].y), high = low;
    for (const Point& p : line) {
      low = {std::min(low[0], p.x), std::min(low[1], p.y)};
      high = {std::max(high[0], p.x), std::max(high[1], p.y)};
    }
    const cv::Vec2d middle = (low + high) / 2;
    const double reach = std::max(high[0] - low[0], high[1] - low[1]) / 2 + half;
    around(middle[0] - 0.5, middle[1] - 0.5, reach, [&](Pixel& pixel, const cv::Vec2d& place) {
      const Point here{place[0] + 0.5, place[1] + 0.5};
      double away = std::hypot(here.x - line[0].x, here.y - line[0].y);
      for (size_t i = 1; i < line.size(); ++i) {
        const cv::Vec2d a(line[i - 1].x, line[i - 1].y), b(line[i].x, line[i].y), p(here.x, here.y);
        const double length = (b - a).dot(b - a);
        const double share = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0;
        away = std::min(away, cv::norm(p - a - share * (b - a)));
      }
      if (away >= half) return;
      const Point source = to_clip.at(here);
      over(pixel, static_cast<float>(source.x - 0.5), static_cast<float>(source.y - 0.5),
           static_cast<float>(stroke.alpha) * feathered(away, half / 2, half));
    });
  }
};

SourceMap::SourceMap(const MapPixels& pixels, const std::vector<PlacedPatch>& patches,
                     const std::vector<CloneStroke>& strokes, const TransferParameters& parameters, double reach)
    : size_(pixels.size) {
  check::size("pixels", size_.width, size_.height);
  check::in_range("patch", parameters.patch, 4, 128, "px");
  check::positive("clip_scale", parameters.clip_scale);
  check::positive("scale", pixels.scale);
  check::positive("reach", reach, "px");
  pixels_.resize(static_cast<size_t>(size_.area()));
  Laying laying{*this, pixels};
  for (const PlacedPatch& patch : patches) laying.lay(patch, parameters);
  for (size_t i = 0; i < strokes.size(); ++i) {
    check::positive("strokes[" + std::to_string(i) + "].width", strokes[i].width, "px");
    check::in_range("strokes[" + std::to_string(i) + "].alpha", strokes[i].alpha, 0, 1);
    laying.lay(strokes[i], parameters.clip_scale);
  }
  keep_variance(reach);
}

void SourceMap::keep_variance(double reach) {
  const auto alike = [reach](const Taken& a, const Taken& b) {
    const double x = a.x - b.x, y = a.y - b.y;
    return std::exp(-(x * x + y * y) / (2 * reach * reach));
  };
  parallel_rows(size_.height, 16, [&](int first, int last) {
    for (size_t i = static_cast<size_t>(first) * size_.width; i < static_cast<size_t>(last) * size_.width; ++i) {
      Pixel& pixel = pixels_[i];
      std::sort(pixel.begin(), pixel.end(), [](const Taken& a, const Taken& b) { return a.weight > b.weight; });
      double all = 0;
      for (Taken& taken : pixel) {
        if (taken.weight < least_weight) taken.weight = 0;
        all += taken.weight;
      }
      if (all <= 0) continue;
      double variance = 0;
      for (const Taken& a : pixel)
        for (const Taken& b : pixel)
          if (a.weight > 0 && b.weight > 0) variance += a.weight / all * b.weight / all * alike(a, b);
      for (Taken& taken : pixel) taken.weight = static_cast<float>(taken.weight / all / std::sqrt(variance));
    }
  });
}

Rgba SourceMap::gather(const Rgb& residual) const {
  Rgba gathered(size_);
  parallel_rows(size_.height, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < size_.width; ++x) {
        cv::Vec3f sum;
        for (const Taken& taken : at(y, x)) {
          if (taken.weight == 0) break;
          sum += taken.weight * bilinear(residual, taken.x, taken.y);
        }
        gathered(y, x) = {sum[0], sum[1], sum[2], 1};
      }
  });
  return gathered;
}

Rgb SourceMap::mean(const Rgb& known) const {
  Rgb mean(size_);
  parallel_pixels(size_, [&](int y, int x) {
    cv::Vec3f sum;
    float all = 0;
    for (const Taken& taken : at(y, x)) {
      if (taken.weight == 0) break;
      sum += taken.weight * bilinear(known, taken.x, taken.y);
      all += taken.weight;
    }
    mean(y, x) = all > 0 ? sum / all : cv::Vec3f();
  });
  return mean;
}

SourceMap identical_map(cv::Size clip) {
  constexpr int side = 64;
  std::vector<PlacedPatch> patches;
  for (int top = 0; top < clip.height + side; top += side / 2)
    for (int left = 0; left < clip.width + side; left += side / 2) {
      const cv::Vec2f place(static_cast<float>(left), static_cast<float>(top));
      patches.push_back({place, place, 0});
    }
  return {{clip}, patches, {}, {.patch = side}, 1};
}

}  // namespace stillwater
