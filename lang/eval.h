// SPDX-License-Identifier: Apache-2.0
// The worth of an expression. What makes no sense is reported and gives std::monostate, which every
// further step takes in silence: one complaint for one mistake.
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
  using Arguments = std::span<const double>;  ///< of the function around

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

  /// The numbers of an operand, or null after a complaint that names who wants them.
  const Numbers* wantNumbers(const Datum& d, const Expr& operand, const std::string& who);
  /// A single number, or nothing after a complaint.
  bool wantNumber(const Datum& d, const Expr& operand, const std::string& who, double& x);
  double apply(const std::string& op, double x, double y, const Expr& e);

  Context& context_;
  int depth_ = 0;
};

/// Where A[i][j] lies in the array's data, or nothing after a complaint.
std::optional<std::size_t> elementAt(Context& context, const Array& array,
                                     const std::vector<double>& indices,
                                     const std::vector<Span>& spans);

}  // namespace vestige::lang
