// SPDX-License-Identifier: Apache-2.0
// What an expression is made of. Outside functions it is evaluated while it is read and leaves no
// tree. A name is replaced by its value when it is read, as in POV-Ray: a directive between two
// operands may change the name.
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "lang/names.h"
#include "lang/value.h"

namespace vestige::lang {

class Program;  // program.h
struct Expr;
using ExprPtr = std::unique_ptr<Expr>;

/// A step of an expression, without its operands.
struct Operation {
  enum class Kind : std::uint8_t {
    constant,   ///< a value
    parameter,  ///< a number, parameter `slot` of the function around it
    unary,      ///< `op`: plus, minus, invert
    binary,     ///< `op`
    choose,     ///< operands: condition, then, else
    vector,     ///< operands: 2 to 5 components
    colour,     ///< `word`: rgb, rgbf, srgb, ..., color; operands: one
    channels,   ///< red R green G ...: operands in the order of the five, then a colour whose
                ///< channels these replace; `given`: which there are
    member,     ///< `word`: x, red, ...; operands: one
    index,      ///< operands: an array, then its indices
    builtin,    ///< `name->builtin`
    spline,     ///< `word`: none or a kind; operands: a spline, a time
    series,     ///< `op`: plus, times; operands: from, to, and the body, in which `slot` counts
    invoke,     ///< operands: a function called `name`, then its arguments
  };
  Kind kind = Kind::constant;
  Op op = Op::none;
  Word word = Word::none;
  std::uint8_t given = 0;  ///< a bit for each operand
  std::int32_t slot = 0;
  Span span = {};      ///< operands included
  Span wordSpan = {};  ///< the operator, the member or the function's name
  const Name* name = nullptr;
};

/// An operand with its value, or, inside a function, with its tree.
struct Operand {
  Datum value;
  Span span;
  ExprPtr tree = nullptr;

  /// Whether an operator can follow: not after a string, a block, a transform or a bare array.
  bool mayCount() const {
    return tree || isBroken(value) || std::holds_alternative<Numbers>(value);
  }
};

/// A tree, which only the body of a function needs.
struct Expr {
  Operation operation;
  Datum value;  ///< of a constant
  int depth = 1;
  std::vector<ExprPtr> operands;  ///< null: not given
};

/// `function(a, b) { a*b + 1 }`, or `function { transform { T } }` with three parameters.
struct Function {
  std::vector<const Name*> parameters;
  std::vector<Span> declared = {};  ///< of the parameters; empty unless an observer needs it
  ExprPtr body;                     ///< null: `transform`
  Affine transform;                 ///< gives a vector
  SplinePtr spline = nullptr;       ///< the same, of one argument
  Share bytes = {};
  mutable std::shared_ptr<const Program> program = nullptr;  ///< made at the first use
  mutable bool isTree = false;  ///< it has no program: its expression is not one of numbers
};

}  // namespace vestige::lang
