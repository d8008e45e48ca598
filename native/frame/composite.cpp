#include "frame/composite.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
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
  unsigned char around_needed[8 + length + 8] = {};
  unsigned char* const needed = around_needed + 8;
  int open = 0;  // pixels that are needed
};

static_assert(std::endian::native == std::endian::little);

std::uint64_t eight_bytes(const unsigned char* bytes) {
  std::uint64_t eight;
  std::memcpy(&eight, bytes, sizeof eight);
  return eight;
}

// How many bytes there are before the first, or behind the last, that is not 0; at most `count`. Seven more are read.
int zeros_before(const unsigned char* bytes, int count) {
  for (int i = 0; i < count; i += 8)
    if (const std::uint64_t eight = eight_bytes(bytes + i)) return std::min(count, i + std::countr_zero(eight) / 8);
  return count;
}

int zeros_behind(const unsigned char* bytes, int count) {
  for (int i = 0; i < count; i += 8)
    if (const std::uint64_t eight = eight_bytes(bytes + count - i - 8))
      return std::min(count, i + std::countl_zero(eight) / 8);
  return count;
}

// Composes one tile, row by row: what is known of a row stays in the processor's nearest cache.
class TileComposer {
 public:
  // `traced`: write_matte() and write_flow() will be asked.
  TileComposer(const std::vector<ComposedLayer>& layers, const cv::Rect& tile, bool traced)
      : layers_(layers), tile_(tile), traced_(traced) {
    for (int i = 0; i < static_cast<int>(layers_.size()); ++i) {
      if (layers_[i].opacity <= 0) continue;
      const cv::Rect part = layers_[i].motion->covered(tile);
      if (!part.empty()) parts_.push_back({i, part});
    }
  }

  // Row y of the output; colours go to `combined`.
  void compose(int y, cv::Vec4f* combined) {
    begin(y, combined);
    for (const Part& part : parts_)
      if (row_.open > 0 && y >= part.place.y && y < part.place.br().y) lay_under(part);
  }

  // Of the row composed last.
  void write_matte(float* matte) const { std::copy_n(row_.moving, tile_.width, matte); }

  // Owners change rarely along a row: each stretch of one owner is one call.
  void write_flow(cv::Vec2f* out) const {
    float x[tile_side], y[tile_side];
    for (int i = 0; i < tile_.width;) {
      const int owner = row_.owner[i];
      int count = 1;
      while (i + count < tile_.width && row_.owner[i + count] == owner) ++count;
      if (owner == no_layer || layers_[owner].motion->at_rest()) {
        std::fill_n(out + i, count, cv::Vec2f());
      } else {
        for (int j = 0; j < count; ++j) {
          x[j] = static_cast<float>(tile_.x + i + j) + 0.5f;
          y[j] = static_cast<float>(y_) + 0.5f;
        }
        layers_[owner].motion->flow(x, y, count);
        for (int j = 0; j < count; ++j) out[i + j] = {x[j], y[j]};
      }
      i += count;
    }
  }

 private:
  struct Part {
    int layer;
    cv::Rect place;
  };

  void begin(int y, cv::Vec4f* combined) {
    y_ = y, combined_ = combined;
    std::memset(combined->val, 0, tile_.width * sizeof *combined);
    std::fill_n(row_.through, tile_.width, 1.0f);
    std::fill_n(row_.needed, tile_.width, static_cast<unsigned char>(1));
    row_.open = tile_.width;
    if (!traced_) return;
    std::fill_n(row_.moving, tile_.width, 0.0f);
    std::fill_n(row_.most, tile_.width, 0.0f);
    std::fill_n(row_.owner, tile_.width, no_layer);
  }

  // The row of one layer, as far as it is needed.
  void lay_under(const Part& part) {
    const ComposedLayer& layer = layers_[part.layer];
    const unsigned char* needed = row_.needed + (part.place.x - tile_.x);
    const int hidden = zeros_before(needed, part.place.width), rest = part.place.width - hidden;
    if (rest == 0) return;
    const int first = part.place.x - tile_.x + hidden;
    const Run open{tile_.x + first, y_, rest - zeros_behind(needed + hidden, rest)};
    const cv::Vec4f* drawn = layer.motion->draw(open, row_.needed + first, drawn_.data());
    if (!drawn) return;
    const auto traced = [&](auto* numbers) { return traced_ ? numbers + first : nullptr; };
    const StillwaterComposedRun run{combined_[first].val, row_.through + first, traced(row_.moving),
                                    traced(row_.most),    traced(row_.owner),   row_.needed + first};
    const float moves = layer.moves ? 1.0f : 0.0f;
    row_.open -= stillwater_lay_under(drawn->val, layer.opacity, moves, part.layer, open.count, run);
  }

  const std::vector<ComposedLayer>& layers_;
  cv::Rect tile_;
  bool traced_;
  std::vector<Part> parts_;  // where layers may be seen
  RowState row_;
  int y_ = 0;
  cv::Vec4f* combined_ = nullptr;
  std::array<cv::Vec4f, RowState::length> drawn_;
};

cv::Rect tile_at(int index, const cv::Size& size) {
  const int columns = (size.width + tile_side - 1) / tile_side;
  const cv::Rect tile((index % columns) * tile_side, (index / columns) * tile_side, tile_side, tile_side);
  return tile & cv::Rect(cv::Point(), size);
}

template <typename Each>
void for_tiles(const cv::Size& size, const Each& each) {
  const int columns = (size.width + tile_side - 1) / tile_side, rows = (size.height + tile_side - 1) / tile_side;
  parallel_rows(columns * rows, 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) each(tile_at(i, size));
  });
}

}  // namespace

Composition compose(const std::vector<ComposedLayer>& layers, const cv::Size& size, CompositionWish wish) {
  Composition result{Rgba(size), wish.flow ? Field(size) : Field(), wish.matte ? Plane(size) : Plane()};
  for_tiles(size, [&](const cv::Rect& tile) {
    TileComposer composer(layers, tile, wish.flow || wish.matte);
    for (int y = tile.y; y < tile.br().y; ++y) {
      composer.compose(y, result.combined[y] + tile.x);
      if (wish.matte) composer.write_matte(result.matte[y] + tile.x);
      if (wish.flow) composer.write_flow(result.flow[y] + tile.x);
    }
  });
  return result;
}

void compose_run(const std::vector<ComposedLayer>& layers, const Run& run, cv::Vec4f* out) {
  TileComposer(layers, cv::Rect(run.x, run.y, run.count, 1), false).compose(run.y, out);
}

void compose_runs(const std::vector<ComposedLayer>& layers, const cv::Size& size,
                  const std::function<void(const Run& run, cv::Vec4f* pixels)>& take) {
  for_tiles(size, [&](const cv::Rect& tile) {
    TileComposer composer(layers, tile, false);
    std::array<cv::Vec4f, tile_side> pixels;
    for (int y = tile.y; y < tile.br().y; ++y) {
      composer.compose(y, pixels.data());
      take({tile.x, y, tile.width}, pixels.data());
    }
  });
}

Rgba compose_alone(const ComposedLayer& layer, const cv::Size& size) {
  return compose({layer}, size, {.flow = false, .matte = false}).combined;
}

}  // namespace stillwater
