#include "frame/example_layer.h"

#include <array>

#include "flow/streamline.h"

namespace stillwater {

ExampleLayer::ExampleLayer(const ExamplePlate& example, const Plate& plate, const ExampleNow& now)
    : example_(example), plate_(plate), now_(now), still_(displaced_layer(plate, {}, {})), film_(example.film(now)) {}

const cv::Vec4f* ExampleLayer::draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const {
  const cv::Vec4f* still = still_->draw(run, needed, room);
  if (!still) return nullptr;
  SampledRun at(plate_, nullptr, run);
  std::array<cv::Vec4f, Run::longest> colours;
  film_.sample(at.x, at.y, needed, run.count, colours.data());
  for (int i = 0; i < run.count; ++i) {
    if (!needed[i]) continue;
    const float coverage = still[i][3];
    room[i] = {colours[i][0] * coverage, colours[i][1] * coverage, colours[i][2] * coverage, coverage};
  }
  return room;
}

void ExampleLayer::flow(float* x, float* y, int count) const {
  const double scale = plate_.scale / plate_.output_scale;
  const SteadyFlow flow(example_.velocities_[now_.field], SteadyFlow::checked);
  const SteadyFlow next(example_.velocities_[now_.next_field], SteadyFlow::checked);
  for (int i = 0; i < count; ++i) {
    const cv::Vec2d here(x[i] * scale - plate_.origin.x - 0.5, y[i] * scale - plate_.origin.y - 0.5);
    cv::Vec2d there = flow.carried(here, now_.step);
    if (now_.next_share > 0) there += now_.next_share * (next.carried(here, now_.step) - there);
    x[i] = static_cast<float>((there[0] - here[0]) / scale);
    y[i] = static_cast<float>((there[1] - here[1]) / scale);
  }
}

}  // namespace stillwater
