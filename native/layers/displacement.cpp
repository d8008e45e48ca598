#include "layers/displacement.h"

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

}  // namespace

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
