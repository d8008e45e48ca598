#include "layers/inpainting/fill_front.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <vector>

#include "core/random.h"

namespace stillwater {
namespace {

constexpr int whole_confidence = 1 << 16;
// Added to D: plain parts are filled too, the surest first.
constexpr double least_data = 0.02;
// How a known pixel counts against one that is only guessed.
constexpr int known_weight = 4, guessed_weight = 1;
// Comparisons that a search everywhere may take, all patches together.
constexpr double affordable = 6e6;
constexpr int random_tries = 6;  // at each reach

struct Front {
  std::int64_t priority;
  int place, version;
  bool operator<(const Front& other) const {
    return priority != other.priority ? priority < other.priority : place > other.place;
  }
};

class FillFront {
 public:
  FillFront(InpaintLevel& level, const FillFrontParameters& parameters)
      : level_(level),
        parameters_(parameters),
        half_(parameters.patch / 2),
        size_(level.hole.size()),
        open_(level.hole.clone()),
        confidence_(size_, whole_confidence),
        version_(size_, 0),
        shifts_(ShiftMap::zeros(size_)),
        weights_(static_cast<size_t>(parameters.patch) * parameters.patch),
        wanted_(static_cast<size_t>(parameters.patch) * parameters.patch) {
    confidence_.setTo(0, open_);
    cv::findNonZero(level.centres, sources_);
    const double steps = 3.0 * cv::countNonZero(open_) / (parameters.patch * parameters.patch) + 1;
    everywhere_ = !parameters.guidance && steps * static_cast<double>(sources_.size()) < affordable;
  }

  ShiftMap run(const std::function<void(double)>& at) {
    const int all = cv::countNonZero(open_);
    int left = all;
    push_front(cv::Rect(cv::Point(), size_));
    while (left > 0 && !queue_.empty()) {
      const Front next = queue_.top();
      queue_.pop();
      const cv::Point place(next.place % size_.width, next.place / size_.width);
      if (!open_(place) || version_(place) != next.version) continue;
      left -= fill(place);
      if (at) at(1 - static_cast<double>(left) / all);
    }
    return shifts_;
  }

 private:
  cv::Rect around(const cv::Point& place, int reach) const {
    return cv::Rect(place.x - reach, place.y - reach, 2 * reach + 1, 2 * reach + 1) & cv::Rect(cv::Point(), size_);
  }

  cv::Point inner(const cv::Point& place) const {
    return {std::clamp(place.x, half_, size_.width - 1 - half_), std::clamp(place.y, half_, size_.height - 1 - half_)};
  }

  bool is_known(int y, int x) const { return y >= 0 && x >= 0 && y < size_.height && x < size_.width && !open_(y, x); }

  void push_front(const cv::Rect& part) {
    for (int y = part.y; y < part.br().y; ++y)
      for (int x = part.x; x < part.br().x; ++x) {
        if (!open_(y, x)) continue;
        if (!is_known(y - 1, x) && !is_known(y + 1, x) && !is_known(y, x - 1) && !is_known(y, x + 1)) continue;
        queue_.push({priority({x, y}), y * size_.width + x, ++version_(y, x)});
      }
  }

  std::int64_t confidence_at(const cv::Point& place) const {
    std::int64_t sum = 0;
    const cv::Rect part = around(inner(place), half_);
    for (int y = part.y; y < part.br().y; ++y)
      for (int x = part.x; x < part.br().x; ++x) sum += confidence_(y, x);
    return sum / part.area();
  }

  int light(int y, int x) const {
    const cv::Vec4b& pixel = level_.bytes(y, x);
    return pixel[0] + 2 * pixel[1] + pixel[2] + pixel[3];
  }

  // The strongest gradient of the known pixels near a place, and how it lies to the front there.
  double data_at(const cv::Point& place) const {
    int nx = 0, ny = 0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) {
        const int y = std::clamp(place.y + j, 0, size_.height - 1), x = std::clamp(place.x + i, 0, size_.width - 1);
        if (open_(y, x)) nx += i, ny += j;
      }
    if (nx == 0 && ny == 0) return 0;
    std::int64_t strongest = 0;
    int gx = 0, gy = 0;
    const cv::Rect part = around(place, half_);
    for (int y = part.y; y < part.br().y; ++y)
      for (int x = part.x; x < part.br().x; ++x) {
        if (!is_known(y, x) || !is_known(y, x - 1) || !is_known(y, x + 1) || !is_known(y - 1, x) || !is_known(y + 1, x))
          continue;
        const int dx = light(y, x + 1) - light(y, x - 1), dy = light(y + 1, x) - light(y - 1, x);
        const std::int64_t strength = static_cast<std::int64_t>(dx) * dx + static_cast<std::int64_t>(dy) * dy;
        if (strength > strongest) strongest = strength, gx = dx, gy = dy;
      }
    return std::abs(static_cast<double>(gx) * ny - static_cast<double>(gy) * nx) /
           std::sqrt(static_cast<double>(nx * nx + ny * ny)) / 1024;
  }

  std::int64_t priority(const cv::Point& place) const {
    return static_cast<std::int64_t>(static_cast<double>(confidence_at(place)) * (data_at(place) + least_data) * 64);
  }

  int fill(const cv::Point& place) {
    const cv::Point centre = inner(place);
    look_at(centre);
    const cv::Point source = best_source(centre);
    const int confidence = static_cast<int>(confidence_at(place));
    const cv::Vec2s shift(static_cast<short>(source.x - centre.x), static_cast<short>(source.y - centre.y));
    const cv::Rect part = around(centre, half_);
    int filled = 0;
    for (int y = part.y; y < part.br().y; ++y)
      for (int x = part.x; x < part.br().x; ++x) {
        if (!open_(y, x)) continue;
        open_(y, x) = 0, ++filled;
        confidence_(y, x) = confidence;
        shifts_(y, x) = shift;
        level_.bytes(y, x) = level_.bytes(y + shift[1], x + shift[0]);
        level_.colour(y, x) = level_.colour(y + shift[1], x + shift[0]);
      }
    push_front(around(centre, 2 * half_ + 1));
    return filled;
  }

