// SPDX-License-Identifier: Apache-2.0
// Evaluates expressions. A faulty one is reported once and yields std::monostate, which later steps
// accept silently.
#pragma once
#include <span>

#include "lang/ast.h"
#include "lang/context.h"

namespace vestige::lang {

class Evaluator {
 public:
  explicit Evaluator(Context& context) : context_(context) {}
  Datum evaluate(const Expr& e) { return evaluate(e, {}); }

 private:
  using Arguments = std::span<const double>;  ///< arguments of the enclosing function

  Datum evaluate(const Expr& e, Arguments a);
  Datum unary(const Expr& e, Arguments a);
  Datum binary(const Expr& e, Arguments a);
  Datum choose(const Expr& e, Arguments a);
  Datum vector(const Expr& e, Arguments a);
  Datum colour(const Expr& e, Arguments a);
  Datum channels(const Expr& e, Arguments a);
  Datum member(const Expr& e, Arguments a);
  Datum index(const Expr& e, Arguments a);
  Datum builtin(const Expr& e, Arguments a);
  Datum invoke(const Expr& e, Arguments a);

  /// The numbers of an operand, or null after an error that names the operator.
  const Numbers* wantNumbers(const Datum& d, const Expr& operand, const std::string& who);
  /// A single number, or nothing if an error was reported.
  bool wantNumber(const Datum& d, const Expr& operand, const std::string& who, double& x);
  double apply(const std::string& op, double x, double y, const Expr& e);

  Context& context_;
  int depth_ = 0;
  int calls_ = 0;  ///< of functions in which evaluation is: their nodes are steps
};

/// The position of A[i][j] in the array's data, or nothing if an error was reported.
std::optional<std::size_t> elementAt(Context& context, const Array& array,
                                     const std::vector<double>& indices,
                                     const std::vector<Span>& spans);

}  // namespace vestige::lang
