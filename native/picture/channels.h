#pragma once

#include <string>
#include <vector>

/// Which of a file's channels hold what.
namespace stillwater {

/// Indices; a grey picture has the same one three times. alpha is -1 where there is none.
struct ColourChannels {
  int red = 0, green = 0, blue = 0, alpha = -1;

  int first() const;  ///< the range of channels that holds them all
  int last() const;   ///< exclusive
  ColourChannels shifted(int by) const;
};

/// True where the names hold R, G and B, or Y, without a layer's name.
bool has_plain_colours(const std::vector<std::string>& names);

/// R, G, B (A) without a layer's name, else those of the first layer that has them (NAME.R, ...), else grey (Y, A or
/// the only channel), else the first three channels. `alpha_channel`: the format's own word, or -1.
ColourChannels colour_channels(const std::vector<std::string>& names, int alpha_channel);

/// The index of a channel, capitals or not, or -1.
int channel_named(const std::vector<std::string>& names, const std::string& name);

}  // namespace stillwater
