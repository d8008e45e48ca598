#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"

/// Histograms of a plane's cells, and curves that take one plane's to another's. Cells share their plane: a cell's
/// histogram counts the pixels around its centre, less and less up to the neighbours' centres, and between centres the
/// curves are blended, so that there is no border to see.
///
///     weight in the histogram of cell k   __/\__      curve at a pixel = (1 - share) cell k + share cell k + 1
///                                 centres k-1 k k+1
namespace stillwater {

/// 2^fine bins for each doubling of |x - centre| + floor: equally wide next to the centre, then in proportion, as is right
/// for coefficients, of which most are small and a few are very large. What is beyond the last bin counts as its end.
struct Bins {
  float centre = 0;
  float floor = 1;  ///< a power of two
  int fine = 3;
  int doublings = 12;

  /// For values up to `largest` from the centre, and others four times as large. `even`: as many bins for large values as
  /// for small ones (pixels), else the finer ones by far for the small (bands).
  static Bins of(float centre, float largest, bool even);

  int count() const { return 2 * (doublings << fine); }

  /// The value at a place between the bins' borders, 0 .. count().
  float value(float position) const;
};

/// Where one side's samples lie in the cells. Sample i is the pixel at `i * step`, `side` pixels have `cells` cells; samples
/// beyond the side take the curve of the end that is nearer when the row begins anew, and are not counted.
struct CellAxis {
  CellAxis(int side, int cells, int samples, double step);

  static constexpr int tiles_a_cell = 2;  ///< histograms are counted in tiles, and cells' made of them

  int cells, inside;         ///< samples 0 .. inside - 1 lie within the side
  std::vector<int> tile;     ///< of the samples inside
  std::vector<int> cell;     ///< the one before the sample, at most cells - 2 (0 where there is one)
  std::vector<float> share;  ///< of the cell after it
};

/// A plane in memory: rows `stride` floats apart.
struct Samples {
  float* data;
  int width, height;
  size_t stride;
};

/// What the cells of a plane have, row by row.
struct CellShares {
  std::vector<float> below;    ///< for each cell count() + 1 numbers: the share of the weight below each border of the bins, 0 .. 1
  std::vector<float> samples;  ///< for each cell: the weight of its samples
};

/// `weight`: how much each sample counts, 0 .. 1; empty: all of them fully. It may have less rows and columns, its last ones
/// then go on. Where not all count, each cell counts a few samples of the whole plane too, so that one in which nothing is to
/// be seen has its values from there.
CellShares cell_shares(const Samples& plane, const CellAxis& x, const CellAxis& y, const Bins& bins, const Plane& weight = {});

/// For each cell count() + 1 numbers: what the value at each border becomes, so that shares `from` become shares `to`. Rises,
/// and goes on straight beyond the values that `from` has. Where only
/// one sample lies on another side of one border, which rounding may do, nothing changes.
using CellCurves = std::vector<float>;
CellCurves cell_curves(const CellShares& from, const CellShares& to, const Bins& bins);

/// Each sample by the curves around it; monotone in the sample, straight between the borders.
void apply(const CellCurves& curves, const CellAxis& x, const CellAxis& y, const Bins& bins, const Samples& plane);

}  // namespace stillwater
