#include "layers/matting/drawn_trimap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "layers/matting/live_wire.h"
#include "layers/matting/segment_distance.h"

namespace stillwater {
namespace {

// Which stroke draws on a pixel, counted from 1; the first one counts.
Labels drawn(const cv::Size& picture, const std::vector<Stroke>& strokes, const std::string& kind) {
  if (strokes.empty()) throw BadInput("scribbles." + kind + ": no stroke is not one stroke or more");
  Labels owner = Labels::zeros(picture);
  Mask mask = Mask::zeros(picture);
  bool any = false;
  for (size_t i = 0; i < strokes.size(); ++i) {
    const cv::Rect box = draw(strokes[i], "scribbles." + kind + "[" + std::to_string(i) + "]", mask);
    for (int y = box.y; y < box.br().y; ++y)
      for (int x = box.x; x < box.br().x; ++x) {
        if (mask(y, x) && !owner(y, x)) owner(y, x) = static_cast<int>(i) + 1, any = true;
        mask(y, x) = 0;
      }
  }
  if (!any) throw BadInput("scribbles." + kind + ": no stroke touches the picture");
  return owner;
}

void refuse_contradictions(const Labels& foreground, const Labels& background) {
  for (int y = 0; y < foreground.rows; ++y)
    for (int x = 0; x < foreground.cols; ++x)
      if (foreground(y, x) && background(y, x))
        throw BadInput("scribbles: foreground[" + std::to_string(foreground(y, x) - 1) + "] and background[" +
                       std::to_string(background(y, x) - 1) + "] contradict each other at [" + std::to_string(x) +
                       ", " + std::to_string(y) + "] (a pixel is one or the other)");
}

// The distance of each pixel's centre from the outline, as far as `reach`; further away infinite.
Plane distance_to(const std::vector<Point>& outline, const cv::Size& picture, double reach) {
  Plane distance(picture, std::numeric_limits<float>::infinity());
  parallel_rows(picture.height, 16, [&](int top, int bottom) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
      const auto range = [reach](double from, double to, int first, int last) {
        const double low = std::floor(std::min(from, to) - reach), high = std::ceil(std::max(from, to) + reach);
        return cv::Range(static_cast<int>(std::clamp<double>(low, first, last)),
                         static_cast<int>(std::clamp<double>(high, first, last)));
      };
      const cv::Range rows = range(a.y, b.y, top, bottom), columns = range(a.x, b.x, 0, picture.width);
      for (int y = rows.start; y < rows.end; ++y)
        for (int x = columns.start; x < columns.end; ++x) {
          const auto far = static_cast<float>(distance_to_segment(x + 0.5, y + 0.5, a.x, a.y, b.x, b.y).distance);
          distance(y, x) = std::min(distance(y, x), far);
        }
    }
  });
  return distance;
}

// 255 where the outline goes round the pixel's centre (its winding number is not 0).
Mask inside_of(const std::vector<Point>& outline, const cv::Size& picture) {
  Mask inside = Mask::zeros(picture);
  for (int y = 0; y < picture.height; ++y) {
    const double level = y + 0.5;
    std::vector<std::pair<double, int>> crossings;  // x, and which way
    for (size_t i = 0; i < outline.size(); ++i) {
      const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
      if ((a.y <= level) == (b.y <= level)) continue;
      crossings.emplace_back(a.x + (level - a.y) / (b.y - a.y) * (b.x - a.x), a.y <= level ? 1 : -1);
    }
    std::sort(crossings.begin(), crossings.end());
    int winding = 0;
    for (size_t i = 0; i + 1 < crossings.size(); ++i) {
      winding += crossings[i].second;
      if (winding == 0) continue;
      const auto first = std::clamp(std::ceil(crossings[i].first - 0.5), 0.0, double(picture.width));
      const auto last = std::clamp(std::ceil(crossings[i + 1].first - 0.5), 0.0, double(picture.width));
      for (int x = static_cast<int>(first); x < static_cast<int>(last); ++x) inside(y, x) = 255;
    }
  }
  return inside;
}

void check_lasso(const Rgba& picture, const Lasso& lasso) {
  check::not_empty("picture", picture);
  if (lasso.outline.size() < 3)
    throw BadInput("lasso: " + std::to_string(lasso.outline.size()) + " points are not three or more");
  for (size_t i = 0; i < lasso.outline.size(); ++i)
    for (const double v : {lasso.outline[i].x, lasso.outline[i].y})
      check::finite("lasso[" + std::to_string(i) + "]", v);
  check::in_range("feather", lasso.feather, 0, 1000, "px");
  check::in_range("snap", lasso.snap, 0, 1000, "px");
}

}  // namespace

Trimap trimap_from_scribbles(const cv::Size& picture, const Scribbles& scribbles) {
  check::size("picture", picture.width, picture.height);
  const Labels foreground = drawn(picture, scribbles.foreground, "foreground");
  const Labels background = drawn(picture, scribbles.background, "background");
  refuse_contradictions(foreground, background);
  Trimap trimap(picture, known::unknown);
  trimap.setTo(known::foreground, foreground > 0);
  trimap.setTo(known::background, background > 0);
  return trimap;
}

Trimap trimap_from_lasso(const Rgba& picture, const Lasso& lasso) {
  check_lasso(picture, lasso);
  std::vector<Point> outline = lasso.outline;
  if (lasso.snap > 0) outline = snap_outline(picture, outline, lasso.snap);
  const Mask inside = inside_of(outline, picture.size());
  const Plane distance = distance_to(outline, picture.size(), lasso.feather);
  Trimap trimap(picture.size(), known::background);
  trimap.setTo(known::foreground, inside);
  if (lasso.feather > 0) trimap.setTo(known::unknown, distance <= lasso.feather);
  const TrimapCount total = count(trimap);
  const std::string rest = lasso.feather > 0 ? " further than the feather from the outline" : "";
  if (total.foreground == 0) throw BadInput("lasso: no pixel of the picture is inside" + rest);
  if (total.background == 0) throw BadInput("lasso: no pixel of the picture is outside" + rest);
  return trimap;
}

}  // namespace stillwater
