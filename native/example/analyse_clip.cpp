#include "example/analyse_clip.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "example/sample_differences.h"
#include "flow/flow_map.h"

namespace stillwater {
namespace {

constexpr double around = 4;  // px: sigma over which the residuals' energy is taken
constexpr double shortest_reach = 0.5;
constexpr int looked_at = 8;  // frames, for what moves

Rgb mean_frame(const HalfFrames& frames, Progress& progress) {
  cv::Mat_<cv::Vec3d> sum(frames.size(), cv::Vec3d());
  for (int i = 0; i < frames.count(); ++i) {
    progress.at(static_cast<double>(i) / frames.count());
    const Rgb frame = frames.read(i);
    if (!cv::checkRange(frame)) throw BadInput("clip: frame " + std::to_string(i + 1) + " is not finite everywhere");
    cv::add(sum, frame, sum, cv::noArray(), CV_64F);
  }
  Rgb mean;
  sum.convertTo(mean, CV_32F, 1.0 / frames.count());
  return mean;
}

void take_off(HalfFrames& frames, const Rgb& average) {
  parallel_rows(frames.count(), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) frames.write(i, frames.read(i) - average);
  });
}

/// Sums over all pixels of all residuals.
struct Energies {
  double difference = 0, residual = 0;  ///< squares of D_i and of r_i, i > 0
  double slope = 0;                     ///< squares of the residuals' gradient

  void add(const Energies& other) {
    difference += other.difference;
    residual += other.residual;
    slope += other.slope;
  }
};

double square_of(const Plane& plane) { return cv::norm(plane, cv::NORM_L2SQR); }

Energies energies_of(const Plane& difference, const Plane& residual) {
  const cv::Rect left(0, 0, residual.cols - 1, residual.rows), upper(0, 0, residual.cols, residual.rows - 1);
  const double across = square_of(residual(left + cv::Point(1, 0)) - residual(left));
  const double down = square_of(residual(upper + cv::Point(0, 1)) - residual(upper));
  return {square_of(difference), square_of(residual), across + down};
}

/// Differences become residuals, the last ones first, as each needs the difference before it. A block of frames is worked on
/// at once; `before` is kept from being written over.
class Residuals {
 public:
  Residuals(HalfFrames& frames, const Field& velocity)
      : frames_(frames), back_(flow_map(velocity, -1)), square_(frames.size(), 0.0f) {}

  void make(Progress& progress) {
    constexpr int block = 16;
    for (int end = frames_.count(); end > 1; end -= block) {
      progress.at(1 - static_cast<double>(end) / frames_.count());
      make_block(std::max(1, end - block), end);
    }
  }

  ClipAnalysis summed() const {
    ClipAnalysis found;
    const double many = std::max(1, frames_.count() - 1);
    Plane square = square_ / many;
    cv::GaussianBlur(square, found.energy, cv::Size(), around, around, cv::BORDER_REPLICATE);
    if (energies_.slope > 0) found.reach = std::sqrt(2 * energies_.residual / energies_.slope);
    found.reach = std::max(found.reach, shortest_reach);
    if (energies_.difference > 0) found.explained = 1 - energies_.residual / energies_.difference;
    return found;
  }

 private:
  void make_block(int start, int end) {
    const int count = end - start;
    std::vector<Rgb> made(count);
    std::vector<Plane> greys(count);
    std::vector<Energies> energies(count);
    parallel_rows(count, 1, [&](int first, int last) {
      for (int k = first; k < last; ++k) {
        const Rgb here = frames_.read(start + k);
        made[k] = here - sample_differences(frames_.read(start + k - 1), back_, repeated);
        greys[k] = luma(made[k]);
        energies[k] = energies_of(luma(here), greys[k]);
      }
    });
    for (int k = 0; k < count; ++k) {
      energies_.add(energies[k]);
      square_ += greys[k].mul(greys[k]);
    }
    parallel_rows(count, 1, [&](int first, int last) {
      for (int k = first; k < last; ++k) frames_.write(start + k, made[k]);
    });
  }

  HalfFrames& frames_;
  Field back_;
  Plane square_;
  Energies energies_;
};

}  // namespace

ClipAnalysis analyse_clip(HalfFrames& frames, const AnalyseParameters& parameters, Progress progress) {
  progress.phase("averaging the clip", 0.1);
  const Rgb average = mean_frame(frames, progress);
  take_off(frames, average);
  progress.phase("finding the clip's flow", 0.7);
  const Field velocity = mean_clip_flow(frames, parameters.flow, parameters.quality, progress);
  std::vector<Plane> spread_out;
  const int apart = std::max(1, frames.count() / looked_at);
  for (int i = 0; i < frames.count(); i += apart) spread_out.push_back(luma(frames.read(i)));
  progress.phase("finding the clip's residuals", 0.2);
  Residuals residuals(frames, velocity);
  residuals.make(progress);
  ClipAnalysis found = residuals.summed();
  found.average = average;
  found.velocity = velocity;
  found.moving = moving_shares(spread_out, luma(average), found.energy);
  return found;
}

}  // namespace stillwater
