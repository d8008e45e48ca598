#pragma once

#include <optional>

#include "core/progress.h"
#include "layers/trimap.h"

namespace stillwater {

enum class MattingMethod { closed_form, bayesian };

struct MatteOptions {
  MattingMethod method = MattingMethod::closed_form;
};

/// The matte of what a trimap cuts out of a picture: alpha 0..1, 1 and 0 where the trimap knows. Where nothing is
/// unknown it is the trimap itself.
///
/// `picture` counts as opaque (its fourth channel is not read). Throws BadInput where sizes differ, a colour is no finite
/// number, or no pixel is foreground, or none background; NotConverged; Cancelled.
Plane matte(const Rgba& picture, const Trimap& trimap, const MatteOptions& options = {}, Progress progress = {});

}  // namespace stillwater
