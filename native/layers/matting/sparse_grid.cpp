#include "layers/matting/sparse_grid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace stillwater {

EntryRows::EntryRows(const cv::Mat_<unsigned char>& nodes) {
  cv::copyMakeBorder(nodes, wide_, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::dilate(wide_, wide_, cv::Mat::ones(5, 5, CV_8U), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
}

void EntryRows::find(int y, int first_entry, std::vector<int>& entries) const {
  entries.resize(static_cast<size_t>(wide_.cols));
  const unsigned char* there = wide_[y + 2];
  for (int x = 0; x < wide_.cols; ++x) entries[x] = there[x] ? first_entry++ : -1;
}

int EntryRows::count(int y) const {
  const unsigned char* there = wide_[y + 2];
  return static_cast<int>(std::count_if(there, there + wide_.cols, [](unsigned char value) { return value != 0; }));
}

SparseGrid make_sparse_grid(const cv::Mat_<unsigned char>& nodes) {
  SparseGrid grid{nodes.cols, nodes.rows, {0}, {}, {}, {0}};
  const EntryRows rows(nodes);
  for (int y = -2; y < nodes.rows + 2; ++y) grid.entry_row.push_back(grid.entry_row.back() + rows.count(y));
  const size_t total = static_cast<size_t>(cv::countNonZero(nodes));
  grid.column.reserve(total);
  grid.around.reserve(total);
  std::array<std::vector<int>, 5> near;  // rows y - 2 .. y + 2
  for (int dy = 0; dy < 4; ++dy) rows.find(dy - 2, grid.entry_row[dy], near[dy + 1]);
  for (int y = 0; y < nodes.rows; ++y) {
    std::rotate(near.begin(), near.begin() + 1, near.end());
    rows.find(y + 2, grid.entry_row[y + 4], near[4]);
    for (int x = 0; x < nodes.cols; ++x) {
      if (!nodes(y, x)) continue;
      grid.column.push_back(x);
      grid.around.push_back({near[0][x], near[1][x], near[2][x], near[3][x], near[4][x]});
    }
    grid.row.push_back(grid.nodes());
  }
  return grid;
}

}  // namespace stillwater
