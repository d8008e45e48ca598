#include "layers/graph_cut_shifts.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace stillwater {
namespace {

using Graph = cv::detail::GCGraph<std::int64_t>;

const std::array<cv::Point, 4> neighbours{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

class Expansion {
 public:
  Expansion(const SeamCost& cost, const Mask& hole, ShiftMap& shifts) : cost_(cost), hole_(hole), shifts_(shifts), node_(hole.size(), -1) {
    cv::findNonZero(hole, pixels_);
    energy_ = seam_energy(cost, hole, shifts);
  }

  // True where the shift took some pixels over.
  bool expand(const cv::Vec2s& shift) {
    const std::vector<cv::Point> movable = movable_to(shift);
    if (movable.empty()) return false;
    Graph graph(static_cast<unsigned>(movable.size()), static_cast<unsigned>(4 * movable.size()));
    for (size_t i = 0; i < movable.size(); ++i) graph.addVtx();
    bool linked = false;
    for (size_t i = 0; i < movable.size(); ++i) linked = describe(graph, static_cast<int>(i), movable[i], shift) || linked;
    const bool taken = linked && cut(graph, movable, shift);
    for (const cv::Point& p : movable) node_(p) = -1;
    return taken;
  }

 private:
  std::vector<cv::Point> movable_to(const cv::Vec2s& shift) {
    std::vector<cv::Point> movable;
    for (const cv::Point& p : pixels_)
      if (shifts_(p) != shift && cost_.may_copy(p, shift)) node_(p) = static_cast<int>(movable.size()), movable.push_back(p);
    return movable;
  }

  // What it costs that a pixel keeps its shift, and that it takes the new one.
  bool describe(Graph& graph, int i, const cv::Point& p, const cv::Vec2s& shift) const {
    std::int64_t keeps = 0, takes = 0;
    bool linked = false;
    for (size_t k = 0; k < neighbours.size(); ++k) {
      const cv::Point q = p + neighbours[k];
      if (!cost_.contains(q)) continue;
      if (node_(q) < 0) {
        keeps += cost_(p, q, shifts_(p), shifts_(q));
        takes += cost_(p, q, shift, shifts_(q));
      } else if (k % 2 == 1) {  // each pair once
        const std::int64_t first_takes = cost_(p, q, shift, shifts_(q)), second_takes = cost_(p, q, shifts_(p), shift);
        const std::int64_t both_keep = std::min<std::int64_t>(cost_(p, q, shifts_(p), shifts_(q)), first_takes + second_takes);
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

  bool cut(Graph& graph, const std::vector<cv::Point>& movable, const cv::Vec2s& shift) {
    graph.maxFlow();
    std::vector<std::pair<cv::Point, cv::Vec2s>> before;
    for (size_t i = 0; i < movable.size(); ++i)
      if (!graph.inSourceSegment(static_cast<int>(i))) before.emplace_back(movable[i], shifts_(movable[i])), shifts_(movable[i]) = shift;
    if (before.empty()) return false;
    const std::int64_t energy = seam_energy(cost_, hole_, shifts_);
    if (energy < energy_) {
      energy_ = energy;
      return true;
    }
    for (const auto& [p, old] : before) shifts_(p) = old;
    return false;
  }

  const SeamCost& cost_;
  const Mask& hole_;
  ShiftMap& shifts_;
  cv::Mat_<int> node_;
  std::vector<cv::Point> pixels_;
  std::int64_t energy_;
};

}  // namespace

void expand_shifts(const SeamCost& cost, const Mask& hole, const std::vector<cv::Vec2s>& candidates, int sweeps, ShiftMap& shifts,
                   const std::function<void(double)>& at) {
  Expansion expansion(cost, hole, shifts);
  int tries = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool moved = false;
    for (const cv::Vec2s& shift : candidates) {
      moved = expansion.expand(shift) || moved;
      if (at) at(++tries / static_cast<double>(sweeps * static_cast<int>(candidates.size())));
    }
    if (!moved) break;
  }
}

std::int64_t seam_energy(const SeamCost& cost, const Mask& hole, const ShiftMap& shifts) {
  std::int64_t sum = 0;
  const cv::Rect box = cv::boundingRect(hole);
  for (int y = box.y; y < box.br().y; ++y)
    for (int x = box.x; x < box.br().x; ++x) {
      if (!hole(y, x)) continue;
      const cv::Point p(x, y);
      for (size_t k = 0; k < neighbours.size(); ++k) {
        const cv::Point q = p + neighbours[k];
        if (!cost.contains(q) || (hole(q) && k % 2 == 0)) continue;
        sum += cost(p, q, shifts(p), shifts(q));
      }
    }
  return sum;
}

}  // namespace stillwater
