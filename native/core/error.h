#pragma once

#include <stdexcept>

/// What the engine throws. Every message names the argument, what was given and what is allowed.
/// bindings/module.cpp translates: BadInput -> ValueError, FileError -> OSError, Cancelled -> stillwater.Cancelled,
/// NotConverged -> stillwater.NotConverged.
namespace stillwater {

struct BadInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled") {}
};

struct NotConverged : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace stillwater
