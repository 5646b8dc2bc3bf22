// SPDX-License-Identifier: Apache-2.0
// The functions of the language, with POV-Ray's names and results.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "lang/ast.h"
#include "lang/context.h"

namespace vestige::lang {

/// The values of a call's operands.
class Arguments {
 public:
  explicit Arguments(std::span<Operand> operands) : operands_(operands) {}
  std::size_t size() const { return operands_.size(); }
  Datum& operator[](std::size_t i) const { return operands_[i].value; }
  const Span& span(std::size_t i) const { return operands_[i].span; }

 private:
  std::span<Operand> operands_;
};

/// A call whose arguments have been checked against the signature.
struct Call {
  Context& context;
  Span span;  ///< of the whole call
  Arguments args;

  double number(std::size_t i) const { return std::get<Numbers>(args[i]).at(0); }
  Numbers vector(std::size_t i) const { return std::get<Numbers>(args[i]); }
  const std::string& text(std::size_t i) const { return *std::get<TextPtr>(args[i]); }
  /// A truncated number; beyond the range of int, and for nan, INT_MIN, as in POV-Ray.
  int integer(std::size_t i) const;
  /// Reports an error in argument i; returns std::monostate.
  Datum complain(std::size_t i, const std::string& message) const;
  void warn(std::size_t i, const std::string& message) const;
};

struct Builtin {
  const char* name;
  /// One letter per argument: n number, v vector of at most three components (a number is
  /// promoted), c components of anything that has numbers, s string, a array, o object, t the name
  /// of a vector that the call assigns to. Those after '|' may be left out; '+' repeats the last
  /// one any number of times.
  const char* signature;
  Datum (*apply)(const Call&);
  bool isPure = true;  ///< the same arguments give the same result

  // Read from the signature, once.
  std::string letters = {};  ///< of the arguments; the last one may repeat
  std::size_t least = 0;     ///< number of arguments that a call must have
  std::size_t most = 0;      ///< that it may have
  bool takesVectors = false;
  std::size_t needsCommas = 0;  ///< number of arguments behind which a comma cannot be left out

  char letter(std::size_t i) const { return letters[std::min(i, letters.size() - 1)]; }
  /// Whether that many arguments are valid.
  bool fits(std::size_t count) const { return count >= least && count <= most; }
};

/// The built-in of that name, or null. A Name has it already.
const Builtin* findBuiltin(const std::string& name);
inline const Builtin* findBuiltin(const Name& name) { return name.builtin; }
std::vector<std::string> builtinNames();
/// Checks the arguments against the signature and calls.
Datum applyBuiltin(const Builtin& builtin, Context& context, const Span& span,
                   std::span<Operand> operands);

// By subject; each in its own file.
std::vector<Builtin> numberBuiltins();
std::vector<Builtin> vectorBuiltins();
std::vector<Builtin> stringBuiltins();
std::vector<Builtin> timeBuiltins();
std::vector<Builtin> objectBuiltins();

}  // namespace vestige::lang
