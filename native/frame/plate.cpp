#include "frame/plate.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "frame/box_pixels.h"
#include "layers/cyclic.h"
#include "layers/inpainting/cyclic_by_exemplars.h"

namespace stillwater {
namespace {

int scaled_side(int side, double scale) { return std::max(1, static_cast<int>(std::lround(side * scale))); }

// A box made to cover the whole picture (of this size) along some axes.
cv::Rect canvas_of(const cv::Rect& box, cv::Size whole, Endless along) {
  cv::Rect canvas = box;
  if (along.x) canvas.x = 0, canvas.width = whole.width;
  if (along.y) canvas.y = 0, canvas.height = whole.height;
  return canvas;
}

LayerImage on_canvas(const LayerImage& layer, cv::Size whole, Endless along) {
  const cv::Rect canvas = canvas_of(layer.box, whole, along);
  if (canvas == layer.box) return layer;
  LayerImage wide{Rgba::zeros(canvas.size()), canvas};
  layer.pixels.copyTo(wide.pixels(layer.box - canvas.tl()));
  return wide;
}

// The whole picture made smaller, then cut to what is left of the layer.
LayerImage reduced(const LayerImage& whole, const cv::Rect& layer_box, double scale) {
  Rgba small;
  cv::resize(whole.pixels, small, cv::Size(), scale, scale, cv::INTER_AREA);
  const auto low = [&](int at) { return static_cast<int>(std::floor(at * scale)) - 3; };
  const auto high = [&](int at) { return static_cast<int>(std::ceil(at * scale)) + 3; };
  cv::Rect box(cv::Point(low(layer_box.x), low(layer_box.y)), cv::Point(high(layer_box.br().x), high(layer_box.br().y)));
  box &= cv::Rect(cv::Point(), small.size());
  return {small(box).clone(), box};
}

bool vanishes(cv::Size picture, double scale) { return picture.width * scale < 1 || picture.height * scale < 1; }

// Of the whole picture at the scale of its plates, as scaled_layer() makes it.
cv::Size canvas_size(cv::Size picture, double output_scale) {
  if (output_scale >= 1) return picture;
  if (vanishes(picture, output_scale))
    return {scaled_side(picture.width, output_scale), scaled_side(picture.height, output_scale)};
  return {cvRound(picture.width * output_scale), cvRound(picture.height * output_scale)};
}

// At the picture's border a layer goes on, mirrored; elsewhere it ends. `box`: of the pixels before they became
// endless.
Plate as_plate(const Rgba& pixels, const cv::Rect& box, const cv::Rect& layer_box, cv::Size picture,
               double output_scale, Endless endless) {
  const double scale = std::min(1.0, output_scale);
  const cv::Size whole(scaled_side(picture.width, scale), scaled_side(picture.height, scale));
  const Beyond across{endless.x, box.x == 0, box.br().x >= whole.width};
  const Beyond down{endless.y, box.y == 0, box.br().y >= whole.height};
  Plate plate;
  plate.source = Source(pixels, across, down);
  plate.origin = {static_cast<double>(box.x), static_cast<double>(box.y)};
  plate.scale = scale;
  plate.output_scale = output_scale;
  plate.box = layer_box;
  plate.endless_x = endless.x;
  plate.endless_y = endless.y;
  plate.picture_width = picture.width;
  return plate;
}

void check_box(const char* name, const LayerImage& layer, cv::Size picture) {
  const cv::Rect whole(cv::Point(), picture);
  if ((layer.box & whole) != layer.box || layer.pixels.size() != layer.box.size())
    throw BadInput(std::string(name) + ": its box does not fit its pixels and the picture");
}

}  // namespace

LayerImage scaled_layer(const LayerImage& layer, cv::Size picture, double output_scale) {
  if (output_scale >= 1 || layer.box.empty()) return layer;
  const LayerImage whole = on_canvas(layer, picture, {true, true});
  if (!vanishes(picture, output_scale)) return reduced(whole, layer.box, output_scale);
  LayerImage pixel{Rgba(), cv::Rect(cv::Point(), canvas_size(picture, output_scale))};
  cv::resize(whole.pixels, pixel.pixels, pixel.box.size(), 0, 0, cv::INTER_AREA);
  return pixel;
}

namespace {

// Of a layer at the scale of its plates.
EndlessPixels endless_pixels(const LayerImage& scaled, cv::Size picture, double output_scale, Endless along,
                             Progress progress = {}) {
  const Rgba wide = on_canvas(scaled, canvas_size(picture, output_scale), along).pixels;
  const CyclicParameters how{.along_x = along.x, .along_y = along.y, .known = {}};
  const Rgba pixels = along.x || along.y ? make_cyclic_by_exemplars(wide, how, std::move(progress)) : wide;
  const double sigma = CrossFade::mean_sigma_of(picture.width, std::min(1.0, output_scale));
  return {pixels, CrossFade::mean_of(pixels, sigma, along.x, along.y)};
}

void check_made_before(const EndlessPixels& before, const cv::Rect& canvas, Endless along) {
  const cv::Size size(along.x ? cyclic_period(canvas.width) : canvas.width,
                      along.y ? cyclic_period(canvas.height) : canvas.height);
  if (before.pixels.size() != size || before.mean.empty())
    throw BadInput("endless: made for another layer, scale or way of drifting");
}

}  // namespace

EndlessPixels make_endless(const LayerImage& layer, cv::Size picture, double output_scale, Endless along,
                           Progress progress) {
  check_box("layer", layer, picture);
  if (layer.box.empty()) return {};
  return endless_pixels(scaled_layer(layer, picture, output_scale), picture, output_scale, along, std::move(progress));
}

std::shared_ptr<const LayerPlates> make_plates(const LayerImage& colour, const LayerImage& alpha, cv::Size picture,
                                               double output_scale, std::optional<Endless> drifting,
                                               MadeBefore before, const FlowFields& flow,
                                               const ExampleFilm& example, Outlines outlines) {
  check_box("colour", colour, picture);
  check_box("alpha", alpha, picture);
  auto plates = std::make_shared<LayerPlates>();
  plates->box = colour.box;
  plates->picture = picture;
  plates->output_scale = output_scale;
  plates->drifting = drifting;
  const Endless along = drifting.value_or(Endless());
  const auto fill = [&](const LayerImage& layer, const EndlessPixels* made, Plate& plate,
                        std::unique_ptr<const CrossFade>& fade) {
    if (layer.box.empty()) return;
    const LayerImage scaled = scaled_layer(layer, picture, output_scale);
    if (!drifting) {
      plate = as_plate(scaled.pixels, scaled.box, layer.box, picture, output_scale, along);
      return;
    }
    const cv::Rect canvas = canvas_of(scaled.box, canvas_size(picture, output_scale), along);
    if (made) check_made_before(*made, canvas, along);
    const EndlessPixels endless = made ? *made : endless_pixels(scaled, picture, output_scale, along);
    plate = as_plate(endless.pixels, canvas, layer.box, picture, output_scale, along);
    fade = std::make_unique<CrossFade>(plate, endless.mean);
  };
  fill(colour, before.colour, plates->colour, plates->colour_fade);
  fill(alpha, before.alpha, plates->alpha, plates->alpha_fade);
  if (!flow.velocities.empty() && !colour.box.empty()) {
    const auto paths = std::make_shared<const FlowPaths>(scaled_fields(flow.velocities, plates->colour), flow.longest);
    plates->colour_flow = std::make_unique<FlowingPlate>(plates->colour, paths, true);
    if (!alpha.box.empty()) plates->alpha_flow = std::make_unique<FlowingPlate>(plates->alpha, paths, false);
  }
  if (example.setup && !colour.box.empty())
    plates->colour_example = std::make_unique<ExamplePlate>(plates->colour, *example.setup, example.look);
  for (const Bytes& outline : outlines.coverage)
    if (outline.size() != cv::Size(plates->colour.source.width(), plates->colour.source.height()))
      throw BadInput("outlines: made for another layer or scale");
  plates->outlines = std::move(outlines);
  return plates;
}

Point plate_period(cv::Size picture, double output_scale) {
  const double scale = std::min(1.0, output_scale);
  return {cyclic_period(scaled_side(picture.width, scale)) / scale,
          cyclic_period(scaled_side(picture.height, scale)) / scale};
}

}  // namespace stillwater
