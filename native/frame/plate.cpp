#include "frame/plate.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "layers/cyclic.h"

namespace stillwater {
namespace {

int scaled_side(int side, double scale) { return std::max(1, static_cast<int>(std::lround(side * scale))); }

// The layer on the canvas that its plate covers: its box, or the whole picture along endless axes.
LayerImage on_canvas(const LayerImage& layer, cv::Size picture, double scale, Endless endless) {
  cv::Rect canvas = layer.box;
  if (endless.x || scale < 1) canvas.x = 0, canvas.width = picture.width;
  if (endless.y || scale < 1) canvas.y = 0, canvas.height = picture.height;
  if (canvas == layer.box) return layer;
  LayerImage whole{Rgba::zeros(canvas.size()), canvas};
  layer.pixels.copyTo(whole.pixels(layer.box - canvas.tl()));
  return whole;
}

// The whole canvas made smaller, then cut to what is left of the layer.
LayerImage reduced(const LayerImage& whole, const cv::Rect& layer_box, double scale, Endless endless) {
  Rgba small;
  cv::resize(whole.pixels, small, cv::Size(), scale, scale, cv::INTER_AREA);
  const cv::Rect all(cv::Point(), small.size());
  const auto low = [&](int at) { return static_cast<int>(std::floor(at * scale)) - 3; };
  const auto high = [&](int at) { return static_cast<int>(std::ceil(at * scale)) + 3; };
  cv::Rect box(cv::Point(low(layer_box.x), low(layer_box.y)), cv::Point(high(layer_box.br().x), high(layer_box.br().y)));
  box &= all;
  if (endless.x) box.x = 0, box.width = all.width;
  if (endless.y) box.y = 0, box.height = all.height;
  return {small(box).clone(), box};
}

LayerImage at_plate_scale(const LayerImage& layer, cv::Size picture, double scale, Endless endless) {
  const LayerImage whole = on_canvas(layer, picture, scale, endless);
  if (scale >= 1) return whole;
  const bool vanishes = picture.width * scale < 1 || picture.height * scale < 1;
  if (!vanishes) return reduced(whole, layer.box, scale, endless);
  LayerImage pixel;
  const cv::Size size(scaled_side(picture.width, scale), scaled_side(picture.height, scale));
  cv::resize(whole.pixels, pixel.pixels, size, 0, 0, cv::INTER_AREA);
  pixel.box = cv::Rect(cv::Point(), size);
  return pixel;
}

// At the picture's border a layer goes on, mirrored; elsewhere it ends.
Plate as_plate(const LayerImage& scaled, const cv::Rect& layer_box, cv::Size picture, double output_scale,
               Endless endless) {
  const Rgba& pixels = scaled.pixels;
  const cv::Rect& box = scaled.box;
  const double scale = std::min(1.0, output_scale);
  const cv::Size whole(scaled_side(picture.width, scale), scaled_side(picture.height, scale));
  const Beyond across{endless.x, box.x == 0, box.br().x >= whole.width};
  const Beyond down{endless.y, box.y == 0, box.br().y >= whole.height};
  Plate plate;
  plate.source = Source(endless.x || endless.y ? make_cyclic(pixels, endless.x, endless.y) : pixels, across, down);
  plate.origin = {static_cast<double>(scaled.box.x), static_cast<double>(scaled.box.y)};
  plate.scale = scale;
  plate.output_scale = output_scale;
  plate.box = layer_box;
  plate.endless_x = endless.x;
  plate.endless_y = endless.y;
  plate.picture_width = picture.width;
  return plate;
}

}  // namespace

Plate make_plate(const LayerImage& layer, cv::Size picture, double output_scale, Endless endless) {
  if (layer.box.empty()) return {};
  return as_plate(at_plate_scale(layer, picture, std::min(1.0, output_scale), endless), layer.box, picture, output_scale,
                  endless);
}

Point plate_period(cv::Size picture, double output_scale) {
  const double scale = std::min(1.0, output_scale);
  return {cyclic_period(scaled_side(picture.width, scale)) / scale,
          cyclic_period(scaled_side(picture.height, scale)) / scale};
}

}  // namespace stillwater
