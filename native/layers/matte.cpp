#include "layers/matte.h"

#include <algorithm>

#include "core/check.h"
#include "core/error.h"
#include "layers/closed_form.h"
#include "layers/colour_prior.h"

namespace stillwater {
namespace {

void check_trimap(const Trimap& trimap) {
  const TrimapCount total = count(trimap);
  const bool nothing = total.foreground == 0 && total.background == 0;
  if (nothing) throw BadInput("trimap: all of it is unknown (some pixels must be foreground, and some background)");
  if (total.unknown == 0) return;
  if (total.foreground == 0) throw BadInput("trimap: no pixel is foreground (some must be)");
  if (total.background == 0) throw BadInput("trimap: no pixel is background (some must be)");
}

void check_options(const MatteOptions& options) {
  check::in_range("colour", options.colour, 0, 1e6);
  check::in_range("haze", options.haze, 0, 0.49);
  check::in_range("tolerance", options.tolerance, 1e-12, 1);
}

Plane closed_form(const Rgba& picture, const Trimap& trimap, const MatteOptions& options, Progress& progress) {
  ClosedFormOptions solve{.tolerance = options.tolerance};
  progress.phase("comparing colours", 0.3);
  if (options.colour > 0) solve.prior = colour_prior(picture, trimap, {.weight = options.colour});
  progress.phase("solving the matte", 0.7);
  return closed_form_matte(picture, trimap, solve, [&](double share) { progress.at(share); }).alpha;
}

void take_off_haze(Plane& alpha, float haze) {
  for (float& a : alpha) a = std::clamp((a - haze) / (1 - 2 * haze), 0.0f, 1.0f);
}

}  // namespace

Plane matte(const Rgba& picture, const Trimap& trimap, const MatteOptions& options, Progress progress) {
  check::not_empty("picture", picture);
  check::finite_colours("picture", picture);
  check::same_size("trimap", trimap, "the picture", picture);
  check_trimap(trimap);
  check_options(options);
  Plane alpha = closed_form(picture, trimap, options, progress);
  take_off_haze(alpha, static_cast<float>(options.haze));
  progress.at(1);
  return alpha;
}

}  // namespace stillwater
