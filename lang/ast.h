// SPDX-License-Identifier: Apache-2.0
// Expression trees. A name is replaced by its value when it is read, as in POV-Ray: a directive
// between two operands may change the name without changing the tree.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/function.h>

#include "lang/value.h"

namespace vestige::lang {

struct Builtin;  // builtins.h
struct Expr;
using ExprPtr = std::unique_ptr<Expr>;

struct Expr {
  enum class Kind {
    constant,   ///< `value`
    parameter,  ///< number `slot` of the function around it
    unary,      ///< `word`: + - !
    binary,     ///< `word`: * / % + - < <= = >= > != & |
    choose,     ///< args: condition, then, else
    vector,     ///< args: 2 to 5 components
    colour,     ///< `word`: rgb, rgbf, srgb, ..., color; args: one
    channels,   ///< red R green G ...: args in the order of the five, then a colour whose channels
                ///< these replace; null: not given
    member,     ///< `word`: x, red, ...; args: one
    index,      ///< args: an array, then its indices
    builtin,    ///< `function`, args
    invoke,     ///< value: a function; args
  };
  Kind kind = Kind::constant;
  Span span;
  Span wordSpan;  ///< span of the operator, the member or the function's name
  Datum value;
  std::string word;
  int slot = 0;
  int depth = 1;          ///< of the tree
  std::int64_t size = 1;  ///< number of nodes of the tree
  const Builtin* function = nullptr;
  std::vector<ExprPtr> args;

  bool isConstant() const { return kind == Kind::constant; }
  /// Whether an operator can follow: not after a string, a block, a transform or a bare array.
  bool mayCount() const {
    return !isConstant() || isBroken(value) || std::holds_alternative<Numbers>(value);
  }
};

/// `function(a, b) { a*b + 1 }`, or `function { transform { T } }` with three parameters.
struct Function {
  std::vector<const std::string*> parameters;
  ExprPtr body;      ///< null: `transform`
  Affine transform;  ///< gives a vector
  Share bytes = {};
  mutable std::shared_ptr<const vestige::Function> program =
      nullptr;  ///< created when a block uses the function
};

}  // namespace vestige::lang
