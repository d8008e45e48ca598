#include "frame/motions.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

// How far a layer is usually moved by what it follows besides its own water, of the picture's width.
constexpr double moved_share = 1.0 / 24;

std::string place_of(int layer) { return "layers[" + std::to_string(layer) + "]"; }

}  // namespace

Motions::Motions(std::vector<MotionSetup> layers, const View& view, const Wind& wind, cv::Size picture)
    : layers_(std::move(layers)), sways_(layers_.size()), ripples_(layers_.size()), view_(view), picture_(picture) {
  order_layers();
  for (size_t i = 0; i < layers_.size(); ++i) {
    if (const auto* sway = std::get_if<Sway>(&layers_[i].numbers))
      sways_[i] = std::make_unique<SwayMotion>(*sway, wind, picture);
    if (const auto* ripple = std::get_if<Ripple>(&layers_[i].numbers))
      ripples_[i] = std::make_unique<RippleMotion>(*ripple, view, wind, picture, water_region(static_cast<int>(i)));
  }
}

void Motions::order_layers() {
  const int count = static_cast<int>(layers_.size());
  std::vector<int> seen(layers_.size(), 0);  // 1: being looked at, 2: in order_
  const auto visit = [&](const auto& self, int i) -> void {
    if (seen[i] == 2) return;
    if (seen[i] == 1) throw BadInput(place_of(i) + ": depends on itself in a circle");
    seen[i] = 1;
    const bool bobs = std::holds_alternative<Bob>(layers_[i].numbers);
    for (const int needed : {layers_[i].follows, bobs ? layers_[i].water : -1}) {
      if (needed < -1 || needed >= count) throw BadInput(place_of(i) + ": layer " + std::to_string(needed) + " is not there");
      if (needed >= 0) self(self, needed);
    }
    if (bobs && (layers_[i].water < 0 || !std::holds_alternative<Ripple>(layers_[layers_[i].water].numbers)))
      throw BadInput(place_of(i) + ".water: not the index of a ripple layer");
    const auto flows = [&](int layer) {
      const MotionNumbers& numbers = layers_[layer].numbers;
      return std::holds_alternative<Flow>(numbers) || std::holds_alternative<ExampleNow>(numbers);
    };
    if (layers_[i].follows >= 0 && (flows(i) || flows(layers_[i].follows)))
      throw BadInput(place_of(i) + ".follows: a flow neither follows nor is followed");
    seen[i] = 2;
    order_.push_back(i);
  };
  for (int i = 0; i < count; ++i) visit(visit, i);
}

bool Motions::moves(int layer) const {
  const MotionSetup& setup = layers_[layer];
  return !std::holds_alternative<std::monostate>(setup.numbers) || (setup.follows >= 0 && moves(setup.follows));
}

// Where the water's displacement is mostly asked for: under its own layer, those that follow it and those that float on it.
cv::Rect Motions::water_region(int layer) const {
  cv::Rect region = layers_[layer].box;
  for (const MotionSetup& other : layers_) {
    if (other.follows == layer) region |= other.box;
    if (other.water == layer && std::holds_alternative<Bob>(other.numbers)) region |= other.box;
  }
  const int around = cvCeil(moved_share * picture_.width);
  region += cv::Size(2 * around, 2 * around);
  region -= cv::Point(around, around);
  return region & cv::Rect(cv::Point(), picture_);
}

Segment Motions::mirror_axis(int layer) const {
  if (const auto* bob = std::get_if<Bob>(&layers_[layer].numbers)) return fitted_waterline(*bob);
  Point through{picture_.width / 2.0, static_cast<double>(layers_[layer].box.br().y)};
  if (const auto* sway = std::get_if<Sway>(&layers_[layer].numbers)) through = sway->armature.from;
  Point along{1, 0};
  if (view_.horizon) along = {view_.horizon->to.x - view_.horizon->from.x, view_.horizon->to.y - view_.horizon->from.y};
  return {through, {through.x + along.x, through.y + along.y}};
}

namespace {

Placement alone(const std::shared_ptr<const Displacement>& displacement) { return {displacement, nullptr, 0, {}, {}}; }

std::shared_ptr<const Displacement> translation(const Point& by) { return std::make_shared<Translation>(by); }

// Where the first copy is when it goes on from `before`, instead of starting over.
Point going_on(const DriftCopies& copies, const Point& before) {
  const Point way = copies.start_over, moved{copies.first.x - before.x, copies.first.y - before.y};
  const double square = way.x * way.x + way.y * way.y;
  const double turns = square > 0 ? std::nearbyint((moved.x * way.x + moved.y * way.y) / square) : 0;
  return {copies.first.x - turns * way.x, copies.first.y - turns * way.y};
}

}  // namespace

