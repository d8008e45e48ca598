#include "layers/matting/matting_multigrid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <deque>

#include "core/parallel.h"
#include "layers/matting/grid_coarsening.h"
#include "layers/matting/grid_operator.h"

namespace stillwater {
namespace {

// Where colours are flat their coefficients say nothing: so much of a block's trace is added to its diagonal.
constexpr double stiffness = 1e-10;

struct CoarseLevel {
  GridCoarsening way;  // from the finer level to this one
  std::vector<double> coefficients, inverses;
  std::vector<double> right, solution, residual;
  GridOperator<4> system;
};

// Colours about their mean.
Basis centred(const MattingSystem& system) {
  Basis basis(system.colours.size());
  std::array<double, 4> mean{};
  for (const cv::Vec4f& colour : system.colours)
    for (int c = 1; c < 4; ++c) mean[c] += colour[c];
  for (double& m : mean) m /= std::max(1, system.grid.nodes());
  for (size_t i = 0; i < basis.size(); ++i)
    for (int c = 0; c < 4; ++c) basis[i][c] = system.colours[i][0] * (system.colours[i][c] - mean[c]);
  return basis;
}

// Stiffens each node's own block, and gives the blocks' inverses.
std::vector<double> stiffened_inverses(std::vector<double>& coefficients) {
  const size_t nodes = coefficients.size() / 400;
  std::vector<double> inverses(nodes * 16);
  for (size_t node = 0; node < nodes; ++node) {
    Eigen::Map<Eigen::Matrix4d> own(&coefficients[node * 400 + 12 * 16]);
    own.diagonal().array() += stiffness * own.trace() + 1e-30;
    Eigen::Map<Eigen::Matrix4d> inverse(&inverses[node * 16]);
    inverse = own.ldlt().solve(Eigen::Matrix4d::Identity());
  }
  return inverses;
}

template <int B>
CoarseLevel coarser(const SparseGrid& grid, int spacing, const Basis* basis, const double* coefficients) {
  CoarseLevel level{coarsened(grid, spacing), {}, {}, {}, {}, {}, {}};
  level.coefficients = galerkin<B>(level.way, grid, basis, coefficients);
  level.inverses = stiffened_inverses(level.coefficients);
  for (auto* vector : {&level.right, &level.solution, &level.residual})
    vector->assign(static_cast<size_t>(level.way.grid.entries()) * 4, 0.0);
  return level;
}

Eigen::MatrixXd dense(const SparseGrid& grid, const std::vector<double>& coefficients) {
  std::vector<int> node_of_entry(static_cast<size_t>(grid.entries()), -1);
  for (int node = 0; node < grid.nodes(); ++node) node_of_entry[grid.entry(node)] = node;
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(4 * grid.nodes(), 4 * grid.nodes());
  for (int node = 0; node < grid.nodes(); ++node)
    for (int k = 0; k < 25; ++k)
      if (const int other = node_of_entry[grid.around[node][k / 5] + k % 5]; other >= 0)
        whole.block<4, 4>(4 * node, 4 * other) =
            Eigen::Map<const Eigen::Matrix4d>(&coefficients[static_cast<size_t>(node) * 400 + k * 16]);
  return whole;
}

}  // namespace

struct MattingMultigrid::Levels {
  const MattingSystem& system;
  Basis basis;
  std::vector<float> coefficients;
  std::vector<double> inverses, residual;
  GridOperator<1> fine;
  std::deque<CoarseLevel> coarse;
  Eigen::LLT<Eigen::MatrixXd> direct;

