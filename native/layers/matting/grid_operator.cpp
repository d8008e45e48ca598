#include "layers/matting/grid_operator.h"

#include <Eigen/Core>
#include <algorithm>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int stripe = 16;
constexpr int few = 6000;

// A node's numbers, and one block of the operator.
template <int B>
using Numbers = Eigen::Matrix<double, B, 1>;
template <int B>
using Block = Eigen::Matrix<double, B, B>;

// right minus the node's row of the operator * solution.
template <int B, class Coefficient>
Numbers<B> rest_at(const Coefficient* blocks, const std::array<int, 5>& around, const double* right,
                   const double* solution) {
  Numbers<B> rest = Eigen::Map<const Numbers<B>>(right);
  for (const int dy : {0, 1, 3, 4, 2}) {
    const double* near = solution + static_cast<size_t>(around[dy]) * B;
    const Coefficient* block = blocks + dy * 5 * B * B;
    if constexpr (B == 1) {
      const double outer = block[0] * near[0] + block[1] * near[1], inner = block[3] * near[3] + block[4] * near[4];
      rest[0] -= outer + block[2] * near[2] + inner;
    } else {
      for (int dx = 0; dx < 5; ++dx)
        rest.noalias() -= Eigen::Map<const Block<B>>(block + dx * B * B) * Eigen::Map<const Numbers<B>>(near + dx * B);
    }
  }
  return rest;
}

}  // namespace

void in_stripes(const SparseGrid& grid, int height, int numbers, const std::function<void(int, int)>& work) {
  if (numbers < few) work(0, grid.height);
  else parallel_rows(grid.height, height, work);
}

void in_alternate_stripes(const SparseGrid& grid, int height, int numbers, bool backwards,
                          const std::function<void(int, int)>& work) {
  const int stripes = (grid.height + height - 1) / height;
  for (const int parity : {backwards ? 1 : 0, backwards ? 0 : 1}) {
    const int count = (stripes + 1 - parity) / 2;
    const auto some = [&](int first, int last) {
      for (int i = first; i < last; ++i) {
        const int top = (2 * i + parity) * height;
        work(top, std::min(grid.height, top + height));
      }
    };
    if (numbers < few) some(0, count);
    else parallel_rows(count, 1, some);
  }
}

template <int B>
void GridOperator<B>::relax(const std::vector<double>& right, std::vector<double>& solution, bool backwards) const {
  in_alternate_stripes(*grid, stripe, grid->nodes() * B * B, backwards, [&](int top, int bottom) {
    const int first = grid->row[top], count = grid->row[bottom] - first;
    for (int i = 0; i < count; ++i) {
      const size_t node = static_cast<size_t>(backwards ? first + count - 1 - i : first + i);
      const size_t entry = static_cast<size_t>(grid->entry(static_cast<int>(node))) * B;
      const Numbers<B> rest =
          rest_at<B>(coefficients + node * 25 * B * B, grid->around[node], &right[entry], solution.data());
      const Eigen::Map<const Block<B>> inverse(inverses + node * B * B);
      Eigen::Map<Numbers<B>> own(&solution[entry]);
      own.noalias() += inverse * rest;
    }
  });
}

template <int B>
void GridOperator<B>::find_residual(const std::vector<double>& right, const std::vector<double>& solution,
                                    std::vector<double>& residual) const {
  in_stripes(*grid, stripe, grid->nodes() * B * B, [&](int top, int bottom) {
    for (int node = grid->row[top]; node < grid->row[bottom]; ++node) {
      const size_t entry = static_cast<size_t>(grid->entry(node)) * B;
      Eigen::Map<Numbers<B>> own(&residual[entry]);
      own = rest_at<B>(coefficients + static_cast<size_t>(node) * 25 * B * B, grid->around[node], &right[entry],
                       solution.data());
    }
  });
}

template struct GridOperator<1>;
template struct GridOperator<4>;

}  // namespace stillwater
