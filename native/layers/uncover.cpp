#include "layers/uncover.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/parallel.h"
#include "layers/matting/foreground.h"
#include "layers/push_pull.h"

namespace stillwater {
namespace {

// A hole is filled from what lies at least so far from the matte, px: mattes end a little inside of what they cut out.
constexpr int fringe = 3;
// What a fringe still says where nothing better is near.
constexpr float fringe_share = 1e-3f;
// Something solid is what is covered so far somewhere; all that hangs together with it is filled from this coverage on.
constexpr float solid = 0.5f, covered = 0.1f;
// So much of what does not fit may lie in the layer, as it is seen (colour times coverage), before the background shares it.
constexpr float borne = 0.06f;

// 1 at most so many pixels away from the true pixels of a mask, else 0.
Plane grown(const cv::Mat& mask, double pixels) {
  Plane distance, near;
  cv::distanceTransform(~mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat(distance <= pixels).convertTo(near, CV_32F, 1 / 255.0);
  return near;
}

bool any(const cv::Mat& region) { return cv::countNonZero(region) > 0; }

void split_remainder(const Rgba& picture, const Plane& matte, Uncovered& colours) {
  parallel_pixels(picture.size(), [&](int y, int x) {
    const float a = matte(y, x);
    const cv::Vec4f& p = picture(y, x);
    cv::Vec4f &front = colours.front(y, x), &back = colours.back(y, x);
    if (a >= 1) front = p;
    if (a <= 0) back = p;
    const cv::Vec4f share = (p - a * front - (1 - a) * back) * (1 / (a * a + (1 - a) * (1 - a)));
    if (a < 1) front += a * share;
    if (a > 0) back += (1 - a) * share;
  });
}

// What the matte alone says of both: the picture itself where it has no soft edge.
Uncovered mixed_from(const Rgba& picture, const Plane& matte, const cv::Rect& box, Progress& progress) {
  Uncovered colours{picture.clone(), picture.clone(), box};
  if (!any((matte > 0) & (matte < 1))) return colours;
  const auto [front, back] = foreground_and_background(picture, matte, {}, progress);
  colours.front = front;
  colours.back = back;
  split_remainder(picture, matte, colours);
  return colours;
}

// The front takes what does not fit, as far as that is hardly seen in it.
void bear(const Rgba& picture, const Plane& matte, Uncovered& colours) {
  parallel_pixels(picture.size(), [&](int y, int x) {
    const float a = matte(y, x);
    if (a <= 0 || a >= 1) return;
    cv::Vec4f& front = colours.front(y, x);
    const cv::Vec4f amiss = picture(y, x) - a * front - (1 - a) * colours.back(y, x);
    for (int c = 0; c < 3; ++c) {
      const float taken = front[c] + std::clamp(amiss[c], -borne, borne) / a;
      front[c] = std::clamp(taken, std::min(0.0f, front[c]), std::max(1.0f, front[c]));
    }
  });
}

// What a layer covers of which some is solid, all else of it being a veil.
cv::Mat solid_parts(const Plane& matte) {
  cv::Mat labels;
  const int count = cv::connectedComponents(matte > covered, labels, 8, CV_32S);
  std::vector<unsigned char> is_solid(count, 0);
  for (int y = 0; y < matte.rows; ++y)
    for (int x = 0; x < matte.cols; ++x)
      if (matte(y, x) > solid) is_solid[labels.at<int>(y, x)] = 255;
  cv::Mat parts(matte.size(), CV_8U);
  parallel_pixels(matte.size(), [&](int y, int x) { parts.at<unsigned char>(y, x) = is_solid[labels.at<int>(y, x)]; });
  return parts;
}

// Smoothly, from where the background is seen pure.
Rgba smooth_filling(const Rgba& seen, const Plane& matte) {
  Plane wide;
  cv::dilate(matte, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * fringe + 1, 2 * fringe + 1)));
  Rgba known(seen.size());
  parallel_pixels(seen.size(), [&](int y, int x) {
    const float share = std::max(purity(wide(y, x)), fringe_share * purity(matte(y, x)));
    const cv::Vec4f& pixel = seen(y, x);
    known(y, x) = {pixel[0] * share, pixel[1] * share, pixel[2] * share, share};
  });
  const bool nothing = std::all_of(known.begin(), known.end(), [](const cv::Vec4f& pixel) { return pixel[3] <= 0; });
  if (nothing) return seen.clone();
  fill_by_push_pull(known);
  return known;
}

// Whether a whole patch lies somewhere in `source` and off what is closed.
bool any_patch(const Plane& source, const Plane& closed, int patch) {
  cv::Mat centres;
  cv::erode((source >= 0.5f) & (closed < 0.5f), centres, cv::Mat::ones(patch, patch, CV_8U), {-1, -1}, 1,
            cv::BORDER_CONSTANT, cv::Scalar(0));
  return any(centres);
}

// Where patches may come from: what the search allows, and of that what no layer hides or has hidden, where there is
// any. Nothing where the search allows all, and yet no patch is whole.
std::optional<Plane> source_of(const InpaintParameters& search, const Plane& matte, const Plane& hidden, const Plane& hole) {
  const Plane allowed = search.source ? *search.source : Plane::ones(hole.size());
  const Plane closed = grown(hole >= 0.5f, search.grow);
  Plane never_hidden = allowed.clone();
  never_hidden.setTo(0, (hidden > 0) | (matte > 0));
  if (any_patch(never_hidden, closed, search.patch)) return never_hidden;
  if (search.source || any_patch(allowed, closed, search.patch)) return allowed;
  return std::nullopt;
}

// The largest odd side, at most `wanted`, that fits into both sides of a picture.
int fitting_patch(int wanted, const cv::Size& size) {
  const int side = std::min(size.width, size.height);
  return std::min(wanted, side - (side % 2 == 0));
}

void touch_up(const TouchUp& place, const Plane& hole, const InpaintParameters& search, Rgba& filling, const Progress& progress) {
  Plane region = place.region.clone();
  region.setTo(0, hole < 0.5f);
  if (!any(region >= 0.5f)) return;
  InpaintParameters again = search;
  again.radius = place.radius;
  again.seed = place.seed;
  again.source->setTo(0, grown(hole >= 0.5f, search.grow) >= 0.5f);
  filling = inpaint(filling, region, again, progress);
}

// `known`: what is left of the picture, and behind veils what is seen through them; of the picture's size. Filled where
// something solid is, and around it.
Rgba exemplar_filling(const Rgba& known, const Plane& matte, const Plane& hidden, const cv::Mat& solid_part,
                      const ExemplarFill& fill, const Progress& progress) {
  const Plane hole = grown(solid_part, fringe);
  if (!any(hole >= 0.5f)) return known;
  InpaintParameters search = fill.search;
  search.patch = fitting_patch(search.patch, known.size());
  if (search.patch < 3 || !any(hole < 0.5f)) return smooth_filling(known, matte);
  search.source = source_of(search, matte, hidden, hole);
  if (!search.source) return smooth_filling(known, matte);
  Rgba filling = inpaint(known, hole, search, progress);
  for (const TouchUp& place : fill.touch_ups) touch_up(place, hole, search, filling, progress);
  return filling;
}

Rgba painted_filling(const Rgba& painted, const cv::Rect& box) {
  Rgba filling = painted(box).clone();
  for (cv::Vec4f& pixel : filling) pixel[3] = 1;
  return filling;
}

// In `box`. `seen`: the background as the matte alone says it.
Rgba filling_in(const cv::Rect& box, const Rgba& left, const Plane& matte, const Plane& hidden, const Rgba& seen,
                const Filling& filling, const Progress& progress) {
  if (const Rgba* painted = std::get_if<Rgba>(&filling)) return painted_filling(*painted, box);
  const ExemplarFill* exemplar = std::get_if<ExemplarFill>(&filling);
  if (exemplar == nullptr && std::get<Fill>(filling) == Fill::none) return seen;
  const cv::Mat parts = solid_parts(matte);
  const cv::Mat veil = any(parts) ? cv::Mat((matte > covered) & ~(grown(parts, fringe) > 0)) : cv::Mat(matte > 0);
  Rgba known = left.clone();
  seen.copyTo(known(box), veil(box));
  return exemplar ? exemplar_filling(known, matte, hidden, parts, *exemplar, progress)(box)
                  : smooth_filling(known(box), matte(box));
}

}  // namespace

Uncovered uncover(const Rgba& left, const Plane& matte, const Plane& hidden, const Filling& filling, Progress progress) {
  check::same_size("matte", matte, "the picture", left);
  check::same_size("hidden", hidden, "the picture", left);
  const cv::Rect box = surroundings(matte);
  const Rgba picture = left(box);
  const Plane part = matte(box);
  Uncovered colours = mixed_from(picture, part, box, progress);
  colours.back = filling_in(box, left, matte, hidden, colours.back, filling, progress);
  bear(picture, part, colours);
  split_remainder(picture, part, colours);
  return colours;
}

}  // namespace stillwater
