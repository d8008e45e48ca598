#include "layers/matting/live_wire.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <utility>

#include "layers/matting/stroke.h"

namespace stillwater {
namespace {

// What a pixel's way costs beside what its edge lacks: so that a straight way is better than a long one.
constexpr double fare = 0.03;
// Anchors are so many times the reach apart, and no less than so many pixels.
constexpr double anchor_spacing = 4, least_spacing = 24;
// So far a point of the outline may be from where it was found, px.
constexpr double slack = 0.2;

Point between(const Point& a, const Point& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

// The closed outline, a point about each pixel of its length.
std::vector<Point> resampled(const std::vector<Point>& outline) {
  std::vector<Point> samples;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y))));
    for (int k = 0; k < steps; ++k) samples.push_back(between(a, b, static_cast<double>(k) / steps));
  }
  return samples;
}

// How strong the edge is at each pixel.
Plane edges_of(const Rgba& picture) {
  cv::Mat smooth, across, down;
  cv::GaussianBlur(picture, smooth, cv::Size(3, 3), 0, 0, cv::BORDER_REPLICATE);
  cv::Scharr(smooth, across, CV_32F, 1, 0, 1, 0, cv::BORDER_REPLICATE);
  cv::Scharr(smooth, down, CV_32F, 0, 1, 1, 0, cv::BORDER_REPLICATE);
  Plane strength(picture.size());
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const auto &gx = across.at<cv::Vec4f>(y, x), &gy = down.at<cv::Vec4f>(y, x);
      float most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::hypot(gx[c], gy[c]));
      strength(y, x) = most;
    }
  return strength;
}

class LiveWire {
 public:
  LiveWire(const Rgba& picture, const std::vector<Point>& outline, double reach)
      : edges_(edges_of(picture)), samples_(resampled(outline)), reach_(reach) {}

  std::vector<Point> outline() {
    const double apart = std::max(least_spacing, anchor_spacing * reach_);
    const size_t anchors = std::max<size_t>(3, static_cast<size_t>(static_cast<double>(samples_.size()) / apart));
    std::vector<size_t> at(anchors);
    std::vector<cv::Point> pixels(anchors);
    for (size_t i = 0; i < anchors; ++i) {
      at[i] = i * samples_.size() / anchors;
      pixels[i] = strongest_near(samples_[at[i]]);
    }
    std::vector<std::vector<cv::Point>> ways = ways_between(at, pixels, 0);
    for (size_t i = 0; i < anchors; ++i) {
      if (!ways[i].empty()) pixels[i] = ways[i][ways[i].size() / 2];
      else pixels[i] = pixel_of(samples_[middle(at, i)]);
    }
    ways = ways_between(at, pixels, 1);
    return joined(at, ways);
  }

 private:
  bool in_picture(const cv::Point& pixel) const { return cv::Rect(cv::Point(), edges_.size()).contains(pixel); }

