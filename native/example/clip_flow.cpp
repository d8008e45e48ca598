#include "example/clip_flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "flow/radial_fill.h"

namespace stillwater {
namespace {

constexpr int together = 8;  // pairs whose sum is taken in one go: not a matter of how many threads there are
constexpr double around = 3;  // px: sigma within which slopes say that something is seen
constexpr std::array<double, 3> spread{4, 16, 64};  // px: sigmas of the surroundings, nearer ones first
constexpr double doubtful = 0.02;  // of the mean weight: below it, the surroundings say more than the place

constexpr int corners = 100, window = 10, levels = 3;
constexpr double apart = 5;  // px between corners
constexpr double lost = 0.5;  // px: followed back, a corner is not further from where it was
constexpr int place_size = 8;  // px

Plane difference(const HalfFrames& frames, int i) { return luma(frames.read(i)); }

Plane mean_around(const Plane& plane) {
  Plane mean;
  cv::GaussianBlur(plane, mean, cv::Size(), around);
  return mean;
}

// |grad|^2 around each pixel.
Plane seen(const Plane& plane) {
  Plane x, y;
  cv::Sobel(plane, x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(plane, y, CV_32F, 0, 1, 3, 1.0 / 8);
  return mean_around(x.mul(x) + y.mul(y));
}

// How much of what is around each pixel is found again where the flow says, 0 .. 1.
Plane found_again(const Plane& here, const Plane& next, const Field& flow) {
  Field places(flow.size());
  for (int y = 0; y < flow.rows; ++y)
    for (int x = 0; x < flow.cols; ++x) places(y, x) = flow(y, x) + cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
  Plane there;
  cv::remap(next, there, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  const Plane off = here - there;
  const Plane missed = mean_around(off.mul(off)), both = mean_around(here.mul(here) + there.mul(there));
  Plane share(flow.size());
  std::transform(missed.begin(), missed.end(), both.begin(), share.begin(),
                 [](float left, float all) { return all > 0 ? std::max(0.0f, 1 - left / all) : 0.0f; });
  return share;
}

struct Sum {
  Field flow;    // weighted
  Plane weight;

  explicit Sum(cv::Size size) : flow(size, cv::Vec2f()), weight(size, 0.0f) {}

  void add(const Sum& other) {
    flow += other.flow;
    weight += other.weight;
  }
};

Sum sum_of_pairs(const HalfFrames& differences, int first, int last, FlowQuality quality) {
  Sum sum(differences.size());
  Plane here = difference(differences, first);
  for (int i = first; i < last; ++i) {
    const Plane next = difference(differences, i + 1);
    const Field flow = optical_flow(here, next, quality);
    const Plane weight = seen(here).mul(found_again(here, next, flow));
    for (int y = 0; y < flow.rows; ++y)
      for (int x = 0; x < flow.cols; ++x) {
        sum.flow(y, x) += weight(y, x) * flow(y, x);
        sum.weight(y, x) += weight(y, x);
      }
    here = next;
  }
  return sum;
}

// Where little was seen, what ever wider surroundings say.
Field filled(const Sum& sum) {
  Field flow = sum.flow.clone();
  Plane weight = sum.weight.clone();
  const double mean = cv::mean(sum.weight)[0];
  if (!(mean > 0)) return Field(flow.size(), cv::Vec2f());
  for (const double sigma : spread) {
    Field wide_flow;
    Plane wide_weight;
    cv::GaussianBlur(sum.flow, wide_flow, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
    cv::GaussianBlur(sum.weight, wide_weight, cv::Size(), sigma, sigma, cv::BORDER_REPLICATE);
    const auto share = static_cast<float>(doubtful);
    flow += share * wide_flow;
    weight += share * wide_weight;
  }
  const auto least = static_cast<float>(1e-6 * mean);
  for (int y = 0; y < flow.rows; ++y)
    for (int x = 0; x < flow.cols; ++x) flow(y, x) /= weight(y, x) + least;
  return flow;
}

Field dense_flow(const HalfFrames& differences, FlowQuality quality, Progress& progress) {
  const int pairs = differences.count() - 1, pieces = (pairs + together - 1) / together;
  std::vector<Sum> sums(pieces, Sum(cv::Size()));
  parallel_rows(
      pieces, 1,
      [&](int first, int last) {
        for (int piece = first; piece < last; ++piece)
          sums[piece] = sum_of_pairs(differences, piece * together, std::min(pairs, (piece + 1) * together), quality);
      },
      [&](double share) { progress.at(share); });
  Sum all(differences.size());
  for (const Sum& sum : sums) all.add(sum);
  return filled(all);
}

cv::Mat_<unsigned char> grey(const Plane& plane, double largest) {
  cv::Mat_<unsigned char> bytes;
  plane.convertTo(bytes, CV_8U, 127 / largest, 128);
  return bytes;
}

double largest_of(const HalfFrames& differences) {
  double largest = 1e-6;
  for (int i = 0; i < differences.count(); i += std::max(1, differences.count() / 8)) {
    const Plane plane = difference(differences, i);
    largest = std::max(largest, std::max(std::abs(*std::min_element(plane.begin(), plane.end())),
                                         std::abs(*std::max_element(plane.begin(), plane.end()))) * 1.0);
  }
  return largest;
}

Field feature_flow(const HalfFrames& differences, Progress& progress) {
  struct Mean {
    cv::Vec2d sum;
    int count = 0;
  };
  std::map<std::pair<int, int>, Mean> places;
  const double largest = largest_of(differences);
  cv::Mat_<unsigned char> here = grey(difference(differences, 0), largest);
  for (int i = 0; i + 1 < differences.count(); ++i) {
    progress.at(static_cast<double>(i) / differences.count());
    const cv::Mat_<unsigned char> next = grey(difference(differences, i + 1), largest);
    std::vector<cv::Point2f> from, to;
    cv::goodFeaturesToTrack(here, from, corners, 0.01, apart);
    if (!from.empty()) {
      std::vector<cv::Point2f> back;
      std::vector<unsigned char> found, found_back;
      cv::calcOpticalFlowPyrLK(here, next, from, to, found, cv::noArray(), cv::Size(window, window), levels);
      cv::calcOpticalFlowPyrLK(next, here, to, back, found_back, cv::noArray(), cv::Size(window, window), levels);
      for (size_t k = 0; k < from.size(); ++k) {
        if (!found[k] || !found_back[k] || cv::norm(back[k] - from[k]) > lost) continue;
        Mean& mean = places[{static_cast<int>(from[k].y) / place_size, static_cast<int>(from[k].x) / place_size}];
        mean.sum += cv::Vec2d(to[k].x - from[k].x, to[k].y - from[k].y);
        ++mean.count;
      }
    }
    here = next;
  }
  if (places.empty()) return Field(differences.size(), cv::Vec2f());
  std::vector<Point> centres;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(places.size()), 2);
  for (const auto& [place, mean] : places) {
    values.row(static_cast<Eigen::Index>(centres.size())) << mean.sum[0] / mean.count, mean.sum[1] / mean.count;
    centres.push_back({(place.second + 0.5) * place_size, (place.first + 0.5) * place_size});
  }
  return radial_fill<cv::Vec2f>(RadialInterpolation(centres, values, {.tolerance = 0.1}), differences.size());
}

}  // namespace

ClipFlow clip_flow_named(const std::string& name) {
  if (name == "dense") return ClipFlow::dense;
  if (name == "features") return ClipFlow::features;
  throw BadInput("flow: " + name + " is not dense or features");
}

Field mean_clip_flow(const HalfFrames& differences, ClipFlow method, FlowQuality quality, Progress& progress) {
  if (differences.count() < 2) throw BadInput("clip: one frame is not at least 2 (what moves is seen from frame to frame)");
  return method == ClipFlow::dense ? dense_flow(differences, quality, progress) : feature_flow(differences, progress);
}

}  // namespace stillwater
