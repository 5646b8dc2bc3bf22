// SPDX-License-Identifier: Apache-2.0
// The steps of expressions on values. A faulty one is reported once and yields std::monostate,
// which later steps accept silently.
#pragma once
#include <optional>
#include <span>

#include "lang/ast.h"
#include "lang/context.h"

namespace vestige::lang {

class Operations {
 public:
  explicit Operations(Context& context) : context_(context) {}

  /// Any step but a constant, a parameter, a choice and the call of a declared function.
  Datum apply(const Operation& o, std::span<Operand> operands);

  /// A single number, or nothing if an error was reported.
  std::optional<double> number(const Operand& operand, const char* role);

  /// A binary operator on two numbers.
  double applied(const Operation& o, double x, double y);

 private:
  Datum unary(const Operation& o, const Operand& operand);
  Datum binary(const Operation& o, const Operand& left, const Operand& right);
  Datum relation(const Operation& o, const TextPtr& left, const Operand& right);
  Datum vector(std::span<const Operand> operands);
  Datum colour(const Operation& o, const Operand& operand);
  Datum channels(const Operation& o, std::span<const Operand> operands);
  Datum member(const Operation& o, const Operand& operand);
  Datum index(const Operation& o, std::span<const Operand> operands);
  Datum entry(const Dictionary& dictionary, const Operand& key);
  Datum spline(const Operation& o, std::span<const Operand> operands);

  /// The numbers of an operand, or null after an error that names the operator.
  const Numbers* numbersOf(const Operand& operand, const char* who);
  Context& context_;
};

/// The position of A[i][j] in the array's data, or nothing if an error was reported.
std::optional<std::size_t> elementAt(Context& context, const Array& array,
                                     const std::vector<double>& indices,
                                     const std::vector<Span>& spans);

}  // namespace vestige::lang