  static cv::Point pixel_of(const Point& place) {
    return {static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y))};
  }

  // The sample in the middle between two anchors.
  size_t middle(const std::vector<size_t>& at, size_t i) const {
    const size_t next = i + 1 < at.size() ? at[i + 1] : at[0] + samples_.size();
    return (at[i] + next) / 2 % samples_.size();
  }

  cv::Point strongest_near(const Point& place) const {
    const cv::Point centre = pixel_of(place);
    const int reach = static_cast<int>(reach_);
    cv::Point best = centre;
    float strength = -1;
    for (int y = std::max(0, centre.y - reach); y <= std::min(edges_.rows - 1, centre.y + reach); ++y)
      for (int x = std::max(0, centre.x - reach); x <= std::min(edges_.cols - 1, centre.x + reach); ++x)
        if (std::hypot(x + 0.5 - place.x, y + 0.5 - place.y) <= reach_ && edges_(y, x) > strength)
          strength = edges_(y, x), best = {x, y};
    return best;
  }

  // The way from each anchor to the next one; empty where it leaves the picture. Later the anchors are in the middle
  // between where they were, and a way may stay near the samples of both halves.
  std::vector<std::vector<cv::Point>> ways_between(const std::vector<size_t>& at, const std::vector<cv::Point>& pixels,
                                                   size_t shift) const {
    std::vector<std::vector<cv::Point>> ways(at.size());
    for (size_t i = 0; i < at.size(); ++i) {
      const size_t last = i + 1 + shift, end = at[last % at.size()] + (last >= at.size() ? samples_.size() : 0);
      ways[i] = cheapest_way(pixels[i], pixels[(i + 1) % at.size()], at[i], end);
    }
    return ways;
  }

  std::vector<cv::Point> cheapest_way(const cv::Point& from, const cv::Point& to, size_t first, size_t last) const {
    if (!in_picture(from) || !in_picture(to)) return {};
    const auto near = near_samples(first, last);
    const Mask& corridor = near.first;
    const cv::Rect& box = near.second;
    if (!box.contains(from) || !box.contains(to) || !corridor(from - box.tl()) || !corridor(to - box.tl())) return {};
    double strongest;
    cv::minMaxLoc(edges_(box), nullptr, &strongest, nullptr, nullptr, corridor);
    const double scale = strongest > 0 ? 1 / strongest : 0;
    Labels came_from(box.size(), -1);
    cv::Mat_<double> cost(box.size(), std::numeric_limits<double>::infinity());
    using Open = std::pair<double, int>;  // cost, and the pixel's number, which decides between equals
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    const auto number = [&](const cv::Point& p) { return p.y * box.width + p.x; };
    const cv::Point start = from - box.tl(), goal = to - box.tl();
    cost(start) = 0;
    open.emplace(0, number(start));
    while (!open.empty()) {
      const auto [paid, index] = open.top();
      open.pop();
      const cv::Point here(index % box.width, index / box.width);
      if (here == goal) break;
      if (paid > cost(here)) continue;
      for (int k = 0; k < 9; ++k) {
        const cv::Point there = here + cv::Point(k % 3 - 1, k / 3 - 1);
        if (there == here || !cv::Rect(cv::Point(), box.size()).contains(there) || !corridor(there)) continue;
        const double length = there.x != here.x && there.y != here.y ? std::sqrt(2.0) : 1;
        const double price = paid + length * (fare + 1 - scale * edges_(there + box.tl()));
        if (price >= cost(there)) continue;
        cost(there) = price;
        came_from(there) = index;
        open.emplace(price, number(there));
      }
    }
    std::vector<cv::Point> way;
    if (start != goal && came_from(goal) < 0) return way;
    for (cv::Point p = goal; p != start; p = {came_from(p) % box.width, came_from(p) / box.width})
      way.push_back(p + box.tl());
    way.push_back(from);
    std::reverse(way.begin(), way.end());
    return way;
  }

  // The pixels within reach of samples first .. last, and the box that they are given in.
  std::pair<Mask, cv::Rect> near_samples(size_t first, size_t last) const {
    Stroke band{{}, 2 * reach_ + 1};
    const size_t step = std::max<size_t>(1, static_cast<size_t>(reach_ / 4));
    cv::Rect2d bounds;
    for (size_t i = first; i <= last + step - 1; i += step) {
      const Point& sample = samples_[std::min(i, last) % samples_.size()];
      band.points.push_back({sample.x, sample.y});
      const cv::Rect2d around(sample.x - reach_ - 1, sample.y - reach_ - 1, 2 * reach_ + 2, 2 * reach_ + 2);
      bounds = i == first ? around : bounds | around;
    }
    bounds &= cv::Rect2d(0, 0, edges_.cols, edges_.rows);
    if (bounds.empty()) return {};
    const cv::Rect box =
        cv::Rect(cv::Point(static_cast<int>(bounds.x), static_cast<int>(bounds.y)),
                 cv::Point(static_cast<int>(std::ceil(bounds.br().x)), static_cast<int>(std::ceil(bounds.br().y)))) &
        cv::Rect(cv::Point(), edges_.size());
    for (StrokePoint& point : band.points) point.x -= box.x, point.y -= box.y;
    Mask mask = Mask::zeros(box.size());
    draw(band, "lasso", mask);
    return {mask, box};
  }

  // The ways' pixels one after the other, evened out; the drawn samples where there is no way.
  std::vector<Point> joined(const std::vector<size_t>& at, const std::vector<std::vector<cv::Point>>& ways) const {
    std::vector<Point> outline;
    for (size_t i = 0; i < ways.size(); ++i) {
      if (ways[i].empty()) {
        const size_t first = middle(at, i), last = middle(at, (i + 1) % at.size());
        for (size_t k = first; k != last; k = (k + 1) % samples_.size()) outline.push_back(samples_[k]);
      } else {
        for (size_t k = 0; k + 1 < ways[i].size(); ++k) outline.push_back({ways[i][k].x + 0.5, ways[i][k].y + 0.5});
      }
    }
    return outline.size() < 3 ? samples_ : simplified(evened(evened(outline)));
  }

  static std::vector<Point> evened(const std::vector<Point>& outline) {
    std::vector<Point> even(outline.size());
    for (size_t i = 0; i < outline.size(); ++i) {
      const Point &a = outline[(i + outline.size() - 1) % outline.size()], &b = outline[(i + 1) % outline.size()];
      even[i] = between(outline[i], between(a, b, 0.5), 0.5);
    }
    return even;
  }

  // The same within `slack`, with fewer points.
  static std::vector<Point> simplified(const std::vector<Point>& outline) {
    std::vector<cv::Point2f> all, few;
    for (const Point& point : outline) all.emplace_back(static_cast<float>(point.x), static_cast<float>(point.y));
    cv::approxPolyDP(all, few, slack, true);
    std::vector<Point> result;
    for (const cv::Point2f& point : few) result.push_back({point.x, point.y});
    return result.size() < 3 ? outline : result;
  }

  Plane edges_;
  std::vector<Point> samples_;
  double reach_;
};

}  // namespace

std::vector<Point> snap_outline(const Rgba& picture, const std::vector<Point>& outline, double reach) {
  return LiveWire(picture, outline, reach).outline();
}

}  // namespace stillwater
