#pragma once

#include <optional>

#include "core/progress.h"
#include "layers/matting/trimap.h"

namespace stillwater {

enum class MattingMethod { closed_form, bayesian };

struct MatteOptions {
  MattingMethod method = MattingMethod::closed_form;
  double colour = 1e-3;           ///< weight of what colour alone says (colour_prior); 0: the plain closed form
  double haze = 0.02;             ///< alpha up to here is 0, and from 1 minus this on 1; between them it is stretched
  int at_once = 400000;           ///< unknown pixels that are solved without a smaller picture first (coarse_to_fine)
  int at_once_scribbled = 60000;  ///< the same where more than three quarters of the picture are unknown
  int finest = 1;                 ///< 1, 2, 4, 8: solved so many times smaller, and enlarged; above 1 a preview
  double tolerance = 5e-4;        ///< alpha; how exactly the closed form is solved
};

/// The matte of what a trimap cuts out of a picture: alpha 0..1, 1 and 0 where the trimap knows. Where nothing is
/// unknown it is the trimap itself.
///
/// The closed form (closed_form_matte) is pulled to what colour says, solved from coarse to fine where much is unknown,
/// and the haze that it leaves is taken off; Bayesian matting (bayesian_matte) is as its paper has it, and knows no
/// options.
///
/// `picture` counts as opaque (its fourth channel is not read). Throws BadInput where sizes differ, a colour is no
/// finite number, or no pixel is foreground, or none background, or an option is out of range; NotConverged; Cancelled.
Plane matte(const Rgba& picture, const Trimap& trimap, const MatteOptions& options = {}, Progress progress = {});

}  // namespace stillwater
