#pragma once

/// The inner loops of the water in the picture, in plain C that compilers turn into vectors; included by
/// water_displacement.cpp (SSE4.2) and ripple_avx2.cpp.

/// Points that a kernel below takes at most: results stand in arrays of its own until all are known, so that compilers
/// see that no result is read as a coefficient.
enum { water_batch = 64 };

/// Values on nodes one pixel apart, the first one at (x, y) in level coordinates.
struct water_nodes {
  const float* values;
  int stride;
  float x, y, last_column, last_line;
};

/// What RaisedWater knows, in single precision. `kappa_of_height`: cosine / (focal eye).
struct raised_water {
  float centre_x, centre_y, along_x, along_y;
  float horizon, kappa_of_height, up_z, pull, most_kappa;
  struct water_nodes heights, sources;
};

static inline int water_inside(const struct water_nodes n, float x, float y) {
  return (x >= n.x) & (y >= n.y) & (x - n.x < n.last_column) & (y - n.y < n.last_line);
}

/// Linear between the nodes, at the nearest place inside; `down` is the derivative along y.
static inline float water_between(const struct water_nodes n, float x, float y, float* down) {
  float u = x - n.x, v = y - n.y;
  u = u > 0 ? u : 0, v = v > 0 ? v : 0;
  u = u < n.last_column ? u : n.last_column, v = v < n.last_line ? v : n.last_line;
  int i = (int)u, j = (int)v;
  i = i < (int)n.last_column - 1 ? i : (int)n.last_column - 1;
  j = j < (int)n.last_line - 1 ? j : (int)n.last_line - 1;
  u -= (float)i, v -= (float)j;
  const float* __restrict c = n.values;
  const int at = j * n.stride + i;
  const float above = c[at] + u * (c[at + 1] - c[at]);
  const float beneath = c[at + n.stride] + u * (c[at + n.stride + 1] - c[at + n.stride]);
  *down = beneath - above;
  return above + v * (beneath - above);
}

static inline float raised_share(const struct raised_water w, float height, float below) {
  float kappa = height * below * w.kappa_of_height;
  kappa = kappa < w.most_kappa ? kappa : w.most_kappa;
  kappa = kappa > -w.most_kappa ? kappa : -w.most_kappa;
  return kappa / (1 + kappa * w.up_z);
}

/// RaisedWater::map of picture points whose nodes are kept; the others stay and are marked in `left_out`.
static inline void raised_map(const struct raised_water* water, float* px, float* py, int count, int* left_out) {
  const struct raised_water w = *water;
  float to_x[water_batch], to_y[water_batch];
  int out[water_batch];
  for (int i = 0; i < count; ++i) {
    const float x = (px[i] - w.centre_x) * w.along_x + (py[i] - w.centre_y) * w.along_y;
    const float y = (py[i] - w.centre_y) * w.along_x - (px[i] - w.centre_x) * w.along_y;
    const float below = y - w.horizon;
    float down;
    const float share = raised_share(w, water_between(w.heights, x, y, &down), below);
    const int inside = water_inside(w.heights, x, y), wet = below > 0;
    out[i] = wet & !inside;
    const float moved = share * (float)(wet & inside);
    const float dx = -moved * w.up_z * x, dy = -moved * (w.pull + w.up_z * y);
    to_x[i] = px[i] + (dx * w.along_x - dy * w.along_y);
    to_y[i] = py[i] + (dx * w.along_y + dy * w.along_x);
  }
  for (int i = 0; i < count; ++i) px[i] = to_x[i], py[i] = to_y[i], left_out[i] = out[i];
}

