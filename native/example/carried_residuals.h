#pragma once

#include <vector>

#include "example/half_frames.h"
#include "example/source_map.h"
#include "flow/streamlines.h"
#include "layers/sampling.h"

namespace stillwater {

/// The recipe's `example`, resolved: everything that a frame reads.
struct ExampleNow {
  double moment = 0;  ///< steps of the clip since its beginning
  double step = 0;    ///< to the next frame
  int field = 0, next_field = 0;  ///< which of the layer's flows
  double next_share = 0;          ///< 0..1, of the second one
};

/// Throws BadInput for numbers that are not finite or out of range, or a field that is not there.
void check_example(const ExampleNow& now, int fields);

/// Which residual comes at each step of a film, steps counted from the film's beginning.
struct ResidualSequence {
  bool endless = true;  ///< after the last one comes the first again; else there is none before the first and after the last
  int period = 0;       ///< steps after which an endless one begins anew; 0: as many as there are

  /// Index of a residual of `count`, or -1 where none comes. An endless sequence leaves out r_0, which is a whole frame. A
  /// period longer than the clip takes it several times, each time from another place on.
  int at(int step, int count) const;
};

/// The differences from the average as a sum of residuals, each carried along the flow since it came (Okabe et al. 2009, 3):
///
///     D'(s) = sum over steps k of a(s - k) W^(s-k) (R_k),      a(t) = 0 for t <= -1, 1 + t up to 0, then 1 .. 0 at `life`
///
/// for any moment s, also between two steps. Every moment stands alone. W^t is one map along the streamlines, R_k a residual
/// laid on the picture (SourceMap).
///
/// `fade`: over which share of the life a residual goes: 0 all at once at its end, as published. What is cut off so leaves
/// the frame of `life` steps ago in the film, carried and of opposite sign, as strong as the frame itself; gone slowly, it is
/// a mean of many frames, and hardly seen.
class CarriedResiduals {
 public:
  struct Parameters {
    int life = 16;      ///< steps, 1..1000
    double fade = 0.5;  ///< 0..1
    ResidualSequence sequence;
    Beyond beyond;  ///< how residuals go on beyond the picture's sides, where the fluid comes in: mirrored, so that it is lively
  };

  /// `residuals` (of which the memory must stay) and `map` as they fit together; `velocities`: the flows between which the
  /// film changes, at least one, of the map's size, its px per step. Throws BadInput where a size or number is not so.
  CarriedResiduals(HalfFrames residuals, SourceMap map, const std::vector<Field>& velocities, const Parameters& parameters);

  cv::Size size() const { return map_.size(); }
  const SourceMap& map() const { return map_; }
  int fields() const { return static_cast<int>(lines_.size()); }
  const Parameters& parameters() const { return parameters_; }
  int residuals() const { return residuals_.count(); }

  /// Throws BadInput as check_example().
  Rgb at(const ExampleNow& now) const;

 private:
  double share(double age) const;
  void add(int residual, double age, float share, const ExampleNow& now, Rgb& sum) const;

  HalfFrames residuals_;
  SourceMap map_;
  Parameters parameters_;
  std::vector<Streamlines> lines_;
};

}  // namespace stillwater
