#pragma once

#include <functional>
#include <opencv2/core/types.hpp>

/// The only door to threads. Work is cut into fixed pieces that do not depend on the number of threads, and no
/// piece may read what another one writes: so the bytes are the same for any number of threads.
/// No piece may touch Python.
namespace stillwater {

/// Calls `work(first, last)` for consecutive ranges of at most `grain` rows that cover [0, rows). An exception
/// thrown by a piece reaches the caller.
void parallel_rows(int rows, int grain, const std::function<void(int first, int last)>& work);

/// The same, in turns short enough that `at`, called between them with the share of the rows that is done, can report and
/// cancel: what it throws ends the work.
void parallel_rows(int rows, int grain, const std::function<void(int first, int last)>& work,
                   const std::function<void(double share)>& at);

/// Calls `work(y, x)` for every pixel of an image of this size; rows are the pieces' borders.
template <class Work>
void parallel_pixels(const cv::Size& size, const Work& work) {
  parallel_rows(size.height, 32, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < size.width; ++x) work(y, x);
  });
}

/// Threads that parallel_rows may use; 0 = one a core. Throws BadInput when negative or above 1024.
void set_threads(int threads);
int threads();

}  // namespace stillwater
