#include "frame/frame_renderer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

int output_side(int side, double scale) { return std::max(1, static_cast<int>(std::lround(side * scale))); }

std::vector<MotionNumbers> motion_numbers(const FrameNumbers& frame) {
  std::vector<MotionNumbers> numbers;
  for (const LayerState& state : frame.layers) numbers.push_back(state.motion);
  return numbers;
}

void take_alpha(Rgba& colour, const Rgba& alpha) {
  auto from = alpha.begin();
  for (cv::Vec4f& pixel : colour) pixel[3] = std::clamp((*from++)[0], 0.0f, 1.0f);  // sampling a grey picture overshoots
}

}  // namespace

FrameRenderer::FrameRenderer(const PictureSetup& picture, const std::vector<LayerSetup>& layers) : picture_(picture) {
  check(layers);
  size_ = {output_side(picture.size.width, picture.scale), output_side(picture.size.height, picture.scale)};
  check::size("size of the output", size_.width, size_.height);
  std::vector<MotionSetup> motions;
  for (const LayerSetup& layer : layers)
    motions.push_back({layer.motion, layer.water, layer.follows, layer.mirror, layer.image.box,
                       plate_period(picture.size, picture.scale)});
  motions_ = std::make_unique<Motions>(std::move(motions), picture.view, picture.wind, picture.size);
  for (int i = 0; i < static_cast<int>(layers.size()); ++i) {
    const LayerSetup& setup = layers[i];
    Layer& layer = layers_.emplace_back();
    layer.visible = setup.visible && !setup.image.box.empty();
    layer.moves = motions_->moves(i);
    if (!layer.visible) continue;
    const bool drifting = drifts(layers, i);
    const Endless endless = drifting ? setup.endless : Endless{};
    layer.plate = make_plate(setup.image, picture.size, picture.scale, endless);
    if (picture.has_alpha) layer.alpha_plate = make_plate(setup.alpha, picture.size, picture.scale, endless);
    if (!drifting) continue;
    layer.fade = std::make_unique<CrossFade>(layer.plate);
    if (picture.has_alpha) layer.alpha_fade = std::make_unique<CrossFade>(layer.alpha_plate);
  }
}

void FrameRenderer::check(const std::vector<LayerSetup>& layers) const {
  check::size("picture", picture_.size.width, picture_.size.height);
  check::in_range("scale", picture_.scale, 0.001, 16);
  const cv::Rect whole(cv::Point(), picture_.size);
  for (size_t i = 0; i < layers.size(); ++i)
    for (const LayerImage* image : {&layers[i].image, &layers[i].alpha})
      if ((image->box & whole) != image->box || image->pixels.size() != image->box.size())
        throw BadInput("layers[" + std::to_string(i) + "]: its box does not fit its pixels and the picture");
}

bool FrameRenderer::drifts(const std::vector<LayerSetup>& layers, int layer) const {
  for (; layer >= 0; layer = layers[layer].follows)
    if (std::holds_alternative<Drift>(layers[layer].motion)) return true;
  return false;
}

FrameRenderer::LayerMotions FrameRenderer::motions_of(const std::vector<Placement>& now,
                                                      const std::vector<Travel>& travel, bool of_alpha) const {
  LayerMotions motions;
  for (size_t i = 0; i < layers_.size(); ++i) {
    const Layer& layer = layers_[i];
    const Plate& plate = of_alpha ? layer.alpha_plate : layer.plate;
    const CrossFade* fade = (of_alpha ? layer.alpha_fade : layer.fade).get();
    motions.push_back(fade && now[i].second_share > 0 ? fade->at(plate, now[i], travel[i])
                                                      : displaced_layer(plate, now[i], travel[i]));
  }
  return motions;
}

std::vector<ComposedLayer> FrameRenderer::composed(const LayerMotions& motions, const FrameNumbers& now) const {
  std::vector<ComposedLayer> composed;
  for (size_t i = 0; i < layers_.size(); ++i) {
    const float opacity = layers_[i].visible ? static_cast<float>(now.layers[i].opacity) : 0.0f;
    composed.push_back({motions[i].get(), opacity, layers_[i].moves});
  }
  return composed;
}

Frame FrameRenderer::render(const FrameNumbers& now, const FrameNumbers& after, FrameWish wish) const {
  const std::vector<Placement> placed = motions_->at(now.moment, motion_numbers(now));
  std::vector<Travel> travel(layers_.size());
  if (wish.flow) travel = motions_->travel(placed, after.moment, motion_numbers(after));
  const LayerMotions motions = motions_of(placed, travel, false);
  const std::vector<ComposedLayer> layers = composed(motions, now);
  Composition whole = compose(layers, size_, {wish.flow, wish.matte});
  Frame frame{whole.combined, whole.flow, whole.matte, {}};
  if (wish.layers)
    for (const ComposedLayer& layer : layers)
      frame.layers.push_back(layer.opacity > 0 ? compose_alone(layer, size_) : Rgba());
  if (picture_.has_alpha) add_alpha(frame, motions_of(placed, travel, true), now);
  return frame;
}

// The picture's own alpha is one more grey picture, cut and moved like the colours.
void FrameRenderer::add_alpha(Frame& frame, const LayerMotions& motions, const FrameNumbers& now) const {
  const std::vector<ComposedLayer> layers = composed(motions, now);
  take_alpha(frame.combined, compose(layers, size_, {.flow = false, .matte = false}).combined);
  for (size_t i = 0; i < frame.layers.size(); ++i)
    if (!frame.layers[i].empty()) take_alpha(frame.layers[i], compose_alone(layers[i], size_));
}

}  // namespace stillwater
