#include "frame/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "frame/outlined_layer.h"
#include "picture/colour.h"

namespace stillwater {
namespace {

int output_side(int side, double scale) { return std::max(1, static_cast<int>(std::lround(side * scale))); }

std::vector<MotionNumbers> motion_numbers(const FrameNumbers& frame) {
  std::vector<MotionNumbers> numbers;
  for (const LayerState& state : frame.layers) numbers.push_back(state.motion);
  return numbers;
}

cv::Rect box_of(const LayerSetup& layer) { return layer.plates ? layer.plates->box : layer.image.box; }

// Sampling a grey picture overshoots.
void take_alpha(cv::Vec4f& colour, const cv::Vec4f& grey) { colour[3] = std::clamp(grey[0], 0.0f, 1.0f); }

int check_outline(const LayerPlates& plates, int outline) {
  check::in_range("outline", outline, 0, static_cast<double>(plates.outlines.coverage.size()) - 1);
  return outline;
}

void take_alpha(Rgba& colour, const Rgba& alpha) {
  auto from = alpha.begin();
  for (cv::Vec4f& pixel : colour) take_alpha(pixel, *from++);
}

}  // namespace

FrameRenderer::FrameRenderer(const PictureSetup& picture, const std::vector<LayerSetup>& layers) : picture_(picture) {
  check(layers);
  size_ = {output_side(picture.size.width, picture.scale), output_side(picture.size.height, picture.scale)};
  check::size("size of the output", size_.width, size_.height);
  std::vector<MotionSetup> motions;
  for (const LayerSetup& layer : layers)
    motions.push_back({layer.motion, layer.water, layer.follows, layer.mirror, box_of(layer),
                       plate_period(picture.size, picture.scale)});
  motions_ = std::make_unique<Motions>(std::move(motions), picture.view, picture.wind, picture.size);
  for (int i = 0; i < static_cast<int>(layers.size()); ++i) {
    const LayerSetup& setup = layers[i];
    Layer& layer = layers_.emplace_back();
    layer.moves = motions_->moves(i);
    if (!setup.visible || box_of(setup).empty()) continue;
    layer.plates = setup.plates ? setup.plates
                                : make_plates(setup.image, picture.has_alpha ? setup.alpha : LayerImage(), picture.size,
                                              picture.scale, drifting(layers, i));
  }
}

void FrameRenderer::check(const std::vector<LayerSetup>& layers) const {
  check::size("picture", picture_.size.width, picture_.size.height);
  check::in_range("scale", picture_.scale, 0.001, 16);
  const cv::Rect whole(cv::Point(), picture_.size);
  for (int i = 0; i < static_cast<int>(layers.size()); ++i) {
    const std::string place = "layers[" + std::to_string(i) + "]";
    for (const LayerImage* image : {&layers[i].image, &layers[i].alpha})
      if ((image->box & whole) != image->box || image->pixels.size() != image->box.size())
        throw BadInput(place + ": its box does not fit its pixels and the picture");
    if (const LayerPlates* plates = layers[i].plates.get())
      if (plates->picture != picture_.size || plates->output_scale != picture_.scale ||
          plates->alpha.source.empty() == (picture_.has_alpha && !plates->colour.source.empty()) ||
          plates->drifting != drifting(layers, i))
        throw BadInput(place + ".plates: made for another picture, scale or way of drifting");
    const bool flows = layers[i].plates && layers[i].plates->colour_flow;
    if (std::holds_alternative<Flow>(layers[i].motion) && !flows && !box_of(layers[i]).empty())
      throw BadInput(place + ".plates: made without a flow");
    const bool filmed = layers[i].plates && layers[i].plates->colour_example;
    if (std::holds_alternative<ExampleNow>(layers[i].motion) && !filmed && !box_of(layers[i]).empty())
      throw BadInput(place + ".plates: made without a clip");
  }
}

void FrameRenderer::check_layer(int layer) const {
  if (layer < 0 || layer >= static_cast<int>(layers_.size()))
    throw BadInput("layer: " + std::to_string(layer) + " is not between 0 and " + std::to_string(layers_.size() - 1));
}

// Along which axes a layer that drifts, or follows one that does, goes on for ever.
std::optional<Endless> FrameRenderer::drifting(const std::vector<LayerSetup>& layers, int layer) const {
  for (int led = layer; led >= 0 && led < static_cast<int>(layers.size()); led = layers[led].follows)
    if (std::holds_alternative<Drift>(layers[led].motion)) return layers[layer].endless;
  return std::nullopt;
}

FrameRenderer::LayerMotions FrameRenderer::motions_of(const FrameNumbers& now, const std::vector<Placement>& placed,
                                                      const std::vector<Travel>& travel, bool of_alpha) const {
  LayerMotions motions;
  for (size_t i = 0; i < layers_.size(); ++i) {
    static const LayerPlates unseen;
    const LayerPlates& plates = layers_[i].plates ? *layers_[i].plates : unseen;
    const Plate& plate = of_alpha ? plates.alpha : plates.colour;
    const CrossFade* fade = (of_alpha ? plates.alpha_fade : plates.colour_fade).get();
    const FlowingPlate* flowing = (of_alpha ? plates.alpha_flow : plates.colour_flow).get();
    if (const auto* flow = std::get_if<Flow>(&now.layers[i].motion); flow && flowing) {
      check_flow(*flow, flowing->paths().fields());
      motions.push_back(flowing->at(*flow));
    } else if (const auto* example = std::get_if<ExampleNow>(&now.layers[i].motion);
               example && plates.colour_example && !of_alpha && now.layers[i].opacity > 0) {
      motions.push_back(plates.colour_example->at(*example));
    } else {
      motions.push_back(fade && placed[i].second_share > 0 ? fade->at(plate, placed[i], travel[i])
                                                           : displaced_layer(plate, placed[i], travel[i]));
    }
    if (plates.outlines.empty()) continue;
    const Bytes& outline = plates.outlines.coverage[check_outline(plates, now.layers[i].outline)];
    motions.back() = std::make_unique<OutlinedLayer>(std::move(motions.back()), plates.colour, outline);
  }
  return motions;
}

std::vector<ComposedLayer> FrameRenderer::composed(const LayerMotions& motions, const FrameNumbers& now) const {
  std::vector<ComposedLayer> composed;
  for (size_t i = 0; i < layers_.size(); ++i) {
    const float opacity = layers_[i].plates ? static_cast<float>(now.layers[i].opacity) : 0.0f;
    composed.push_back({motions[i].get(), opacity, layers_[i].moves});
  }
  return composed;
}

Frame FrameRenderer::render(const FrameNumbers& now, const FrameNumbers& after, FrameWish wish) const {
  const std::vector<Placement> placed = motions_->at(now.moment, motion_numbers(now));
  std::vector<Travel> travel(layers_.size());
  if (wish.flow) travel = motions_->travel(placed, after.moment, motion_numbers(after));
  const LayerMotions motions = motions_of(now, placed, travel, false);
  const std::vector<ComposedLayer> layers = composed(motions, now);
  Composition whole = compose(layers, size_, {wish.flow, wish.matte});
  Frame frame{whole.combined, whole.flow, whole.matte, {}};
  if (wish.layers)
    for (const ComposedLayer& layer : layers)
      frame.layers.push_back(layer.opacity > 0 ? compose_alone(layer, size_) : Rgba());
  if (picture_.has_alpha) add_alpha(frame, motions_of(now, placed, travel, true), now);
  return frame;
}

// The picture's own alpha is one more grey picture, cut and moved like the colours.
void FrameRenderer::add_alpha(Frame& frame, const LayerMotions& motions, const FrameNumbers& now) const {
  const std::vector<ComposedLayer> layers = composed(motions, now);
  take_alpha(frame.combined, compose(layers, size_, {.flow = false, .matte = false}).combined);
  for (size_t i = 0; i < frame.layers.size(); ++i)
    if (!frame.layers[i].empty()) take_alpha(frame.layers[i], compose_alone(layers[i], size_));
}

void FrameRenderer::render_for_screen(const FrameNumbers& now, ScreenWish wish, float* rgba) const {
  FrameNumbers seen = now;
  if (wish.layer >= 0) {
    check_layer(wish.layer);
    for (int i = 0; i < static_cast<int>(seen.layers.size()); ++i)
      if (i != wish.layer) seen.layers[i].opacity = 0;
  }
  const std::vector<Placement> placed = motions_->at(seen.moment, motion_numbers(seen));
  const std::vector<Travel> nowhere(layers_.size());
  const LayerMotions motions = motions_of(seen, placed, nowhere, false);
  const LayerMotions of_alpha = picture_.has_alpha ? motions_of(seen, placed, nowhere, true) : LayerMotions();
  const std::vector<ComposedLayer> layers = composed(motions, seen);
  const std::vector<ComposedLayer> alpha = picture_.has_alpha ? composed(of_alpha, seen) : layers;
  compose_runs(layers, size_, [&](const Run& run, cv::Vec4f* pixels) {
    if (picture_.has_alpha) {
      std::array<cv::Vec4f, Run::longest> grey;
      compose_run(alpha, run, grey.data());
      for (int i = 0; i < run.count; ++i) take_alpha(pixels[i], grey[i]);
    }
    if (wish.coverage)
      for (int i = 0; i < run.count; ++i) pixels[i] = {pixels[i][3], pixels[i][3], pixels[i][3], 1};
    const size_t row = size_.height - 1 - run.y;
    display_to_screen(pixels->val, rgba + (row * size_.width + run.x) * 4, run.count);
  });
}

void FrameRenderer::move(int layer, const FrameNumbers& now, float* x, float* y, int count) const {
  check_layer(layer);
  const std::shared_ptr<const Displacement> moved = motions_->at(now.moment, motion_numbers(now))[layer].first;
  if (moved) moved->map(x, y, count);
}

}  // namespace stillwater
