#include "layers/displacement.h"

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
  for (int i = 0; i < count; ++i) {
    x[i] = x0 + step * i;
    y[i] = y0;
  }
}

class Mirrored final : public Displacement {
 public:
  Mirrored(std::shared_ptr<const Displacement> base, const Segment& axis) : base_(std::move(base)), on_axis_(axis.from) {
    const double dx = axis.to.x - axis.from.x, dy = axis.to.y - axis.from.y, length = std::hypot(dx, dy);
    normal_ = {-dy / length, dx / length};
  }

  bool at_rest() const override { return base_->at_rest(); }
  float reach() const override { return base_->reach(); }

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

  void map(float* x, float* y, int count) const override {
    first_->map(x, y, count);
    then_->map(x, y, count);
  }

  void unmap(float* x, float* y, int count) const override {
    then_->unmap(x, y, count);
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
