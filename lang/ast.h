// SPDX-License-Identifier: Apache-2.0
// An expression as a tree. Names stand in it by the value they had when they were read, as POV-Ray
// has it: a directive between two operands may change a name without changing what was read.
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
    channels,   ///< color red R green G ...: args in the order of the five, null: not given
    member,     ///< `word`: x, red, ...; args: one
    index,      ///< args: an array, then its indices
    builtin,    ///< `function`, args
    invoke,     ///< value: a function; args
  };
  Kind kind = Kind::constant;
  Span span;
  Span wordSpan;  ///< of the operator, the member, the function's name
  Datum value;
  std::string word;
  int slot = 0;
  int depth = 1;  ///< of the tree
  const Builtin* function = nullptr;
  std::vector<ExprPtr> args;

  bool isConstant() const { return kind == Kind::constant; }
  /// Can operators follow? Not after a string, a block, a transform, a bare array.
  bool mayCount() const {
    return !isConstant() || isBroken(value) || std::holds_alternative<Numbers>(value);
  }
};

/// `function(a, b) { a*b + 1 }`, or, of three numbers, `function { transform { T } }`.
struct Function {
  std::vector<const std::string*> parameters;
  ExprPtr body;                                                        ///< null: `transform`
  Affine transform;                                                    ///< gives a vector
  mutable std::shared_ptr<const vestige::Function> program = nullptr;  ///< once a block takes it
};

}  // namespace vestige::lang
