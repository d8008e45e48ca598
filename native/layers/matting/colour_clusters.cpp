#include "layers/matting/colour_clusters.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace stillwater {
namespace {

// The colours first .. last - 1, and how they are spread.
struct Node {
  size_t first, last;
  Eigen::Vector3d mean, direction;
  Eigen::Matrix3d covariance;
  double variance;  // along the principal direction
};

Node spread(const std::vector<WeightedColour>& colours, size_t first, size_t last) {
  Node node{first, last, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), 0};
  double weight = 0;
  for (size_t i = first; i < last; ++i) {
    node.mean += colours[i].weight * colours[i].colour;
    weight += colours[i].weight;
  }
  node.mean /= weight;
  for (size_t i = first; i < last; ++i) {
    const Eigen::Vector3d off = colours[i].colour - node.mean;
    node.covariance += colours[i].weight * off * off.transpose();
  }
  node.covariance /= weight;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(node.covariance);
  node.variance = eigen.eigenvalues()[2];
  node.direction = eigen.eigenvectors().col(2);
  return node;
}

}  // namespace

std::vector<ColourCluster> colour_clusters(std::vector<WeightedColour>& colours, const ClusterOptions& options) {
  const auto weightless = [](const WeightedColour& colour) { return !(colour.weight > 0); };
  colours.erase(std::remove_if(colours.begin(), colours.end(), weightless), colours.end());
  if (colours.empty()) return {};
  std::vector<Node> nodes{spread(colours, 0, colours.size())};
  while (static_cast<int>(nodes.size()) < options.most) {
    const auto widest = std::max_element(nodes.begin(), nodes.end(),
                                         [](const Node& a, const Node& b) { return a.variance < b.variance; });
    if (widest->variance <= options.variance) break;
    const Node whole = *widest;
    const auto below = [&](const WeightedColour& colour) {
      return whole.direction.dot(colour.colour - whole.mean) <= 0;
    };
    const auto begin = colours.begin();
    const auto middle =
        std::stable_partition(begin + static_cast<long>(whole.first), begin + static_cast<long>(whole.last), below);
    const auto split = static_cast<size_t>(middle - begin);
    if (split == whole.first || split == whole.last) break;
    *widest = spread(colours, whole.first, split);
    nodes.push_back(spread(colours, split, whole.last));
  }
  std::vector<ColourCluster> clusters;
  for (const Node& node : nodes)
    clusters.push_back({node.mean, node.covariance + options.noise * Eigen::Matrix3d::Identity()});
  return clusters;
}

}  // namespace stillwater
