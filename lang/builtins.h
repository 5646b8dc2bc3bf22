// SPDX-License-Identifier: Apache-2.0
// The functions of the language, with POV-Ray's names and results.
#pragma once
#include <string>
#include <vector>

#include "lang/context.h"
#include "lang/value.h"

namespace vestige::lang {

/// What a built-in gets: arguments that fit its signature.
struct Call {
  Context& context;
  Span span;  ///< of the whole call
  std::vector<Datum> args;
  std::vector<Span> spans;  ///< of the arguments

  double number(std::size_t i) const { return std::get<Numbers>(args[i]).at(0); }
  Numbers vector(std::size_t i) const { return std::get<Numbers>(args[i]); }
  const std::string& text(std::size_t i) const { return *std::get<TextPtr>(args[i]); }
  /// An integer in the reach of int; POV-Ray truncates.
  int integer(std::size_t i) const;
  Datum complain(std::size_t i, const std::string& message) const;  ///< gives nothing back
  void warn(std::size_t i, const std::string& message) const;
};

struct Builtin {
  const char* name;
  /// One letter an argument: n number, v vector (a number is promoted), s string, a array.
  /// Those after '|' may be left out; '+' repeats the last one any number of times.
  const char* signature;
  Datum (*apply)(const Call&);
  bool isPure = true;  ///< the same arguments give the same result
};

/// Or null.
const Builtin* findBuiltin(const std::string& name);
std::vector<std::string> builtinNames();
/// Checks the arguments against the signature and calls.
Datum applyBuiltin(const Builtin& builtin, const Call& call);

// By subject; each in its own file.
std::vector<Builtin> numberBuiltins();
std::vector<Builtin> vectorBuiltins();
std::vector<Builtin> stringBuiltins();

}  // namespace vestige::lang
