#include "layers/inpainting/graph_cut_shifts.h"

#include <algorithm>
#include <array>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <utility>
#include <vector>

namespace stillwater {
namespace {

using Graph = cv::detail::GCGraph<std::int64_t>;

const std::array<cv::Point, 4> neighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

class Expansion {
 public:
  Expansion(const SeamCost& cost, const Mask& hole, int reach, ShiftMap& shifts)
      : cost_(cost), hole_(hole), reach_(reach), shifts_(shifts), node_(hole.size(), -1) {
    cv::findNonZero(hole, pixels_);
  }

  // Before each sweep.
  void look_up_pieces() {
    pieces_.clear();
    if (reach_ == 0) return;
    for (const cv::Point& p : pixels_) pieces_[{shifts_(p)[0], shifts_(p)[1]}].push_back(p);
  }

  // True where the shift took some pixels over.
  bool expand(const cv::Vec2s& shift) {
    const std::vector<cv::Point> movable = movable_to(shift);
    if (movable.empty()) return false;
    Graph graph(static_cast<unsigned>(movable.size()), static_cast<unsigned>(4 * movable.size()));
    for (size_t i = 0; i < movable.size(); ++i) graph.addVtx();
    bool linked = false;
    for (size_t i = 0; i < movable.size(); ++i)
      linked = describe(graph, static_cast<int>(i), movable[i], shift) || linked;
    const bool taken = linked && cut(graph, movable, shift);
    for (const cv::Point& p : movable) node_(p) = -1;
    return taken;
  }

 private:
  std::vector<cv::Point> movable_to(const cv::Vec2s& shift) {
    std::vector<cv::Point> movable;
    const auto take = [&](const cv::Point& p) {
      if (node_(p) < 0 && shifts_(p) != shift && cost_.may_copy(p, shift))
        node_(p) = static_cast<int>(movable.size()), movable.push_back(p);
    };
    if (reach_ == 0) {
      for (const cv::Point& p : pixels_) take(p);
      return movable;
    }
    const auto piece = pieces_.find({shift[0], shift[1]});
    if (piece == pieces_.end()) return movable;
    for (const cv::Point& p : piece->second) {
      if (shifts_(p) != shift || !at_border(p)) continue;
      const cv::Rect near =
          cv::Rect(p.x - reach_, p.y - reach_, 2 * reach_ + 1, 2 * reach_ + 1) & cv::Rect(cv::Point(), hole_.size());
      for (int y = near.y; y < near.br().y; ++y)
        for (int x = near.x; x < near.br().x; ++x)
          if (hole_(y, x)) take({x, y});
    }
    return movable;
  }

  bool at_border(const cv::Point& p) const {
    return std::any_of(neighbours.begin(), neighbours.end(), [&](const cv::Point& step) {
      return cost_.contains(p + step) && hole_(p + step) && shifts_(p + step) != shifts_(p);
    });
  }

  // What it costs that a pixel keeps its shift, and that it takes the new one.
  bool describe(Graph& graph, int i, const cv::Point& p, const cv::Vec2s& shift) const {
    std::int64_t keeps = cost_.far(shifts_(p)), takes = cost_.far(shift);
    bool linked = false;
    for (size_t k = 0; k < neighbours.size(); ++k) {
      const cv::Point q = p + neighbours[k];
      if (!cost_.contains(q)) continue;
      if (node_(q) < 0) {
        keeps += cost_(p, q, shifts_(p), shifts_(q));
        takes += cost_(p, q, shift, shifts_(q));
      } else if (k % 2 == 1) {  // each pair once
        const std::int64_t first_takes = cost_(p, q, shift, shifts_(q)), second_takes = cost_(p, q, shifts_(p), shift);
        const std::int64_t both_keep =
            std::min<std::int64_t>(cost_(p, q, shifts_(p), shifts_(q)), first_takes + second_takes);
        // E = both_keep + (first - keep) x_p + (0 - first) x_q + (first + second - keep) (1 - x_p) x_q
        takes += first_takes - both_keep;
        graph.addTermWeights(node_(q), 0, first_takes);
        graph.addEdges(i, node_(q), first_takes + second_takes - both_keep, 0);
        linked = true;
      }
    }
    graph.addTermWeights(i, takes, keeps);
    return linked;
  }

  // The part of the sum that the movable pixels have a share in.
  std::int64_t energy(const std::vector<cv::Point>& movable) const {
    std::int64_t sum = 0;
    for (const cv::Point& p : movable) {
      sum += cost_.far(shifts_(p));
      for (size_t k = 0; k < neighbours.size(); ++k) {
        const cv::Point q = p + neighbours[k];
        if (cost_.contains(q) && (node_(q) < 0 || k % 2 == 1)) sum += cost_(p, q, shifts_(p), shifts_(q));
      }
    }
    return sum;
  }

  bool cut(Graph& graph, const std::vector<cv::Point>& movable, const cv::Vec2s& shift) {
    const std::int64_t energy_before = energy(movable);
    graph.maxFlow();
    std::vector<std::pair<cv::Point, cv::Vec2s>> before;
    for (size_t i = 0; i < movable.size(); ++i)
      if (!graph.inSourceSegment(static_cast<int>(i)))
        before.emplace_back(movable[i], shifts_(movable[i])), shifts_(movable[i]) = shift;
    if (before.empty()) return false;
    if (energy(movable) < energy_before) return true;
    for (const auto& [p, old] : before) shifts_(p) = old;
    return false;
  }

  const SeamCost& cost_;
  const Mask& hole_;
  int reach_;
  ShiftMap& shifts_;
  cv::Mat_<int> node_;
  std::vector<cv::Point> pixels_;
  std::map<std::pair<int, int>, std::vector<cv::Point>> pieces_;  // of one shift each, as they were before the sweep
};

}  // namespace

void expand_shifts(const SeamCost& cost, const Mask& hole, const std::vector<cv::Vec2s>& candidates,
                   const ExpansionParameters& parameters, ShiftMap& shifts, const std::function<void(double)>& at) {
  Expansion expansion(cost, hole, parameters.reach, shifts);
  std::vector<cv::Vec2s> tried = candidates;
  for (int sweep = 0; sweep < parameters.sweeps && !tried.empty(); ++sweep) {
    expansion.look_up_pieces();
    std::vector<cv::Vec2s> grown;
    for (size_t i = 0; i < tried.size(); ++i) {
      if (expansion.expand(tried[i])) grown.push_back(tried[i]);
      if (at) at((sweep + static_cast<double>(i + 1) / static_cast<double>(tried.size())) / parameters.sweeps);
    }
    tried = grown;
  }
}

}  // namespace stillwater
