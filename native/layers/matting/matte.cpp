#include "layers/matting/matte.h"

#include <algorithm>

#include "core/check.h"
#include "core/error.h"
#include "layers/matting/bayesian.h"
#include "layers/matting/closed_form.h"
#include "layers/matting/coarse_to_fine.h"
#include "layers/matting/colour_prior.h"

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
  check::in_range("at_once", options.at_once, 1, 1e9);
  check::in_range("at_once_scribbled", options.at_once_scribbled, 1, 1e9);
  check::power_of_two("finest", options.finest, 1, 8);
  check::in_range("tolerance", options.tolerance, 1e-12, 1);
}

void take_off_haze(Plane& alpha, float haze) {
  for (float& a : alpha) a = std::clamp((a - haze) / (1 - 2 * haze), 0.0f, 1.0f);
}

Plane closed_form(const Rgba& picture, const Trimap& trimap, const MatteOptions& options, Progress& progress) {
  progress.phase("solving the matte", 1);
  constexpr double comparing = 0.3;  // a share of a level's work
  const SolveLevel solve = [&](const Rgba& image, const Trimap& labels, const Plane& start) {
    // Each level is four times the one before it; the last one ends at 1.
    const double before = static_cast<double>(image.total()) / static_cast<double>(4 * picture.total());
    const auto done = [&](double share) { progress.at(before * (1 + 3 * share)); };
    ClosedFormOptions level{.tolerance = options.tolerance};
    if (options.colour > 0)
      level.prior = colour_prior(image, labels, {.weight = options.colour},
                                 [&](double share) { done(comparing * share); });
    if (!start.empty()) level.start = start;
    const auto solved = [&](double share) { done(comparing + (1 - comparing) * share); };
    Plane alpha = closed_form_matte(image, labels, level, solved).alpha;
    take_off_haze(alpha, static_cast<float>(options.haze));
    return alpha;
  };
  const CoarseToFineOptions steps{
      .at_once = options.at_once, .at_once_scribbled = options.at_once_scribbled, .finest = options.finest};
  return coarse_to_fine(picture, trimap, steps, solve);
}

Plane bayesian(const Rgba& picture, const Trimap& trimap, Progress& progress) {
  progress.phase("solving the matte", 1);
  return bayesian_matte(picture, trimap, {}, [&](double share) { progress.at(share); });
}

}  // namespace

Plane matte(const Rgba& picture, const Trimap& trimap, const MatteOptions& options, Progress progress) {
  check::not_empty("picture", picture);
  check::finite_colours("picture", picture);
  check::same_size("trimap", trimap, "the picture", picture);
  check_trimap(trimap);
  check_options(options);
  if (cv::countNonZero(trimap == known::unknown) == 0) return grey_of(trimap);
  switch (options.method) {
    case MattingMethod::bayesian: return bayesian(picture, trimap, progress);
    case MattingMethod::closed_form: break;
  }
  Plane alpha = closed_form(picture, trimap, options, progress);
  progress.at(1);
  return alpha;
}

}  // namespace stillwater
