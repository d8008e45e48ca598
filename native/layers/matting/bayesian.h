#pragma once

#include <functional>

#include "layers/matting/colour_clusters.h"
#include "layers/matting/trimap.h"

namespace stillwater {

struct BayesianOptions {
  double sigma = 8;            ///< px; of the Gaussian that weights neighbours
  int radius = 12;             ///< px; of the neighbourhood, which grows until it holds `least` colours of each kind
  int least = 20;              ///< colours
  double camera_noise = 0.01;  ///< colour; sigma_C of eq. 5
  int iterations = 50;         ///< of eq. 9 and 10 in turn, at most
  double settled = 1e-4;       ///< alpha; they end when it changes by less
  ClusterOptions clusters = {};
};

/// Bayesian matting (Chuang, Curless, Salesin and Szeliski 2001, "A Bayesian approach to digital matting"): from what
/// is known the unknown region is worked inward, a contour at a time. Around each pixel lie colours of foreground and
/// background, known or found before, weighted by alpha^2 g and (1 - alpha)^2 g (g a Gaussian of their distance); they
/// are clustered, and for each pair of clusters F, B and alpha are found in turn (eq. 9 and 10); the most likely pair
/// stays (eq. 4 to 8).
///
/// `picture` and `trimap` are of one size; the trimap has foreground and background. `done` is told how far it is,
/// 0..1.
Plane bayesian_matte(const Rgba& picture, const Trimap& trimap, const BayesianOptions& options = {},
                     const std::function<void(double)>& done = [](double) {});

}  // namespace stillwater
