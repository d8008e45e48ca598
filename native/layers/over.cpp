#include "layers/over.h"

#include "core/check.h"
#include "core/parallel.h"

namespace stillwater {

Rgba over(const Rgba& front, const Rgba& back) {
  check::not_empty("front", front);
  check::same_size("back", back, "front", front);
  Rgba whole(front.size());
  parallel_rows(front.rows, 16, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < front.cols; ++x) whole(y, x) = front(y, x) + (1 - front(y, x)[3]) * back(y, x);
  });
  return whole;
}

}  // namespace stillwater
