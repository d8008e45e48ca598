#include "patches/vote.h"

#include <algorithm>

#include "core/parallel.h"

namespace stillwater {

void vote(const MatchField& field, int patch, const Plane& weight, const Rgba& source, const Mask& region, Rgba& target,
          const std::function<void(double)>& at) {
  const int half = patch / 2, left = field.area.x, top = field.area.y;
  const cv::Rect reached =
      cv::Rect(left - half, top - half, field.area.width + 2 * half, field.area.height + 2 * half) &
      cv::Rect(0, 0, target.cols, target.rows);
  parallel_rows(
      reached.height, 8,
      [&](int first, int last) {
        for (int y = reached.y + first; y < reached.y + last; ++y)
          for (int x = reached.x; x < reached.br().x; ++x) {
            if (!region(y, x)) continue;
            cv::Vec4f sum(0, 0, 0, 0);
            float all = 0;
            for (int row = std::max(0, y - half - top); row <= std::min(field.area.height - 1, y + half - top); ++row)
              for (int column = std::max(0, x - half - left); column <= std::min(field.area.width - 1, x + half - left);
                   ++column) {
                const float share = weight(row, column);
                if (share <= 0) continue;
                const cv::Vec2s& offset = field.offset(row, column);
                sum += share * source(y + offset[1], x + offset[0]);
                all += share;
              }
            if (all > 0) target(y, x) = sum * (1 / all);
          }
      },
      at);
}

}  // namespace stillwater
