#include "layers/matte.h"

#include <algorithm>

#include "core/check.h"
#include "core/error.h"
#include "layers/closed_form.h"

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

}  // namespace

Plane matte(const Rgba& picture, const Trimap& trimap, const MatteOptions& options, Progress progress) {
  check::not_empty("picture", picture);
  check::finite_colours("picture", picture);
  check::same_size("trimap", trimap, "the picture", picture);
  check_trimap(trimap);
  (void)options;
  progress.phase("solving the matte", 1);
  Plane alpha = closed_form_matte(picture, trimap, {}, [&](double share) { progress.at(share); }).alpha;
  for (float& a : alpha) a = std::clamp(a, 0.0f, 1.0f);
  progress.at(1);
  return alpha;
}

}  // namespace stillwater
