#include "layers/colour_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parallel.h"
#include "core/random.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
constexpr float levels = 255;

struct Sample {
  float red, green, blue, x, y;
};

float brightness(const Sample& sample) { return sample.red + sample.green + sample.blue; }

// The known pixels of one kind that touch what is unknown; where none does, all that touch the other kind.
std::vector<Sample> border_samples(const Rgba& picture, const Trimap& trimap, unsigned char kind) {
  cv::Mat_<unsigned char> other(trimap != kind);
  cv::dilate(other, other, cv::Mat::ones(3, 3, CV_8U));
  std::vector<Sample> samples;
  for (int y = 0; y < trimap.rows; ++y)
    for (int x = 0; x < trimap.cols; ++x)
      if (trimap(y, x) == kind && other(y, x)) {
        const cv::Vec4f& c = picture(y, x);
        samples.push_back({c[0], c[1], c[2], static_cast<float>(x), static_cast<float>(y)});
      }
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return brightness(a) < brightness(b); });
  return samples;
}

// The distance of each pixel from the nearest known one of a kind.
Plane distance_from(const Trimap& trimap, unsigned char kind) {
  Plane distance;
  cv::distanceTransform(trimap != kind, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

struct Pair {
  int front = 0, back = 0;
};

class Search {
 public:
  Search(const Rgba& picture, const Trimap& trimap, const ColourSampleOptions& options)
      : picture_(picture), trimap_(trimap), options_(options), fronts_(border_samples(picture, trimap, known::foreground)),
        backs_(border_samples(picture, trimap, known::background)), far_from_front_(distance_from(trimap, known::foreground)),
        far_from_back_(distance_from(trimap, known::background)), pairs_(picture.size()),
        costs_(picture.size(), std::numeric_limits<float>::infinity()) {}

  ColourSamples best() {
    const auto looked_for = [this](int y, int x) {
      return trimap_(y, x) == known::unknown && far_from_both(y, x) <= options_.reach;
    };
    if (!fronts_.empty() && !backs_.empty())
      for (int round = 0; round < options_.iterations; ++round)
        for (const int colour : {0, 1})
          parallel_rows(picture_.rows, grain, [&](int first, int last) {
            for (int y = first; y < last; ++y)
              for (int x = (y + colour) % 2; x < picture_.cols; x += 2)
                if (looked_for(y, x)) improve(y, x, round);
          });
    return found();
  }

 private:
  float far_from_both(int y, int x) const { return std::max(far_from_front_(y, x), far_from_back_(y, x)); }

  void improve(int y, int x, int round) {
    Pair best{pairs_(y, x)[0], pairs_(y, x)[1]};
    float least = costs_(y, x);
    const auto consider = [&](const Pair& pair) {
      const float cost = cost_of(y, x, pair);
      if (cost < least) least = cost, best = pair;
    };
    for (const auto& [dy, dx] : {std::pair{-1, 0}, {0, -1}, {0, 1}, {1, 0}})
      if (const int ny = y + dy, nx = x + dx; ny >= 0 && nx >= 0 && ny < picture_.rows && nx < picture_.cols)
        if (costs_(ny, nx) < std::numeric_limits<float>::infinity()) consider({pairs_(ny, nx)[0], pairs_(ny, nx)[1]});
    float reach = 1;
    for (int step = 0; reach * static_cast<float>(std::max(fronts_.size(), backs_.size())) > 1; ++step, reach /= 2) {
      const std::uint64_t bits = random_bits(options_.seed, {static_cast<std::int64_t>(y) * picture_.cols + x, round, step});
      consider({near(best.front, reach, fronts_.size(), bits & 0xffffffff), near(best.back, reach, backs_.size(), bits >> 32)});
    }
    pairs_(y, x) = {best.front, best.back};
    costs_(y, x) = least;
  }

  // A sample's number within `reach` times all of them.
  static int near(int centre, float reach, size_t count, std::uint64_t random) {
    const double share = static_cast<double>(random) / 4294967296.0 * 2 - 1;
    const int at = centre + static_cast<int>(std::lround(share * reach * static_cast<double>(count)));
    return std::clamp(at, 0, static_cast<int>(count) - 1);
  }

  float cost_of(int y, int x, const Pair& pair) const {
    const Sample &front = fronts_[pair.front], &back = backs_[pair.back];
    const float far_front = std::hypot(front.x - static_cast<float>(x), front.y - static_cast<float>(y));
    const float far_back = std::hypot(back.x - static_cast<float>(x), back.y - static_cast<float>(y));
    const auto nearness = static_cast<float>(options_.nearness);
    return levels * misfit(picture_(y, x), front, back) +
           nearness * (far_front / far_from_front_(y, x) + far_back / far_from_back_(y, x));
  }

  static float misfit(const cv::Vec4f& colour, const Sample& front, const Sample& back) {
    const float red = front.red - back.red, green = front.green - back.green, blue = front.blue - back.blue;
    const float r = colour[0] - back.red, g = colour[1] - back.green, b = colour[2] - back.blue;
    const float square = red * red + green * green + blue * blue;
    const float alpha = square > 0 ? std::clamp((r * red + g * green + b * blue) / square, 0.0f, 1.0f) : 1;
    const float r1 = r - alpha * red, g1 = g - alpha * green, b1 = b - alpha * blue;
    return std::sqrt(r1 * r1 + g1 * g1 + b1 * b1);
  }

  ColourSamples found() const {
    ColourSamples result{Rgba::zeros(picture_.size()), Rgba::zeros(picture_.size()), Plane::zeros(picture_.size()),
                         Plane(picture_.size(), 1.0f)};
    for (int y = 0; y < picture_.rows; ++y)
      for (int x = 0; x < picture_.cols; ++x) {
        if (!(costs_(y, x) < std::numeric_limits<float>::infinity())) continue;
        const Sample &front = fronts_[pairs_(y, x)[0]], &back = backs_[pairs_(y, x)[1]];
        result.foreground(y, x) = {front.red, front.green, front.blue, 1};
        result.background(y, x) = {back.red, back.green, back.blue, 1};
        result.distance(y, x) = far_from_both(y, x);
        result.misfit(y, x) = misfit(picture_(y, x), front, back);
      }
    return result;
  }

  const Rgba& picture_;
  const Trimap& trimap_;
  ColourSampleOptions options_;
  std::vector<Sample> fronts_, backs_;
  Plane far_from_front_, far_from_back_;
  cv::Mat_<cv::Vec2i> pairs_;
  Plane costs_;
};

}  // namespace

float best_mix(const cv::Vec4f& colour, const cv::Vec4f& foreground, const cv::Vec4f& background) {
  float along = 0, square = 0;
  for (int c = 0; c < 3; ++c) {
    const float difference = foreground[c] - background[c];
    along += (colour[c] - background[c]) * difference;
    square += difference * difference;
  }
  return square > 0 ? std::clamp(along / square, 0.0f, 1.0f) : 1.0f;
}

ColourSamples sample_colours(const Rgba& picture, const Trimap& trimap, const ColourSampleOptions& options) {
  return Search(picture, trimap, options).best();
}

}  // namespace stillwater
