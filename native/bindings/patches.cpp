#include "bindings/arrays.h"
#include "bindings/rooms.h"
#include "core/check.h"
#include "patches/patch_distance.h"
#include "patches/patch_match.h"
#include "patches/vote.h"

namespace stillwater {
namespace {

using Shorts = py::array_t<std::int16_t, py::array::c_style | py::array::forcecast>;

Mask as_mask(const FloatArray& array, const std::string& name) { return Mask(as_image<float>(array, name) != 0); }

// All patches of the target, with the offsets given (height x width x 2), or none.
MatchField whole_field(const PatchImage& target, const Shorts& offsets, int patch) {
  MatchField field = MatchField::of(centres_that_touch(Mask::ones(target.height(), target.width()), patch));
  if (offsets.ndim() != 3 || offsets.shape(0) != target.height() || offsets.shape(1) != target.width() ||
      offsets.shape(2) != 2)
    throw BadInput("offsets: not height x width x 2 of the target");
  const auto given = offsets.unchecked<3>();
  for (int y = 0; y < field.area.height; ++y)
    for (int x = 0; x < field.area.width; ++x)
      field.offset(y, x) = {given(y + field.area.y, x + field.area.x, 0), given(y + field.area.y, x + field.area.x, 1)};
  return field;
}

py::tuple patch_match_arrays(const FloatArray& target, const FloatArray& source, const FloatArray& centres,
                             const Shorts& offsets, int patch, int rounds, double radius, std::uint64_t seed) {
  const PatchImage to(as_image<cv::Vec4f>(target, "target")), from(as_image<cv::Vec4f>(source, "source"));
  MatchField field = whole_field(to, offsets, patch);
  const Mask allowed = as_mask(centres, "centres") & centres_that_touch(Mask::ones(from.height(), from.width()), patch);
  patch_match(to, from, allowed, field, {.patch = patch, .rounds = rounds, .radius = radius, .seed = seed});
  return py::make_tuple(as_array(field.offset), as_array(field.distance));
}

py::array_t<float> vote_arrays(const FloatArray& target, const FloatArray& source, const Shorts& offsets,
                               const FloatArray& weight, int patch) {
  Rgba voted = as_image<cv::Vec4f>(target, "target").clone();
  const MatchField field = whole_field(PatchImage(voted.size()), offsets, patch);
  vote(field, patch, as_image<float>(weight, "weight")(field.area), as_image<cv::Vec4f>(source, "source"),
       Mask::ones(voted.size()), voted);
  return as_array(voted);
}

}  // namespace

void bind_patches(py::module_& module) {
  module.def("patch_match", &patch_match_arrays, py::arg("target"), py::arg("source"), py::arg("centres"),
             py::arg("offsets"), py::kw_only(), py::arg("patch"), py::arg("rounds"), py::arg("radius") = 0,
             py::arg("seed") = 0);
  module.def("vote", &vote_arrays, py::arg("target"), py::arg("source"), py::arg("offsets"), py::arg("weight"),
             py::kw_only(), py::arg("patch"));
}

}  // namespace stillwater