  explicit Levels(const MattingSystem& s, const MultigridOptions& options)
      : system(s),
        basis(centred(s)),
        coefficients(s.coefficients.size()),
        inverses(static_cast<size_t>(s.grid.nodes())),
        residual(s.right.size(), 0.0) {
    for (size_t node = 0; node < inverses.size(); ++node) inverses[node] = 1 / s.coefficients[node * 25 + 12];
    parallel_rows(s.grid.nodes(), 4096, [&](int first, int last) {
      for (size_t i = static_cast<size_t>(first) * 25; i < static_cast<size_t>(last) * 25; ++i)
        coefficients[i] = static_cast<float>(s.coefficients[i]);
    });
    fine = {&s.grid, coefficients.data(), inverses.data()};
    coarse.push_back(coarser<1>(s.grid, options.spacing, &basis, s.coefficients.data()));
    while (coarse.back().way.grid.nodes() > options.coarsest)
      coarse.push_back(coarser<4>(coarse.back().way.grid, 2, nullptr, coarse.back().coefficients.data()));
    for (CoarseLevel& level : coarse)
      level.system = {&level.way.grid, level.coefficients.data(), level.inverses.data()};
    direct.compute(dense(coarse.back().way.grid, coarse.back().coefficients));
  }

  void solve_coarsest(CoarseLevel& level) {
    const SparseGrid& grid = level.way.grid;
    Eigen::VectorXd right(4 * grid.nodes());
    for (int node = 0; node < grid.nodes(); ++node)
      for (int b = 0; b < 4; ++b) right[4 * node + b] = level.right[static_cast<size_t>(grid.entry(node)) * 4 + b];
    const Eigen::VectorXd solution = direct.solve(right);
    for (int node = 0; node < grid.nodes(); ++node)
      for (int b = 0; b < 4; ++b)
        level.solution[static_cast<size_t>(grid.entry(node)) * 4 + b] = solution[4 * node + b];
  }

  // right -> solution, on coarse level i.
  void cycle(size_t i) {
    CoarseLevel& level = coarse[i];
    if (i + 1 == coarse.size()) return solve_coarsest(level);
    std::fill(level.solution.begin(), level.solution.end(), 0.0);
    level.system.relax(level.right, level.solution, false);
    level.system.find_residual(level.right, level.solution, level.residual);
    correct(i + 1, level.way.grid, nullptr, level.residual, level.solution);
    level.system.relax(level.right, level.solution, true);
  }

  // Adds to a finer level's solution what level i makes of its residual.
  void correct(size_t i, const SparseGrid& finer, const Basis* of_finer, const std::vector<double>& rest,
               std::vector<double>& solution) {
    CoarseLevel& level = coarse[i];
    std::fill(level.right.begin(), level.right.end(), 0.0);
    restrict_to(level.way, finer, of_finer, rest, level.right);
    cycle(i);
    interpolate_from(level.way, finer, of_finer, level.solution, solution);
  }
};

MattingMultigrid::MattingMultigrid(const MattingSystem& system, const MultigridOptions& options)
    : levels_(std::make_unique<Levels>(system, options)) {}

MattingMultigrid::~MattingMultigrid() = default;

void MattingMultigrid::solve_roughly(const std::vector<double>& right, std::vector<double>& solution) {
  Levels& all = *levels_;
  solution.assign(right.size(), 0.0);
  all.fine.relax(right, solution, false);
  all.fine.find_residual(right, solution, all.residual);
  all.correct(0, all.system.grid, &all.basis, all.residual, solution);
  all.fine.relax(right, solution, true);
}

void multiply(const MattingSystem& system, const std::vector<double>& vector, std::vector<double>& product) {
  const SparseGrid& grid = system.grid;
  parallel_rows(grid.height, 16, [&](int top, int bottom) {
    for (int node = grid.row[top]; node < grid.row[bottom]; ++node) {
      const double* row = &system.coefficients[static_cast<size_t>(node) * 25];
      double sum = 0;
      for (int dy = 0; dy < 5; ++dy) {
        const double* near = &vector[static_cast<size_t>(grid.around[node][dy])];
        sum += (row[dy * 5] * near[0] + row[dy * 5 + 1] * near[1]) + row[dy * 5 + 2] * near[2] +
               (row[dy * 5 + 3] * near[3] + row[dy * 5 + 4] * near[4]);
      }
      product[static_cast<size_t>(grid.entry(node))] = sum;
    }
  });
}

}  // namespace stillwater
