#pragma once

#include <string_view>

#include "core/image.h"

/// The one gate for arguments: every public function begins with these. Each throws BadInput with a sentence
/// "NAME: GIVEN is not WHAT IS ALLOWED".
namespace stillwater::check {

void finite(std::string_view name, double value);
void positive(std::string_view name, double value, std::string_view unit = "");
void in_range(std::string_view name, double value, double low, double high, std::string_view unit = "");
void power_of_two(std::string_view name, int value, int low, int high);

/// Both ends finite and further apart than 1e-6 px.
void segment(std::string_view name, const Segment& segment);

/// 1 .. largest_side on both sides.
void size(std::string_view name, int width, int height);
void same_size(std::string_view name, const cv::Mat& image, std::string_view other_name, const cv::Mat& other);
void not_empty(std::string_view name, const cv::Mat& image);

/// Every pixel; the sentence names the first that is not: "NAME[row, column]".
void finite_colours(std::string_view name, const Rgba& image);
void each_in_range(std::string_view name, const Plane& plane, double low, double high);

}  // namespace stillwater::check
