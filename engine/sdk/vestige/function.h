// SPDX-License-Identifier: Apache-2.0
// A function defined in the scene text, as plugins see it.
#pragma once
#include <cstdint>
#include <span>

namespace vestige {

/// `function(x, y, z) { x*x + y*y - z }`. Immutable; plugins keep it by shared_ptr.
class Function {
 public:
  virtual ~Function() = default;
  /// Number of arguments.
  virtual int arity() const noexcept = 0;
  /// The value at `args`, arity() numbers [any thread]. Takes bounded time and allocates nothing.
  /// Returns NaN where the expression has no value, as sqrt(-1); a division by zero is infinite.
  virtual double eval(std::span<const double> args) const noexcept = 0;
  /// Equal for functions with the same program.
  virtual std::uint64_t fingerprint() const noexcept = 0;
};

}  // namespace vestige
