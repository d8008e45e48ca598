#include "frame/composite.h"

#include <algorithm>
#include <array>

#include "core/parallel.h"
#include "layers/over_kernel.h"

namespace stillwater {
namespace {

constexpr int tile_side = Run::longest;
constexpr int no_layer = -1;

// One row of a tile, as far as it is composed (over_kernel.h).
struct RowState {
  static constexpr int length = tile_side + 3;  // runs are composed by fours
  float through[length];
  float moving[length];
  float most[length];
  int owner[length];
  unsigned char needed[length];
  int open = 0;  // pixels that are needed

  void begin(int count) {
    std::fill_n(through, count, 1.0f);
    std::fill_n(moving, count, 0.0f);
    std::fill_n(most, count, 0.0f);
    std::fill_n(owner, count, no_layer);
    std::fill_n(needed, count, static_cast<unsigned char>(1));
    open = count;
  }
};

class TileComposer {
 public:
  TileComposer(const std::vector<ComposedLayer>& layers, CompositionWish wish, Composition& result)
      : layers_(layers), wish_(wish), result_(result) {}

  void compose(const cv::Rect& tile) {
    for (int y = 0; y < tile.height; ++y) {
      rows_[y].begin(tile.width);
      std::fill_n(result_.combined[tile.y + y] + tile.x, tile.width, cv::Vec4f());
    }
    int open = tile.area();
    for (int i = 0; i < static_cast<int>(layers_.size()) && open > 0; ++i) {
      if (layers_[i].opacity <= 0) continue;
      const cv::Rect part = layers_[i].motion->covered(tile);
      for (int y = part.y; y < part.br().y; ++y) {
        RowState& row = rows_[y - tile.y];
        open -= row.open;
        if (row.open > 0) lay_under(i, part, y, tile.x, row);
        open += row.open;
      }
    }
    for (int y = 0; y < tile.height; ++y) {
      const Run run{tile.x, tile.y + y, tile.width};
      if (wish_.matte) std::copy_n(rows_[y].moving, run.count, result_.matte[run.y] + run.x);
      if (wish_.flow) write_flow(run, rows_[y]);
    }
  }

 private:
  // One row of one layer, as far as it is needed.
  void lay_under(int index, const cv::Rect& part, int y, int tile_x, RowState& row) {
    const ComposedLayer& layer = layers_[index];
    int first = part.x - tile_x, last = first + part.width - 1;
    while (first <= last && !row.needed[first]) ++first;
    while (first < last && !row.needed[last]) --last;
    if (first > last) return;
    const Run open{tile_x + first, y, last - first + 1};
    if (!layer.motion->draw(open, row.needed + first, drawn_.data())) return;
    const StillwaterComposedRun run{result_.combined[y][open.x].val, row.through + first, row.moving + first,
                                    row.most + first, row.owner + first, row.needed + first};
    row.open -= stillwater_lay_under(drawn_.data()->val, layer.opacity, layer.moves ? 1.0f : 0.0f, index, open.count, run);
  }

  // Owners change rarely along a row: each stretch of one owner is one call.
  void write_flow(const Run& run, const RowState& row) {
    cv::Vec2f* out = result_.flow[run.y] + run.x;
    float x[tile_side], y[tile_side];
    for (int i = 0; i < run.count;) {
      const int owner = row.owner[i];
      int count = 1;
      while (i + count < run.count && row.owner[i + count] == owner) ++count;
      if (owner == no_layer || layers_[owner].motion->at_rest()) {
        std::fill_n(out + i, count, cv::Vec2f());
      } else {
        for (int j = 0; j < count; ++j) {
          x[j] = static_cast<float>(run.x + i + j) + 0.5f;
          y[j] = static_cast<float>(run.y) + 0.5f;
        }
        layers_[owner].motion->flow(x, y, count);
        for (int j = 0; j < count; ++j) out[i + j] = {x[j], y[j]};
      }
      i += count;
    }
  }

  const std::vector<ComposedLayer>& layers_;
  CompositionWish wish_;
  Composition& result_;
  std::array<RowState, tile_side> rows_;
  std::array<cv::Vec4f, RowState::length> drawn_;
};

}  // namespace

Composition compose(const std::vector<ComposedLayer>& layers, const cv::Size& size, CompositionWish wish) {
  Composition result{Rgba(size), wish.flow ? Field(size) : Field(), wish.matte ? Plane(size) : Plane()};
  const int columns = (size.width + tile_side - 1) / tile_side, rows = (size.height + tile_side - 1) / tile_side;
  parallel_rows(columns * rows, 1, [&](int first, int last) {
    TileComposer composer(layers, wish, result);
    for (int i = first; i < last; ++i) {
      const cv::Rect tile((i % columns) * tile_side, (i / columns) * tile_side, tile_side, tile_side);
      composer.compose(tile & cv::Rect(cv::Point(), size));
    }
  });
  return result;
}

Rgba compose_alone(const ComposedLayer& layer, const cv::Size& size) {
  return compose({layer}, size, {.flow = false, .matte = false}).combined;
}

}  // namespace stillwater
