#include "layers/matting/colour_samples.h"

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
// Each pair that is tried at random is this much nearer to the best one than the one before.
constexpr double narrowing = 0.4;

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
  Search(const Rgba& picture, const Trimap& trimap, const cv::Mat_<unsigned char>& wanted,
         const ColourSampleOptions& options)
      : picture_(picture),
        trimap_(trimap),
        wanted_(wanted),
        options_(options),
        fronts_(border_samples(picture, trimap, known::foreground)),
        backs_(border_samples(picture, trimap, known::background)),
        far_from_front_(distance_from(trimap, known::foreground)),
        far_from_back_(distance_from(trimap, known::background)),
        weight_(static_cast<float>(options.nearness)),
        pairs_(picture.size(), cv::Vec2i(static_cast<int>(fronts_.size()) / 2, static_cast<int>(backs_.size()) / 2)),
        costs_(picture.size(), std::numeric_limits<float>::infinity()) {}

  ColourSamples best(const std::function<void(double)>& done) {
    const auto looked_for = [this](int y, int x) {
      return wanted_(y, x) && trimap_(y, x) == known::unknown;
    };
    if (!fronts_.empty() && !backs_.empty())
      for (int round = 0; round < options_.iterations; ++round)
        for (const int colour : {0, 1}) {
          done((round + 0.5 * colour) / options_.iterations);
          parallel_rows(picture_.rows, grain, [&](int first, int last) {
            for (int y = first; y < last; ++y)
              for (int x = (y + colour) % 2; x < picture_.cols; x += 2)
                if (looked_for(y, x)) improve(y, x, round);
          });
        }
    return found();
  }

 private:
  void improve(int y, int x, int round) {
    const Place here{static_cast<float>(x), static_cast<float>(y), weight_ / far_from_front_(y, x),
                     weight_ / far_from_back_(y, x), picture_(y, x)};
    Pair best{pairs_(y, x)[0], pairs_(y, x)[1]};
    float least = costs_(y, x);
    const auto consider = [&](const Pair& pair) {
      if (pair.front == best.front && pair.back == best.back && least < std::numeric_limits<float>::infinity()) return;
      const float cost = cost_of(here, pair, least);
      if (cost < least) least = cost, best = pair;
    };
    for (const auto& [dy, dx] : {std::pair{-1, 0}, {0, -1}, {0, 1}, {1, 0}})
      if (const int ny = y + dy, nx = x + dx; ny >= 0 && nx >= 0 && ny < picture_.rows && nx < picture_.cols)
        if (costs_(ny, nx) < std::numeric_limits<float>::infinity()) consider({pairs_(ny, nx)[0], pairs_(ny, nx)[1]});
    const auto fronts = static_cast<double>(fronts_.size()), backs = static_cast<double>(backs_.size());
    std::uint64_t bits = random_bits(options_.seed, {y, x, round});
    for (double reach = 1; reach * std::max(fronts, backs) > 1; reach *= narrowing) {
      bits = bits * 6364136223846793005u + 1442695040888963407u;  // Knuth's; its high bits are good
      consider({near(best.front, reach * fronts, fronts_.size(), bits >> 40),
                near(best.back, reach * backs, backs_.size(), bits >> 16 & 0xffffff)});
    }
    pairs_(y, x) = {best.front, best.back};
    costs_(y, x) = least;
  }

  // A sample's number, by 24 random bits, no further than `reach` from `centre`.
  static int near(int centre, double reach, size_t count, std::uint64_t random) {
    const double share = static_cast<double>(static_cast<std::int64_t>(random)) * (2 / 16777216.0) - 1;
    return std::clamp(centre + static_cast<int>(share * reach), 0, static_cast<int>(count) - 1);
  }

  struct Place {
    float x, y, by_front, by_back;  // what a pixel's distance costs
    cv::Vec4f colour;
  };

  // What a pair costs, or, where that is more than `enough`, something that is too.
  float cost_of(const Place& place, const Pair& pair, float enough) const {
    const Sample &front = fronts_[pair.front], &back = backs_[pair.back];
    const float front_x = front.x - place.x, front_y = front.y - place.y, back_x = back.x - place.x,
                back_y = back.y - place.y;
    const float far = place.by_front * std::sqrt(front_x * front_x + front_y * front_y) +
                      place.by_back * std::sqrt(back_x * back_x + back_y * back_y);
    return far >= enough ? far : far + levels * misfit(place.colour, front, back);
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
    ColourSamples result{Rgba::zeros(picture_.size()), Rgba::zeros(picture_.size()), Plane(picture_.size(), 1.0f)};
    for (int y = 0; y < picture_.rows; ++y)
      for (int x = 0; x < picture_.cols; ++x) {
        if (!(costs_(y, x) < std::numeric_limits<float>::infinity())) continue;
        const Sample &front = fronts_[pairs_(y, x)[0]], &back = backs_[pairs_(y, x)[1]];
        result.foreground(y, x) = {front.red, front.green, front.blue, 1};
        result.background(y, x) = {back.red, back.green, back.blue, 1};
        result.misfit(y, x) = misfit(picture_(y, x), front, back);
      }
    return result;
  }

  const Rgba& picture_;
  const Trimap& trimap_;
  const cv::Mat_<unsigned char>& wanted_;
  ColourSampleOptions options_;
  std::vector<Sample> fronts_, backs_;
  Plane far_from_front_, far_from_back_;
  float weight_;
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

ColourSamples sample_colours(const Rgba& picture, const Trimap& trimap, const cv::Mat_<unsigned char>& wanted,
                             const ColourSampleOptions& options, const std::function<void(double)>& done) {
  return Search(picture, trimap, wanted, options).best(done);
}

}  // namespace stillwater
