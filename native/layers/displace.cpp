#include "layers/displace.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int run = 64;

// Calls work(y, x, colours, count) for the displaced image, run by run.
template <class Work>
void each_run(const Source& image, const Field& map, const Work& work) {
  parallel_rows(map.rows, 16, [&](int first, int last) {
    std::array<float, run> x, y;
    std::array<cv::Vec4f, run> colours;
    std::array<unsigned char, run> needed;
    needed.fill(1);
    for (int row = first; row < last; ++row)
      for (int begin = 0; begin < map.cols; begin += run) {
        const int count = std::min(run, map.cols - begin);
        const cv::Vec2f* moved = map[row] + begin;
        for (int i = 0; i < count; ++i) {
          x[i] = static_cast<float>(begin + i) + moved[i][0];
          y[i] = static_cast<float>(row) + moved[i][1];
        }
        if (!image.sample(x.data(), y.data(), needed.data(), count, colours.data())) colours.fill(cv::Vec4f());
        work(row, begin, colours.data(), count);
      }
  });
}

}  // namespace

Rgba displace(const Rgba& image, const Field& map, Beyond beyond) {
  check::not_empty("image", image);
  check::not_empty("map", map);
  Rgba displaced(map.size());
  each_run(Source(image, beyond), map, [&](int y, int x, const cv::Vec4f* colours, int count) {
    std::copy_n(colours, count, displaced[y] + x);
  });
  return displaced;
}

void displace_over(const Source& image, const Field& map, Rgba& back) {
  check::not_empty("map", map);
  check::same_size("back", back, "map", map);
  each_run(image, map, [&](int y, int x, const cv::Vec4f* colours, int count) {
    cv::Vec4f* under = back[y] + x;
    for (int i = 0; i < count; ++i) under[i] = colours[i] + (1 - colours[i][3]) * under[i];
  });
}

}  // namespace stillwater
