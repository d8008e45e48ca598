#include "layers/matting/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

using Vector = std::vector<double>;

constexpr size_t piece = 1 << 14;

// Calls `work(first, last)` for pieces of a vector; the pieces do not depend on the number of threads.
template <class Work>
void in_pieces(size_t size, const Work& work) {
  parallel_rows(static_cast<int>((size + piece - 1) / piece), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      work(static_cast<size_t>(i), static_cast<size_t>(i) * piece, std::min(size, static_cast<size_t>(i + 1) * piece));
  });
}

double dot(const Vector& a, const Vector& b) {
  Vector parts((a.size() + piece - 1) / piece);
  in_pieces(a.size(), [&](size_t i, size_t first, size_t last) {
    double sum[4] = {0, 0, 0, 0};
    size_t k = first;
    for (; k + 4 <= last; k += 4)
      for (size_t j = 0; j < 4; ++j) sum[j] += a[k + j] * b[k + j];
    for (; k < last; ++k) sum[0] += a[k] * b[k];
    parts[i] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

double largest(const Vector& a) {
  Vector parts((a.size() + piece - 1) / piece);
  in_pieces(a.size(), [&](size_t i, size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) parts[i] = std::max(parts[i], std::abs(a[k]));
  });
  return *std::max_element(parts.begin(), parts.end());
}

// a = a * scale + b * by
void combine(Vector& a, double scale, const Vector& b, double by) {
  in_pieces(a.size(), [&](size_t, size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) a[k] = a[k] * scale + b[k] * by;
  });
}

}  // namespace

int solve_by_conjugate_gradients(const MattingSystem& system, MattingMultigrid& preconditioner, Vector& solution,
                                 const ConjugateGradientsOptions& options, const std::function<void(double)>& done) {
  Vector residual = system.right, direction(solution.size(), 0.0), product(solution.size(), 0.0), correction;
  multiply(system, solution, product);
  combine(residual, 1, product, -1);
  double before = 0, first_error = 0, least_error = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= options.iterations; ++i) {
    preconditioner.solve_roughly(residual, correction);
    const double error = largest(correction);
    if (error <= options.tolerance) {
      combine(solution, 1, correction, 1);
      return i;
    }
    if (i == 0) first_error = error;
    least_error = std::min(least_error, error);
    done(std::log(first_error / least_error) / std::log(first_error / options.tolerance));
    const double now = dot(residual, correction);
    combine(direction, i == 0 ? 0 : now / before, correction, 1);
    multiply(system, direction, product);
    const double step = now / dot(direction, product);
    combine(solution, 1, direction, step);
    combine(residual, 1, product, -step);
    before = now;
  }
  throw NotConverged("matte: " + std::to_string(options.iterations) + " iterations were not enough to solve for alpha");
}

}  // namespace stillwater
