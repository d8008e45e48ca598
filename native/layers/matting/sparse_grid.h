#pragma once

#include <array>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// Some of the nodes of a regular grid, row by row, and the layout of vectors over them in which the 5 x 5 neighbours
/// of any node are five contiguous pieces of five entries. Entries of neighbours that are no nodes are always 0.
///
///     nodes      . . A B . . C          a row of a vector      0 0 A B 0 0 C 0 0
///
/// What is done in stripes of rows, every other stripe at once, is the same for any number of threads.
struct SparseGrid {
  int width = 0, height = 0;
  std::vector<int> row;                    ///< height + 1: the first node of each row
  std::vector<int> column;                 ///< x of each node
  std::vector<std::array<int, 5>> around;  ///< entry of (x - 2, y + dy), dy = -2 .. 2
  std::vector<int> entry_row;              ///< height + 5: the first entry of rows -2 .. height + 1

  int nodes() const { return static_cast<int>(column.size()); }
  int entries() const { return entry_row.back(); }
  int entry(int node) const { return around[node][2] + 2; }
};

/// `nodes`: H x W, not 0 where a node is.
SparseGrid make_sparse_grid(const cv::Mat_<unsigned char>& nodes);

/// The entry of each place (x, y) of one row, -1 where it has none; x = -2 .. width + 1 at index x + 2.
class EntryRows {
 public:
  explicit EntryRows(const cv::Mat_<unsigned char>& nodes);
  /// y = -2 .. height + 1.
  void find(int y, int first_entry, std::vector<int>& entries) const;
  int count(int y) const;

 private:
  cv::Mat_<unsigned char> wide_;
};

}  // namespace stillwater
