#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <opencv2/core/utility.hpp>

#include "core/check.h"

namespace stillwater {
namespace {

std::atomic<int> wanted_threads{0};

}  // namespace

void set_threads(int threads) {
  check::in_range("threads", threads, 0, 1024);
  wanted_threads = threads;
  cv::setNumThreads(threads == 0 ? -1 : threads);
}

int threads() { return wanted_threads > 0 ? wanted_threads.load() : cv::getNumberOfCPUs(); }

void parallel_rows(int rows, int grain, const std::function<void(int, int)>& work) {
  if (rows <= 0) return;
  const int pieces = (rows + grain - 1) / grain;
  if (pieces == 1 || threads() == 1) {
    for (int i = 0; i < pieces; ++i) work(i * grain, std::min(rows, (i + 1) * grain));
    return;
  }
  std::exception_ptr first_error;
  std::mutex error_mutex;
  std::atomic<bool> failed{false};
  cv::parallel_for_(
      cv::Range(0, pieces),
      [&](const cv::Range& range) {
        for (int i = range.start; i < range.end && !failed; ++i) try {
            work(i * grain, std::min(rows, (i + 1) * grain));
          } catch (...) {
            const std::lock_guard lock(error_mutex);
            if (!first_error) first_error = std::current_exception();
            failed = true;
          }
      },
      pieces);
  if (first_error) std::rethrow_exception(first_error);
}

void parallel_rows(int rows, int grain, const std::function<void(int, int)>& work, const std::function<void(double)>& at) {
  constexpr int pieces_a_turn = 8;
  for (int first = 0; first < rows; first += grain * pieces_a_turn) {
    const int some = std::min(rows - first, grain * pieces_a_turn);
    parallel_rows(some, grain, [&](int from, int to) { work(first + from, first + to); });
    if (at) at(static_cast<double>(first + some) / rows);
  }
}

}  // namespace stillwater
