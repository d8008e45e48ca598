#include "appearance/match_histogram.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

/// A value whose bits, as a number, are in the values' order, and the pixel it is of.
struct Entry {
  std::uint32_t key, pixel;
};

std::uint32_t key_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f);  // -0 is 0
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

float value_of(std::uint32_t key) { return std::bit_cast<float>(key & 0x80000000u ? key & 0x7fffffffu : ~key); }

/// Radix sort, 11 bits at a time.
std::vector<Entry> sorted(const Plane& plane) {
  constexpr int digit = 11, digits = 3, size = 1 << digit;
  std::array<std::vector<std::uint32_t>, digits> counts;
  for (auto& count : counts) count.assign(size, 0);
  std::vector<Entry> entries, moved(plane.total());
  entries.reserve(plane.total());
  for (const float value : plane) {
    if (!std::isfinite(value)) throw BadInput("plane: " + std::to_string(value) + " is not a finite number");
    const std::uint32_t key = key_of(value);
    entries.push_back({key, static_cast<std::uint32_t>(entries.size())});
    for (int d = 0; d < digits; ++d) ++counts[d][key >> (d * digit) & (size - 1)];
  }
  for (int d = 0; d < digits; ++d) {
    std::uint32_t place = 0;
    for (std::uint32_t& count : counts[d]) place += std::exchange(count, place);
    for (const Entry& entry : entries) moved[counts[d][entry.key >> (d * digit) & (size - 1)]++] = entry;
    entries.swap(moved);
  }
  return entries;
}

/// Calls `run(first, last)` for each run of equal values.
template <class Run>
void each_run(const std::vector<Entry>& entries, const Run& run) {
  for (size_t first = 0, last; first < entries.size(); first = last) {
    for (last = first + 1; last < entries.size() && entries[last].key == entries[first].key;) ++last;
    run(first, last);
  }
}

float middle_rank(size_t first, size_t last, size_t all) {
  return static_cast<float>(0.5 * static_cast<double>(first + last) / static_cast<double>(all));
}

Histogram thinned(const Histogram& all, int points) {
  Histogram kept;
  size_t next = 0;
  for (int i = 0; i < points; ++i) {
    const float rank = all.ranks.front() + (all.ranks.back() - all.ranks.front()) * static_cast<float>(i) / (points - 1);
    while (next + 1 < all.ranks.size() && all.ranks[next] < rank) ++next;
    if (!kept.ranks.empty() && all.ranks[next] <= kept.ranks.back()) continue;
    kept.values.push_back(all.values[next]);
    kept.ranks.push_back(all.ranks[next]);
  }
  return kept;
}

}  // namespace

Histogram histogram(const Plane& plane, int points) {
  check::not_empty("plane", plane);
  if (points != 0) check::in_range("points", points, 2, 65536);
  const std::vector<Entry> entries = sorted(plane);
  Histogram all;
  each_run(entries, [&](size_t first, size_t last) {
    all.values.push_back(value_of(entries[first].key));
    all.ranks.push_back(middle_rank(first, last, entries.size()));
  });
  return points == 0 || all.values.size() <= static_cast<size_t>(points) ? all : thinned(all, points);
}

Plane match_histogram(const Plane& plane, const Histogram& reference) {
  check::not_empty("plane", plane);
  const std::vector<float>&values = reference.values, &ranks = reference.ranks;
  if (values.empty() || values.size() != ranks.size() || !std::is_sorted(values.begin(), values.end()) ||
      !std::is_sorted(ranks.begin(), ranks.end()))
    throw BadInput("reference: not rising values with as many ranks");
  const std::vector<Entry> entries = sorted(plane);
  Plane matched(plane.size());
  size_t next = 0;
  each_run(entries, [&](size_t first, size_t last) {
    const float rank = middle_rank(first, last, entries.size());
    while (next < ranks.size() && ranks[next] < rank) ++next;
    float value = next == ranks.size() ? values.back() : values[next];
    if (next > 0 && next < ranks.size() && ranks[next] > rank)
      value = values[next - 1] + (values[next] - values[next - 1]) * ((rank - ranks[next - 1]) / (ranks[next] - ranks[next - 1]));
    for (size_t i = first; i < last; ++i) matched[0][entries[i].pixel] = value;
  });
  return matched;
}

Plane match_histogram(const Plane& plane, const Plane& reference) {
  return match_histogram(plane, histogram(reference, 0));
}

}  // namespace stillwater
