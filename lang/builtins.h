// SPDX-License-Identifier: Apache-2.0
// The functions of the language, with POV-Ray's names and results.
#pragma once
#include <string>
#include <vector>

#include "lang/context.h"
#include "lang/value.h"

namespace vestige::lang {

/// The arguments of a call, checked against the signature.
struct Call {
  Context& context;
  Span span;  ///< of the whole call
  std::vector<Datum> args;
  std::vector<Span> spans;  ///< of the arguments

  double number(std::size_t i) const { return std::get<Numbers>(args[i]).at(0); }
  Numbers vector(std::size_t i) const { return std::get<Numbers>(args[i]); }
  const std::string& text(std::size_t i) const { return *std::get<TextPtr>(args[i]); }
  /// An integer within the range of int, truncated as in POV-Ray.
  int integer(std::size_t i) const;
  /// Reports an error in argument i; returns std::monostate.
  Datum complain(std::size_t i, const std::string& message) const;
  void warn(std::size_t i, const std::string& message) const;
};

struct Builtin {
  const char* name;
  /// One letter per argument: n number, v vector (a number is promoted), s string, a array. Those
  /// after '|' may be left out; '+' repeats the last one any number of times.
  const char* signature;
  Datum (*apply)(const Call&);
  bool isPure = true;  ///< the same arguments give the same result
};

/// The built-in of that name, or null.
const Builtin* findBuiltin(const std::string& name);
std::vector<std::string> builtinNames();
/// Checks the arguments against the signature and calls.
Datum applyBuiltin(const Builtin& builtin, const Call& call);

// By subject; each in its own file.
std::vector<Builtin> numberBuiltins();
std::vector<Builtin> vectorBuiltins();
std::vector<Builtin> stringBuiltins();

}  // namespace vestige::lang
