#include "picture/channels.h"

#include <algorithm>
#include <cctype>

namespace stillwater {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool are_colours(const ColourChannels& c) { return c.red >= 0 && c.green >= 0 && c.blue >= 0; }

ColourChannels colours_of_layer(const std::vector<std::string>& names, const std::string& prefix) {
  return {channel_named(names, prefix + "R"), channel_named(names, prefix + "G"), channel_named(names, prefix + "B"),
          channel_named(names, prefix + "A")};
}

}  // namespace

int ColourChannels::first() const {
  const int colours = std::min({red, green, blue});
  return alpha < 0 ? colours : std::min(colours, alpha);
}

int ColourChannels::last() const { return std::max({red, green, blue, alpha}) + 1; }

ColourChannels ColourChannels::shifted(int by) const {
  return {red + by, green + by, blue + by, alpha < 0 ? -1 : alpha + by};
}

int channel_named(const std::vector<std::string>& names, const std::string& name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const std::string& n) { return lower(n) == lower(name); });
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

bool has_plain_colours(const std::vector<std::string>& names) {
  return are_colours(colours_of_layer(names, "")) || channel_named(names, "Y") >= 0;
}

ColourChannels colour_channels(const std::vector<std::string>& names, int alpha_channel) {
  if (const ColourChannels plain = colours_of_layer(names, ""); are_colours(plain)) {
    const int alpha = plain.alpha >= 0 ? plain.alpha : alpha_channel;
    return {plain.red, plain.green, plain.blue, alpha};
  }
  if (const int grey = channel_named(names, "Y"); grey >= 0) return {grey, grey, grey, channel_named(names, "A")};
  for (const std::string& name : names) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) continue;
    if (const ColourChannels layer = colours_of_layer(names, name.substr(0, dot + 1)); are_colours(layer)) return layer;
  }
  const int count = static_cast<int>(names.size());
  const int colours = count - (alpha_channel >= 0 ? 1 : 0);
  if (colours >= 3) return {0, 1, 2, alpha_channel};
  const int grey = alpha_channel == 0 && count > 1 ? 1 : 0;
  return {grey, grey, grey, alpha_channel == grey ? -1 : alpha_channel};
}

}  // namespace stillwater
