#pragma once

#include "layers/matting/colour_samples.h"
#include "layers/matting/matting_laplacian.h"

namespace stillwater {

struct ColourPriorOptions {
  double weight = 1e-3;      ///< on the Laplacian's diagonal, where colours leave no doubt
  double misfit = 4 / 255.;  ///< colour; what a mix lacks of its pixel: confidence falls by e
  double separation = 0.2;   ///< colour; foreground and background nearer to each other than this say less
  double roughness = 1e-3;   ///< alpha squared; what no affine function of colour explains of alpha nearby: falls by e
  double crowd = 0.1;        ///< share of what is around that must be known, of either kind; at half of it trust ends
  ColourSampleOptions samples = {};
};

/// What colour alone says of alpha: the best mix of a known foreground and a known background (sample_colours), and how
/// far that can be trusted: where colours fit, are not alike, come from more than a thin scribble, and give an alpha
/// that follows the picture's colours locally, as the matting Laplacian asks (within 5 x 5 pixels). The confidence of a
/// pixel's samples is an idea of robust and of shared matting (Wang and Cohen 2007, eq. 7; Gastal and Oliveira 2010,
/// 4.3); it pulls the closed form's solution as there. `done` is told how far it is,
/// 0..1.
MattePrior colour_prior(const Rgba& picture, const Trimap& trimap, const ColourPriorOptions& options = {},
                        const std::function<void(double)>& done = [](double) {});

}  // namespace stillwater
