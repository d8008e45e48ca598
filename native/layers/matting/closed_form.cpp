#include "layers/matting/closed_form.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "layers/matting/conjugate_gradients.h"

namespace stillwater {
namespace {

// Windows need three pixels each way: a narrower picture is repeated beside itself.
template <class Image>
Image at_least_3_wide(const Image& image) {
  Image wide;
  const int right = std::max(0, 3 - image.cols), bottom = std::max(0, 3 - image.rows);
  cv::copyMakeBorder(image, wide, 0, bottom, 0, right, cv::BORDER_REPLICATE);
  return wide;
}

ClosedFormMatte solve(const Rgba& picture, const Trimap& trimap, const ClosedFormOptions& options,
                      const std::function<void(double)>& done) {
  ClosedFormMatte matte{grey_of(trimap)};
  MattingSystem system = matting_laplacian(picture, trimap, options.epsilon);
  const SparseGrid& grid = system.grid;
  if (grid.nodes() == 0) return matte;
  if (options.prior) add_prior(system, *options.prior);
  std::vector<double> alpha(system.right.size(), 0.0);
  const auto each_unknown = [&](const auto& work) {
    for (int y = 0; y < grid.height; ++y)
      for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) work(y, grid.column[node], alpha[grid.entry(node)]);
  };
  if (options.start) each_unknown([&](int y, int x, double& a) { a = (*options.start)(y, x); });
  done(0);
  MattingMultigrid multigrid(system, {.spacing = options.spacing});
  matte.iterations = solve_by_conjugate_gradients(system, multigrid, alpha, {.tolerance = options.tolerance}, done);
  each_unknown([&](int y, int x, double a) { matte.alpha(y, x) = static_cast<float>(a); });
  return matte;
}

}  // namespace

ClosedFormMatte closed_form_matte(const Rgba& picture, const Trimap& trimap, const ClosedFormOptions& options,
                                  const std::function<void(double)>& done) {
  if (picture.cols >= 3 && picture.rows >= 3) return solve(picture, trimap, options, done);
  ClosedFormOptions wide = options;
  if (wide.prior) wide.prior = {at_least_3_wide(wide.prior->alpha), at_least_3_wide(wide.prior->weight)};
  if (wide.start) wide.start = at_least_3_wide(*wide.start);
  ClosedFormMatte matte = solve(at_least_3_wide(picture), at_least_3_wide(trimap), wide, done);
  matte.alpha = matte.alpha(cv::Rect(cv::Point(), picture.size())).clone();
  return matte;
}

}  // namespace stillwater
