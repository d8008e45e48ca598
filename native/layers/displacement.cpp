#include "layers/displacement.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

template <class Row>
Field evaluate(int width, int height, const Row& row) {
  check::size("size", width, height);
  Field field(height, width);
  parallel_rows(height, 16, [&](int first, int last) {
    std::vector<float> x(width), y(width);
    for (int i = first; i < last; ++i) {
      row(i + 0.5f, x.data(), y.data());
      for (int j = 0; j < width; ++j) field(i, j) = {x[j] - (j + 0.5f), y[j] - (i + 0.5f)};
    }
  });
  return field;
}

void fill_row(float x0, float y0, float step, int count, float* x, float* y) {
  for (int i = 0; i < count; ++i) x[i] = x0 + step * static_cast<float>(i);
  std::fill_n(y, count, y0);
}

class Mirrored final : public Displacement {
 public:
  Mirrored(std::shared_ptr<const Displacement> base, const Segment& axis) : base_(std::move(base)), on_axis_(axis.from) {
    const double dx = axis.to.x - axis.from.x, dy = axis.to.y - axis.from.y, length = std::hypot(dx, dy);
    normal_ = {-dy / length, dx / length};
  }

  bool at_rest() const override { return base_->at_rest(); }
  float reach() const override { return base_->reach(); }

  cv::Rect spread(const cv::Rect& box) const override { return reflected(base_->spread(reflected(box))); }

  void map(float* x, float* y, int count) const override {
    reflect(x, y, count);
    base_->map(x, y, count);
    reflect(x, y, count);
  }

  void unmap(float* x, float* y, int count) const override {
    reflect(x, y, count);
    base_->unmap(x, y, count);
    reflect(x, y, count);
  }

 private:
  // The upright box around the mirrored one.
  cv::Rect reflected(const cv::Rect& box) const {
    float x[4] = {float(box.x), float(box.br().x), float(box.x), float(box.br().x)};
    float y[4] = {float(box.y), float(box.y), float(box.br().y), float(box.br().y)};
    reflect(x, y, 4);
    const auto [left, right] = std::minmax_element(x, x + 4);
    const auto [top, bottom] = std::minmax_element(y, y + 4);
    return {cv::Point(int(std::floor(*left)), int(std::floor(*top))), cv::Point(int(std::ceil(*right)), int(std::ceil(*bottom)))};
  }

  void reflect(float* x, float* y, int count) const {
    const auto nx = static_cast<float>(normal_.x), ny = static_cast<float>(normal_.y);
    const auto offset = static_cast<float>(normal_.x * on_axis_.x + normal_.y * on_axis_.y);
    for (int i = 0; i < count; ++i) {
      const float twice = 2 * (nx * x[i] + ny * y[i] - offset);
      x[i] -= twice * nx;
      y[i] -= twice * ny;
    }
  }

  std::shared_ptr<const Displacement> base_;
  Point on_axis_, normal_;
};

class Chained final : public Displacement {
 public:
  Chained(std::shared_ptr<const Displacement> first, std::shared_ptr<const Displacement> then)
      : first_(std::move(first)), then_(std::move(then)) {}

  bool at_rest() const override { return first_->at_rest() && then_->at_rest(); }
  float reach() const override { return first_->reach() + then_->reach(); }

  cv::Rect spread(const cv::Rect& box) const override { return then_->spread(first_->spread(box)); }

  void map(float* x, float* y, int count) const override {
    first_->map(x, y, count);
    then_->map(x, y, count);
  }

  void unmap(float* x, float* y, int count) const override {
    then_->unmap(x, y, count);
    first_->unmap(x, y, count);
  }

  void unmap_row(float x0, float y0, float step, int count, float* x, float* y) const override {
    then_->unmap_row(x0, y0, step, count, x, y);
    first_->unmap(x, y, count);
  }

 private:
  std::shared_ptr<const Displacement> first_, then_;
};

}  // namespace

std::shared_ptr<const Displacement> mirrored(std::shared_ptr<const Displacement> base, const Segment& axis) {
  check::segment("axis", axis);
  return std::make_shared<Mirrored>(std::move(base), axis);
}

std::shared_ptr<const Displacement> chained(std::shared_ptr<const Displacement> first,
                                            std::shared_ptr<const Displacement> then) {
  if (!first || !then) return first ? first : then;
  return std::make_shared<Chained>(std::move(first), std::move(then));
}

cv::Rect Displacement::spread(const cv::Rect& box) const {
  const int by = static_cast<int>(std::ceil(reach())) + 1;
  return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

void Displacement::unmap_row(float x0, float y0, float step, int count, float* x, float* y) const {
  fill_row(x0, y0, step, count, x, y);
  unmap(x, y, count);
}

Field displacement_map(const Displacement& displacement, int width, int height) {
  return evaluate(width, height,
                  [&](float centre, float* x, float* y) { displacement.unmap_row(0.5f, centre, 1, width, x, y); });
}

Field forward_map(const Displacement& displacement, int width, int height) {
  return evaluate(width, height, [&](float centre, float* x, float* y) {
    fill_row(0.5f, centre, 1, width, x, y);
    displacement.map(x, y, width);
  });
}

}  // namespace stillwater
