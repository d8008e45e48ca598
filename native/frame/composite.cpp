#include "frame/composite.h"

#include <algorithm>
#include <array>
#include <utility>

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
  explicit TileComposer(const std::vector<ComposedLayer>& layers) : layers_(layers) {}

  // Leaves the colours in `combined`, which has the tile's size.
  void compose(const cv::Rect& tile, Rgba combined) {
    combined_ = std::move(combined);
    for (int y = 0; y < tile.height; ++y) {
      rows_[y].begin(tile.width);
      std::fill_n(combined_[y], tile.width, cv::Vec4f());
    }
    int open = tile.area();
    for (int i = 0; i < static_cast<int>(layers_.size()) && open > 0; ++i) {
      if (layers_[i].opacity <= 0) continue;
      const cv::Rect part = layers_[i].motion->covered(tile);
      for (int y = part.y; y < part.br().y; ++y) {
        RowState& row = rows_[y - tile.y];
        open -= row.open;
        if (row.open > 0) lay_under(i, part, y, tile, row);
        open += row.open;
      }
    }
  }

  void write_matte(const cv::Rect& tile, Plane& matte) const {
    for (int y = 0; y < tile.height; ++y) std::copy_n(rows_[y].moving, tile.width, matte[tile.y + y] + tile.x);
  }

  void write_flow(const cv::Rect& tile, Field& flow) const {
    for (int y = 0; y < tile.height; ++y)
      write_flow(Run{tile.x, tile.y + y, tile.width}, rows_[y], flow[tile.y + y] + tile.x);
  }

 private:
  // One row of one layer, as far as it is needed.
  void lay_under(int index, const cv::Rect& part, int y, const cv::Rect& tile, RowState& row) {
    const ComposedLayer& layer = layers_[index];
    int first = part.x - tile.x, last = first + part.width - 1;
    while (first <= last && !row.needed[first]) ++first;
    while (first < last && !row.needed[last]) --last;
    if (first > last) return;
    const Run open{tile.x + first, y, last - first + 1};
    if (!layer.motion->draw(open, row.needed + first, drawn_.data())) return;
    const StillwaterComposedRun run{combined_[y - tile.y][first].val, row.through + first, row.moving + first,
                                    row.most + first, row.owner + first, row.needed + first};
    row.open -= stillwater_lay_under(drawn_.data()->val, layer.opacity, layer.moves ? 1.0f : 0.0f, index, open.count, run);
  }

  // Owners change rarely along a row: each stretch of one owner is one call.
  void write_flow(const Run& run, const RowState& row, cv::Vec2f* out) const {
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
  Rgba combined_;
  std::array<RowState, tile_side> rows_;
  std::array<cv::Vec4f, RowState::length> drawn_;
};

cv::Rect tile_at(int index, const cv::Size& size) {
  const int columns = (size.width + tile_side - 1) / tile_side;
  const cv::Rect tile((index % columns) * tile_side, (index / columns) * tile_side, tile_side, tile_side);
  return tile & cv::Rect(cv::Point(), size);
}

// `each` gets a composer and a tile; every tile once.
template <typename Each>
void for_tiles(const std::vector<ComposedLayer>& layers, const cv::Size& size, const Each& each) {
  const int columns = (size.width + tile_side - 1) / tile_side, rows = (size.height + tile_side - 1) / tile_side;
  parallel_rows(columns * rows, 1, [&](int first, int last) {
    TileComposer composer(layers);
    for (int i = first; i < last; ++i) each(composer, tile_at(i, size));
  });
}

}  // namespace

Composition compose(const std::vector<ComposedLayer>& layers, const cv::Size& size, CompositionWish wish) {
  Composition result{Rgba(size), wish.flow ? Field(size) : Field(), wish.matte ? Plane(size) : Plane()};
  for_tiles(layers, size, [&](TileComposer& composer, const cv::Rect& tile) {
    composer.compose(tile, result.combined(tile));
    if (wish.matte) composer.write_matte(tile, result.matte);
    if (wish.flow) composer.write_flow(tile, result.flow);
  });
  return result;
}

Rgba compose_tile(const std::vector<ComposedLayer>& layers, const cv::Rect& tile) {
  Rgba pixels(tile.size());
  TileComposer(layers).compose(tile, pixels);
  return pixels;
}

void compose_tiles(const std::vector<ComposedLayer>& layers, const cv::Size& size,
                   const std::function<void(const cv::Rect& tile, Rgba pixels)>& take) {
  for_tiles(layers, size, [&](TileComposer& composer, const cv::Rect& tile) {
    thread_local Rgba pixels(tile_side, tile_side);
    const Rgba part = pixels(cv::Rect(cv::Point(), tile.size()));
    composer.compose(tile, part);
    take(tile, part);
  });
}

Rgba compose_alone(const ComposedLayer& layer, const cv::Size& size) {
  return compose({layer}, size, {.flow = false, .matte = false}).combined;
}

}  // namespace stillwater
