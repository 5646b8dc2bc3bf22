// SPDX-License-Identifier: Apache-2.0
// A function defined in the scene text, as plugins see it.
#pragma once
#include <cstdint>
#include <span>

namespace vestige {

/// All numbers from `low` to `high`, which may be infinite.
struct Interval {
  double low = 0, high = 0;
};

/// `function(x, y, z) { x*x + y*y - z }`. Immutable; plugins keep it by shared_ptr.
class Function {
 public:
  virtual ~Function() = default;
  /// Number of arguments.
  virtual int arity() const noexcept = 0;
  /// The value at `args`, arity() numbers [any thread]. Takes bounded time and allocates nothing.
  /// Returns NaN where the expression has no value, as sqrt(-1); a division by zero is infinite.
  virtual double eval(std::span<const double> args) const noexcept = 0;
  /// Eight values at once [any thread]: argument i of evaluation k is args[8 * i + k], its value is
  /// values[k]. The same bits as eval().
  virtual void evalLanes(const double* args, double* values) const noexcept = 0;
  /// An interval that holds every value of the function whose arguments lie in `args`, arity()
  /// intervals [any thread]. NaN is no value. May be wider than necessary.
  virtual Interval bounds(std::span<const Interval> args) const noexcept = 0;
  /// The value at `args` and its partial derivatives, arity() of them [any thread]. Steps, as of
  /// floor(), have the derivative 0; a kink has that of one side.
  virtual double gradient(std::span<const double> args,
                          std::span<double> derivatives) const noexcept = 0;
  /// Equal for functions with the same program.
  virtual std::uint64_t fingerprint() const noexcept = 0;
};

}  // namespace vestige
