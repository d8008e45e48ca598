#include "core/progress.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/error.h"

namespace stillwater {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Progress(Listener listener) : listener_(std::move(listener)) {}

void Progress::phase(const std::string& name, double weight) {
  done_ += weight_;
  weight_ = weight;
  phase_ = name;
  report(0, true);
}

void Progress::at(double share) { report(std::clamp(share, 0.0, 1.0), share >= 1); }

void Progress::report(double share, bool always) {
  if (!listener_) return;
  const double now = seconds_now();
  if (!always && now - last_report_ < 0.1) return;
  last_report_ = now;
  if (!listener_(phase_, std::min(1.0, done_ + share * weight_))) throw Cancelled();
}

}  // namespace stillwater
