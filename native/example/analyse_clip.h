#pragma once

#include "core/progress.h"
#include "example/clip_flow.h"
#include "example/half_frames.h"
#include "example/moving_share.h"

namespace stillwater {

struct AnalyseParameters {
  ClipFlow flow = ClipFlow::dense;
  FlowQuality quality = FlowQuality::medium;
};

/// What a clip is made of, beside its residuals.
struct ClipAnalysis {
  Rgb average;     ///< A
  Field velocity;  ///< v, px per frame
  Plane energy;    ///< of the residuals around each place: mean square of their luma
  double reach = 1;      ///< px: how far a residual is alike (exp(-d^2 / 2 reach^2) at the distance d), at least 0.5
  Rgb moving;            ///< moving_shares()
  double explained = 0;  ///< share of the differences' energy that the flow predicts from frame to frame, at most 1
};

/// Takes a clip apart (Okabe et al. 2009, 3; METHODS.md 2, "Analysis of the clip"):
///
///     A = mean F_i,   D_i = F_i - A,   v (clip_flow.h),   r_0 = D_0,   r_i = D_i - W(D_{i-1})
///
/// W(I)(x) is I where the fluid at x was one frame before (flow_map(v, -1), Catmull-Rom, beyond the sides the last pixel repeated), so that
/// D_i is the sum of all r_j, each carried by i - j frames in one map (carried_residuals.h).
///
/// `frames`: display-referred; they become the residuals r, in the same memory: only a few frames are in memory beside it.
/// Throws BadInput as mean_clip_flow(), or where a colour is not finite.
ClipAnalysis analyse_clip(HalfFrames& frames, const AnalyseParameters& parameters = {}, Progress progress = {});

}  // namespace stillwater
