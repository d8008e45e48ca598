#pragma once

#include "core/image.h"
#include "flow/paint_flow.h"

namespace stillwater {

/// The recipe's `refine`.
struct RefineParameters {
  double width = 12;  ///< w_f: sigma of the blur of the picture's directions, px, 0..1000
  double amount = 1;  ///< 0..1: 0 = as painted, 1 = refined
};

/// Turns a painted flow along the picture's own streaks (Okabe et al. 2009, 5.1; METHODS.md 2, "Refinement"):
///
///     I      = luma of the picture, blurred by a Gaussian of 5 x 5 px
///     G      = grad I (Sobel)
///     Psi_o  = the unit vector across G with Psi_o . Phi_o > 0
///     Psi_o <- normalised(Gaussian(w_f) of |G| Psi_o)
///     Psi_s  = (Psi_o . Phi_o) Phi_s
///     flow   = (1 - amount) Phi_o Phi_s + amount Psi_o Psi_s
///
/// The paper's text has Psi_o "parallel to G". A gradient stands across the streaks of water; what runs along them, and what
/// the paper's figures show, is the direction of the edge: that is taken. Where |G| is about 0 nothing is said: directions are
/// weighted by |G|, and Phi_o joins the mean with the weight of a slope of 0.004 a pixel (one step of 8 bits). Where Psi_o
/// ends across Phi_o, or against it, the speed is 0.
///
/// What the painted flow slides along, the refined one does too. From w_f = 6 on the blur runs on a picture made smaller by
/// means of squares, with the mean's own spread taken off w_f: within 1 degree of the full one where the directions' mean is
/// clear.
///
/// `picture`: the painted flow's size, premultiplied. Gives px per frame. Throws BadInput for another size, a colour that is
/// not a finite number, and parameters out of range.
Field refine_flow(const PaintedFlow& painted, const Rgba& picture, const RefineParameters& parameters = {});

}  // namespace stillwater
