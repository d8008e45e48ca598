#include "layers/peel.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "layers/push_pull.h"

namespace stillwater {
namespace {

// A matte goes on behind what hides it where it is likely; what is left of it further away fades out.
float without_tail(float likely) {
  constexpr float unlikely = 0.25f;
  return likely < 2 * unlikely ? std::max(0.0f, 2 * (likely - unlikely)) : likely;
}

// A copy, of the picture's size.
Plane whole_matte(const std::variant<Plane, MatteInBox>& matte, const cv::Size& picture) {
  if (const Plane* whole = std::get_if<Plane>(&matte)) return whole->clone();
  const auto& [pixels, box] = std::get<MatteInBox>(matte);
  Plane whole = Plane::zeros(picture);
  if (!box.empty()) pixels.copyTo(whole(box));
  return whole;
}

Plane softened(const Plane& matte, double feather) {
  if (feather < 1e-6) return matte;  // of a narrower Gaussian OpenCV can't make a kernel
  Plane soft;
  cv::GaussianBlur(matte, soft, cv::Size(), feather / 2, feather / 2, cv::BORDER_REPLICATE);
  return soft;
}

// The matte goes on behind what hides it.
void complete(Plane& matte, const Plane& hidden) {
  const cv::Rect box = surroundings(hidden);
  if (box.empty()) return;
  Plane part = matte(box);
  const Plane cover = hidden(box);
  cv::Mat_<cv::Vec2f> known(part.size());
  parallel_pixels(part.size(), [&](int y, int x) {
    const float share = purity(cover(y, x));
    known(y, x) = {part(y, x) * share, share};
  });
  if (std::all_of(known.begin(), known.end(), [](const cv::Vec2f& pixel) { return pixel[1] <= 0; })) return;
  fill_by_push_pull(known);
  parallel_pixels(part.size(), [&](int y, int x) {
    if (cover(y, x) > 0) part(y, x) = std::clamp(std::max(part(y, x), without_tail(known(y, x)[0])), 0.0f, 1.0f);
  });
}

// Two clear pixels on each side that is not the picture's: so that the layer's edge does not repeat there.
LayerImage with_clear_sides(const LayerImage& layer, const cv::Size& picture) {
  const cv::Rect wider = cv::Rect(layer.box.x - 2, layer.box.y - 2, layer.box.width + 4, layer.box.height + 4) &
                         cv::Rect(cv::Point(), picture);
  LayerImage result{Rgba::zeros(wider.size()), wider};
  layer.pixels.copyTo(result.pixels(layer.box - wider.tl()));
  return result;
}

void check_box(const std::string& name, const cv::Mat& pixels, const cv::Rect& box, const Rgba& picture) {
  if ((box & cv::Rect(cv::Point(), picture.size())) != box || pixels.size() != box.size())
    throw BadInput(name + ": its box does not fit its pixels and the picture");
}

void check_matte(const std::string& name, const std::variant<Plane, MatteInBox>& matte, const Rgba& picture) {
  if (const Plane* whole = std::get_if<Plane>(&matte)) return check::same_size(name, *whole, "the picture", picture);
  const auto& [pixels, box] = std::get<MatteInBox>(matte);
  check_box(name, pixels, box, picture);
}

void check_layer(const std::string& name, const PeelLayer& layer, const Rgba& picture) {
  check::in_range(name + ".feather", layer.feather, 0, 1000, "px");
  if (layer.matte) check_matte(name + ".matte", *layer.matte, picture);
  if (const Rgba* painted = std::get_if<Rgba>(&layer.fill)) check::same_size(name + ".fill", *painted, "the picture", picture);
}

std::string place_of(size_t index) { return "layers[" + std::to_string(index) + "]"; }

void check_layers(const Rgba& picture, const std::vector<PeelLayer>& layers) {
  for (size_t i = 0; i < layers.size(); ++i) {
    check_layer(place_of(i), layers[i], picture);
    if (!layers[i].matte && i + 1 < layers.size())
      throw BadInput(place_of(i) + ".matte: missing (only the last layer needs none)");
  }
}

}  // namespace

Peeling::Peeling(const Rgba& picture) {
  check::not_empty("picture", picture);
  left_ = picture.clone();
  for (cv::Vec4f& pixel : left_) pixel[3] = 1;
  hidden_ = Plane::zeros(picture.size());
  solid_ = Plane::ones(picture.size());
}

Peeling::Taken Peeling::take(const PeelLayer& layer, std::string_view name, Progress progress) {
  check_layer(std::string(name), layer, left_);
  if (!layer.matte) throw BadInput(std::string(name) + ".matte: missing");
  Plane matte = softened(whole_matte(*layer.matte, left_.size()), layer.feather);
  complete(matte, hidden_);
  matte = cv::max(0.0, cv::min(1.0, matte));  // blurring rounds
  const cv::Rect box = cv::boundingRect(matte > 0);
  if (box.empty()) return {};
  const Uncovered colours = uncover(left_, matte, hidden_, layer.fill, std::move(progress));
  const Fill* fill = std::get_if<Fill>(&layer.fill);
  const bool open = fill != nullptr && *fill == Fill::none;
  const Rgba back = colours.back(box - colours.box.tl()).clone();
  Taken taken{cut(colours.front, matte, colours.box), {back, matte(box).clone(), box, open}};
  leave(taken.behind);
  return taken;
}

void Peeling::leave(const Behind& behind) {
  check_box("behind", behind.colour, behind.box, left_);
  check_box("behind", behind.matte, behind.box, left_);
  if (behind.box.empty()) return;
  behind.colour.copyTo(left_(behind.box));
  Plane hidden = hidden_(behind.box), solid = solid_(behind.box);
  parallel_pixels(behind.box.size(), [&](int y, int x) {
    const float a = behind.matte(y, x);
    hidden(y, x) = std::max(hidden(y, x), a);
    if (behind.open && a >= 1) solid(y, x) = 0;
  });
}

LayerImage Peeling::rest() const { return cut(left_, Plane::ones(left_.size()), cv::Rect(0, 0, left_.cols, left_.rows)); }

// `front`, which covers `box`, times the matte, in the box of the matte.
LayerImage Peeling::cut(const Rgba& front, const Plane& matte, const cv::Rect& box) const {
  const Plane cover = matte(box).mul(solid_(box));
  const cv::Rect inner = cv::boundingRect(cover > 0);
  if (inner.empty()) return {};
  Rgba pixels(inner.size());
  parallel_pixels(inner.size(), [&](int y, int x) {
    const float a = cover(y + inner.y, x + inner.x);
    const cv::Vec4f& f = front(y + inner.y, x + inner.x);
    pixels(y, x) = {a * f[0], a * f[1], a * f[2], a};
  });
  return with_clear_sides({pixels, inner + box.tl()}, matte.size());
}

std::vector<LayerImage> peel(const Rgba& picture, const std::vector<PeelLayer>& layers, Progress progress) {
  check_layers(picture, layers);
  Peeling peeling(picture);
  std::vector<LayerImage> taken;
  progress.phase("cutting the layers", 1);
  for (size_t i = 0; i < layers.size(); ++i) {
    taken.push_back(layers[i].matte ? peeling.take(layers[i], place_of(i)).layer : peeling.rest());
    progress.at(static_cast<double>(taken.size()) / static_cast<double>(layers.size()));
  }
  return taken;
}

}  // namespace stillwater