  // What the patch must look like, and how much each of its pixels counts.
  void look_at(const cv::Point& centre) {
    const int patch = parameters_.patch;
    for (int j = 0; j < patch; ++j)
      for (int i = 0; i < patch; ++i) {
        const int y = centre.y + j - half_, x = centre.x + i - half_;
        const bool known = !open_(y, x);
        weights_[static_cast<size_t>(j) * patch + i] = known ? known_weight : parameters_.guidance ? guessed_weight : 0;
        wanted_[static_cast<size_t>(j) * patch + i] =
            known || !parameters_.guidance ? level_.bytes(y, x) : (*parameters_.guidance)(y, x);
      }
  }

  std::int64_t distance(const cv::Point& source, std::int64_t limit) const {
    const int patch = parameters_.patch;
    std::int64_t sum = 0;
    for (int j = 0; j < patch && sum < limit; ++j) {
      const unsigned char *have = level_.bytes.at(source.y + j - half_, source.x - half_),
                          *want = wanted_[static_cast<size_t>(j) * patch].val;
      const int* weight = &weights_[static_cast<size_t>(j) * patch];
      int row = 0;
      for (int i = 0; i < patch; ++i) {
        int pixel = 0;
        for (int c = 0; c < 4; ++c) pixel += (have[4 * i + c] - want[4 * i + c]) * (have[4 * i + c] - want[4 * i + c]);
        row += weight[i] * pixel;
      }
      sum += row;
    }
    return sum;
  }

  struct Best {
    cv::Point source{-1, -1};
    std::int64_t distance = std::numeric_limits<std::int64_t>::max();
  };

  void attempt(const cv::Point& centre, const cv::Point& source, Best& best) const {
    if (source.x < 0 || source.y < 0 || source.x >= size_.width || source.y >= size_.height || !level_.centres(source))
      return;
    const cv::Point shift = source - centre;
    if (level_.radius > 0 && shift.ddot(shift) > level_.radius * level_.radius) return;
    const std::int64_t found = distance(source, best.distance);
    if (found < best.distance) best = {source, found};
  }

  cv::Point best_source(const cv::Point& centre) {
    Best best;
    if (everywhere_) {
      for (const cv::Point& source : sources_) attempt(centre, source, best);
    } else {
      ask_neighbours(centre, best);
      take_hints(centre, best);
      look_around(centre, best);
    }
    // Few may be near enough, or allowed at all: then each is tried.
    if (best.source.x < 0)
      for (const cv::Point& source : sources_) attempt(centre, source, best);
    return best.source;
  }

  void ask_neighbours(const cv::Point& centre, Best& best) const {
    std::vector<cv::Vec2s> asked;
    const cv::Rect part = around(centre, half_ + 2);
    for (int y = part.y; y < part.br().y; y += 2)
      for (int x = part.x; x < part.br().x; x += 2) {
        if (!level_.hole(y, x) || open_(y, x)) continue;
        const cv::Vec2s shift = shifts_(y, x);
        if (std::find(asked.begin(), asked.end(), shift) != asked.end()) continue;
        asked.push_back(shift);
        attempt(centre, centre + cv::Point(shift[0], shift[1]), best);
      }
  }

  void take_hints(const cv::Point& centre, Best& best) const {
    if (!parameters_.hints) return;
    const cv::Rect part = around(centre, half_);
    for (int y = part.y; y < part.br().y; y += 2)
      for (int x = part.x; x < part.br().x; x += 2) {
        if (!level_.hole(y, x)) continue;
        const cv::Vec2s shift = (*parameters_.hints)(y, x);
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) attempt(centre, centre + cv::Point(shift[0] + dx, shift[1] + dy), best);
      }
  }

  void look_around(const cv::Point& centre, Best& best) {
    int count = 0;
    const auto within = [&](int reach) {
      const double share = random_uniform(parameters_.seed, {centre.y, centre.x, count++});
      return static_cast<int>(share * (2 * reach + 1)) - reach;
    };
    const int longest = level_.radius > 0 ? static_cast<int>(level_.radius) : std::max(size_.width, size_.height);
    for (int reach = longest; reach > half_; reach = reach * 2 / 3)
      for (int i = 0; i < random_tries; ++i) {
        const int dx = within(reach), dy = within(reach);
        attempt(centre, centre + cv::Point(dx, dy), best);
      }
    if (best.source.x < 0) return;
    for (int reach = std::max(2, longest / 8); reach >= 1; reach /= 2)
      for (int i = 0; i < random_tries; ++i) {
        const int dx = within(reach), dy = within(reach);
        attempt(centre, best.source + cv::Point(dx, dy), best);
      }
  }

  InpaintLevel& level_;
  FillFrontParameters parameters_;
  int half_;
  cv::Size size_;
  Mask open_;  // not filled yet
  cv::Mat_<int> confidence_, version_;
  ShiftMap shifts_;
  std::vector<int> weights_;
  std::vector<cv::Vec4b> wanted_;
  std::vector<cv::Point> sources_;
  bool everywhere_;
  std::priority_queue<Front> queue_;
};

}  // namespace

ShiftMap fill_front(InpaintLevel& level, const FillFrontParameters& parameters, const std::function<void(double)>& at) {
  return FillFront(level, parameters).run(at);
}

}  // namespace stillwater