/// RaisedWater::unmap, in the same way.
static inline void raised_unmap(const struct raised_water* water, float* px, float* py, int count, int* left_out) {
  const struct raised_water w = *water;
  float to_x[water_batch], to_y[water_batch];
  int out[water_batch];
  for (int i = 0; i < count; ++i) {
    const float x = (px[i] - w.centre_x) * w.along_x + (py[i] - w.centre_y) * w.along_y;
    const float y = (py[i] - w.centre_y) * w.along_x - (px[i] - w.centre_x) * w.along_y;
    float down;
    // Where it comes from along its column, with x along the line to the vanishing point.
    const float column = water_between(w.sources, x, y, &down);
    const float lean = w.up_z * x / (w.pull + w.up_z * y);
    const float from_y = y + column, from_x = x + lean * column;
    // Then one step of Newton's, but for the pixels in which a crest ends: what its two sides show is not related.
    const float below = from_y - w.horizon;
    const float height = water_between(w.heights, from_x, from_y, &down);
    const float missed = column - raised_share(w, height, below) * (w.pull + w.up_z * from_y);
    const float steepness = 1 - (down * below + height) * w.kappa_of_height * w.pull;
    const int smooth =
        (steepness > 0.5f) & (missed < 0.5f) & (missed > -0.5f) & water_inside(w.heights, from_x, from_y);
    const float step = missed / (steepness > 0.5f ? steepness : 0.5f) * (float)smooth;
    const int inside = water_inside(w.sources, x, y), wet = y > w.horizon;
    out[i] = wet & !inside;
    const float dy = (column - step) * (float)(wet & inside), dx = lean * dy;
    to_x[i] = px[i] + (dx * w.along_x - dy * w.along_y);
    to_y[i] = py[i] + (dx * w.along_y + dy * w.along_x);
  }
  for (int i = 0; i < count; ++i) px[i] = to_x[i], py[i] = to_y[i], left_out[i] = out[i];
}

/// A line of raised water: y in the picture of each column of a line at `y`.
static inline void raised_line(const struct raised_water* water, const float* heights, float y, int count,
                               float* to_y) {
  const struct raised_water w = *water;
  const float below = y > w.horizon ? y - w.horizon : 0;
  const float pull = w.pull + w.up_z * y;
  for (int i = 0; i < count; ++i) to_y[i] = y - raised_share(w, heights[i], below) * pull;
}

/// What MirrorWater knows. `pixels`: displacement for a slope of 1, far from the horizon.
struct mirror_water {
  float centre_x, centre_y, along_x, along_y;
  float horizon, pixels, fade;
  struct water_nodes right, away;
};

enum { mirror_rounds = 4 };

/// MirrorWater::unmap (one round, backwards) and map (the fixed point), of picture points whose nodes are kept; the
/// others stay and are marked in `left_out`.
static inline void mirror_move(const struct mirror_water* water, int rounds, float sign, float* px, float* py,
                               int count, int* left_out) {
  const struct mirror_water w = *water;
  float from_x[water_batch], from_y[water_batch], x[water_batch], y[water_batch];
  int out[water_batch];
  for (int i = 0; i < count; ++i) {
    from_x[i] = x[i] = (px[i] - w.centre_x) * w.along_x + (py[i] - w.centre_y) * w.along_y;
    from_y[i] = y[i] = (py[i] - w.centre_y) * w.along_x - (px[i] - w.centre_x) * w.along_y;
    out[i] = 0;
  }
  for (int round = 0; round < rounds; ++round)
    for (int i = 0; i < count; ++i) {
      const float under = y[i] - w.horizon, below = under > 0 ? under : 0;
      const float scale = sign * w.pixels * below / (below + w.fade);
      float down;
      const float dx = scale * water_between(w.right, x[i], y[i], &down);
      const float dy = -scale * water_between(w.away, x[i], y[i], &down);
      out[i] |= (under > 0) & (water_inside(w.right, x[i], y[i]) ^ 1);
      x[i] = from_x[i] + dx, y[i] = from_y[i] + dy;
    }
  for (int i = 0; i < count; ++i) {
    const float moved = (float)!out[i], dx = (x[i] - from_x[i]) * moved, dy = (y[i] - from_y[i]) * moved;
    px[i] += dx * w.along_x - dy * w.along_y;
    py[i] += dx * w.along_y + dy * w.along_x;
    left_out[i] = out[i];
  }
}

/// MirrorWater::unmap of places that are nodes of level water, in the line y (level coordinates); `right` and `away`
/// are their values.
static inline void mirror_row(const struct mirror_water* water, const float* right, const float* away, float y,
                              int count, float* px, float* py) {
  const float under = y - water->horizon, below = under > 0 ? under : 0;
  const float scale = water->pixels * below / (below + water->fade);
  for (int i = 0; i < count; ++i) {
    px[i] -= scale * right[i];
    py[i] += scale * away[i];
  }
}
