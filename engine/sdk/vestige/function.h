// SPDX-License-Identifier: Apache-2.0
// A function that the scene text defines, as a plugin calls it.
#pragma once
#include <cstdint>
#include <span>

namespace vestige {

/// `function(x, y, z) { x*x + y*y - z }`. Immutable; plugins keep it by shared_ptr.
class Function {
 public:
  virtual ~Function() = default;
  /// How many numbers it takes.
  virtual int arity() const noexcept = 0;
  /// The value at `args`, arity() numbers [any thread]. Takes bounded time and no memory. Not a
  /// number where the expression has no value, as sqrt(-1); a division by zero is infinite.
  virtual double eval(std::span<const double> args) const noexcept = 0;
  /// The same for functions that compute the same in the same way.
  virtual std::uint64_t fingerprint() const noexcept = 0;
};

}  // namespace vestige
