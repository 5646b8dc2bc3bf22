// SPDX-License-Identifier: Apache-2.0
// A function of numbers as a flat list of steps on a stack: no tree, no names, no types. It runs on
// plain numbers (program.cpp), on eight at once (lanes.cpp), on intervals (intervals.cpp) and on
// numbers with their derivatives (derivatives.cpp).
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include <vestige/function.h>

#include "lang/share.h"
#include "lang/words.h"

namespace vestige::lang {

class Program final : public vestige::Function {
 public:
  static constexpr int kStack = 256;  ///< numbers that one call may need

  enum class Code : std::uint8_t {
    argument,    ///< pushes argument `index`
    constant,    ///< pushes constant `index`
    inner,       ///< replaces `count` numbers by the value of program `index` there
    skipUnless,  ///< if the top is false: pushes 0 and goes on at step `index`
    skipIf,      ///< if the number below the top is true: the same
    choose,      ///< ?: of three numbers
    plus,
    minus,
    negate,
    times,
    over,
    modulo,  ///< x % y
    invert,
    both,
    either,
    equal,
    notEqual,
    less,
    lessEqual,
    greater,
    greaterEqual,
    abs,
    acos,
    acosh,
    asin,
    asinh,
    atan,
    atan2,
    atanh,
    bitwiseAnd,
    bitwiseOr,
    bitwiseXor,
    ceil,
    cos,
    cosh,
    degrees,
    div,
    exp,
    floor,
    integer,
    ln,
    log,
    max,
    min,
    mod,  ///< mod(x, y)
    pow,
    radians,
    select,
    sin,
    sinh,
    sqrt,
    tan,
    tanh,
    unknown,
  };
  struct Step {
    Code code = Code::unknown;
    std::uint16_t count = 0;  ///< numbers taken from the stack
    std::uint32_t index = 0;
  };

  /// The code of a built-in function; `unknown` if it is not one of numbers.
  static Code codeOf(std::string_view builtin);
  /// The code of an operator between two numbers.
  static Code codeOf(Op op);

  int arity() const noexcept override { return arity_; }
  std::uint64_t fingerprint() const noexcept override { return print_; }
  double eval(std::span<const double> args) const noexcept override {
    Run notes;
    return run(args.data(), notes);
  }
  /// What one evaluation leaves behind besides its value.
  struct Run {
    std::int64_t steps = 0;  ///< that were executed, those of inner programs included
    /// The language has a warning or an error, as for 1/0: the tree must be evaluated to report it.
    bool doubt = false;
  };
  double run(const double* args, Run& notes) const noexcept;

  void evalLanes(const double* args, double* values) const noexcept override;
  Interval bounds(std::span<const Interval> args) const noexcept override;
  double gradient(std::span<const double> args,
                  std::span<double> derivatives) const noexcept override;

  /// Makes the fingerprint of what has been added.
  void finish();

  std::vector<Step> steps;
  std::vector<double> constants;
  std::vector<std::shared_ptr<const Program>> inner;
  Share bytes;  ///< of the steps and constants
  int arity_ = 0;
  int depth = 1;          ///< of programs within programs
  std::int64_t cost = 0;  ///< steps of one evaluation, those of inner programs included

 private:
  std::uint64_t print_ = 0;
};

}  // namespace vestige::lang
