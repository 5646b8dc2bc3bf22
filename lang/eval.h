// SPDX-License-Identifier: Apache-2.0
// Evaluates steps of expressions, and the functions that they call.
#pragma once
#include "lang/operations.h"

namespace vestige::lang {

class Evaluator {
 public:
  explicit Evaluator(Context& context) : context_(context), operations_(context) {}

  /// A step whose operands have their values.
  Datum apply(const Operation& o, std::span<Operand> operands) {
    return o.kind == Operation::Kind::invoke ? invoke(o, operands) : operations_.apply(o, operands);
  }
  /// Two plain numbers, the most frequent case: leaves the result in `left`. False: other values.
  bool combine(const Operation& o, Datum& left, const Datum& right) {
    auto* x = std::get_if<Numbers>(&left);
    const Numbers* y = numbers(right);
    if (!x || !y || x->size != 1 || y->size != 1) return false;
    x->v[0] = operations_.applied(o, x->v[0], y->v[0]);
    return true;
  }
  /// The condition of a choice, or nothing if an error was reported.
  std::optional<bool> condition(const Operand& operand);

  /// A tree without parameters.
  Datum evaluate(const Expr& e) { return evaluate(e, {}); }

 private:
  using Arguments = std::span<const double>;  ///< arguments of the enclosing function

  Datum evaluate(const Expr& e, Arguments a);
  Datum choose(const Expr& e, Arguments a);
  Datum series(const Expr& e, Arguments a);
  Datum invoke(const Operation& o, std::span<const Operand> operands);
  Datum call(const Operation& o, const Function& f);

  Context& context_;
  Operations operations_;
  std::vector<double> arguments_;  ///< of the call that is being made
};

}  // namespace vestige::lang