/// The displacements of one moment, layer by layer in the order of their needs.
class MomentOfMotions {
 public:
  /// `before`: placements from which endless layers go on without a jump, or null.
  MomentOfMotions(const Motions& motions, const Moment& moment, const std::vector<MotionNumbers>& numbers,
                  const std::vector<Placement>* before)
      : motions_(motions), moment_(moment), numbers_(numbers), before_(before), placements_(numbers.size()) {}

  std::vector<Placement> all() {
    parallel_rows(static_cast<int>(numbers_.size()), 1, [&](int first, int last) {
      for (int i = first; i < last; ++i)
        if (const auto* sway = std::get_if<Sway>(&numbers_[i]))
          placements_[i] = alone(motions_.sways_[i]->at(moment_, *sway));
    });
    for (const int i : motions_.order_) placements_[i] = after_following(i, own(i));
    return std::move(placements_);
  }

 private:
  Placement own(int i) const {
    if (std::holds_alternative<Sway>(numbers_[i])) return placements_[i];  // they need no other layer: made together
    if (const auto* ripple = std::get_if<Ripple>(&numbers_[i])) return alone(motions_.ripples_[i]->at(moment_, *ripple));
    if (const auto* boat = std::get_if<Bob>(&numbers_[i])) {
      const auto& water = placements_[motions_.layers_[i].water].first;
      return water ? alone(bob(*boat, *water, motions_.picture_)) : Placement{};
    }
    if (const auto* clouds = std::get_if<Drift>(&numbers_[i])) return drifting(i, *clouds);
    return {};
  }

  Placement drifting(int i, const Drift& clouds) const {
    const DriftCopies copies = drift(clouds, moment_, motions_.layers_[i].period);
    if (before_) return alone(translation(going_on(copies, (*before_)[i].drifted)));
    return {translation(copies.first), translation(copies.second), copies.second_share, copies.first,
            copies.second};
  }

  Placement after_following(int i, const Placement& own) const {
    const MotionSetup& setup = motions_.layers_[i];
    if (setup.follows < 0) return own;
    const Placement& leader = placements_[setup.follows];
    const auto followed = [&](const std::shared_ptr<const Displacement>& led) {
      return led && setup.mirror ? mirrored(led, motions_.mirror_axis(setup.follows)) : led;
    };
    Placement both{chained(followed(leader.first), own.first), nullptr, std::max(leader.second_share, own.second_share),
                   {}, {}};
    const Placement& drifting = own.second_share > 0 || leader.second_share <= 0 ? own : leader;
    both.drifted = drifting.drifted, both.second_drifted = drifting.second_drifted;
    if (both.second_share > 0)
      both.second = chained(followed(leader.second_share > 0 ? leader.second : leader.first),
                            own.second_share > 0 ? own.second : own.first);
    return both;
  }

  const Motions& motions_;
  const Moment& moment_;
  const std::vector<MotionNumbers>& numbers_;
  const std::vector<Placement>* before_;
  std::vector<Placement> placements_;
};

void Motions::check(const std::vector<MotionNumbers>& numbers) const {
  if (numbers.size() != layers_.size())
    throw BadInput("states: " + std::to_string(numbers.size()) + " is not one for each of " +
                   std::to_string(layers_.size()) + " layers");
  for (size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i].index() != layers_[i].numbers.index())
      throw BadInput(place_of(static_cast<int>(i)) + ": another kind of motion than it was set up with");
}

std::vector<Placement> Motions::at(const Moment& moment, const std::vector<MotionNumbers>& numbers) const {
  check(numbers);
  return MomentOfMotions(*this, moment, numbers, nullptr).all();
}

std::vector<Travel> Motions::travel(const std::vector<Placement>& now, const Moment& after,
                                    const std::vector<MotionNumbers>& numbers_after) const {
  check(numbers_after);
  const std::vector<Placement> next = MomentOfMotions(*this, after, numbers_after, &now).all();
  std::vector<Travel> travel;
  for (size_t i = 0; i < now.size(); ++i) travel.push_back({now[i].first, next[i].first});
  return travel;
}

}  // namespace stillwater
