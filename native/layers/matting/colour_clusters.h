#pragma once

#include <Eigen/Core>
#include <vector>

namespace stillwater {

struct WeightedColour {
  Eigen::Vector3d colour;
  double weight;
};

/// A Gaussian in colour space.
struct ColourCluster {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;  ///< with the noise's variance on its diagonal
};

struct ClusterOptions {
  double variance = 0.005;  ///< colour squared: a cluster that varies more along some direction is split
  int most = 5;             ///< clusters
  double noise = 1e-4;      ///< colour squared, added to each cluster's covariance
};

/// Weighted colours in clusters (Orchard and Bouman 1991, "Color quantization of images"): again and again the cluster
/// that varies most is split, across its principal direction, through its mean. `colours` is reordered. Colours without
/// weight are left out; none at all give no cluster.
std::vector<ColourCluster> colour_clusters(std::vector<WeightedColour>& colours, const ClusterOptions& options = {});

}  // namespace stillwater
