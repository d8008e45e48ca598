#pragma once

#include <functional>
#include <string>

/// Progress and cancel: one object that long work is handed, with its phases declared. Only the calling thread
/// reports; `listener` is called at most ten times a second, and once at the end of each phase.
namespace stillwater {

class Progress {
 public:
  /// `listener(phase, share)`: share 0..1 of the whole work. It answers false to cancel.
  using Listener = std::function<bool(const std::string& phase, double share)>;

  /// Reports nothing, never cancels.
  Progress() = default;
  explicit Progress(Listener listener);

  /// Begins a phase that takes `weight` of the work; all weights add up to 1.
  void phase(const std::string& name, double weight);

  /// `share` 0..1 of the current phase is done. Throws Cancelled.
  void at(double share);

 private:
  void report(double share, bool always);

  Listener listener_;
  std::string phase_;
  double done_ = 0, weight_ = 0, last_report_ = -1;
};

}  // namespace stillwater
