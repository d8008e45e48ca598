#include "flow/flow_cycle.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {

double way_at(const Flow& flow, double age) {
  const double at = (age + 0.5) * static_cast<double>(flow.ways.size() - 1);
  const auto left = std::clamp(static_cast<int>(std::floor(at)), 0, static_cast<int>(flow.ways.size()) - 2);
  return flow.ways[left] + (at - left) * (flow.ways[left + 1] - flow.ways[left]);
}

Flow faster(const Flow& flow, int turns) {
  if (turns == 1) return flow;
  Flow fast = flow;
  fast.cycle = flow.cycle * turns - std::floor(flow.cycle * turns);
  const auto last = static_cast<double>(flow.ways.size() - 1);
  for (size_t i = 0; i < flow.ways.size(); ++i)
    fast.ways[i] = way_at(flow, (static_cast<double>(i) / last - 0.5) / turns);
  return fast;
}

void check_flow(const Flow& flow, int fields) {
  check::in_range("flow.cycle", flow.cycle, 0, 1);
  check::finite("flow.step", flow.step);
  check::in_range("flow.next_share", flow.next_share, 0, 1);
  if (flow.ways.size() < 2) throw BadInput("flow.ways: " + std::to_string(flow.ways.size()) + " is not 2 or more");
  for (const double way : flow.ways) check::finite("flow.ways", way);
  for (const int field : {flow.field, flow.next_field})
    if (field < 0 || field >= fields)
      throw BadInput("flow.field: " + std::to_string(field) + " is not the index of one of " + std::to_string(fields) +
                     " fields");
}

}  // namespace stillwater
