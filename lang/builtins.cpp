// SPDX-License-Identifier: Apache-2.0
#include "lang/builtins.h"

#include <climits>
#include <cmath>
#include <cstring>
#include <map>

namespace vestige::lang {
namespace {

constexpr std::size_t kAnyNumber = SIZE_MAX;

void readSignature(Builtin& b) {
  b.letters = b.signature;
  const std::size_t bar = b.letters.find('|');
  if (bar != std::string::npos) b.letters.erase(bar, 1);
  const bool repeats = !b.letters.empty() && b.letters.back() == '+';
  if (repeats) b.letters.pop_back();
  b.least = std::min(bar, b.letters.size());
  b.most = repeats ? kAnyNumber : b.letters.size();
  b.needsCommas = !b.letters.empty() && b.letters.back() == 'n' ? b.least : b.most;
  b.takesVectors = b.letters.find_first_of("vc") != std::string::npos;
}

const std::map<std::string, Builtin>& table() {
  static const std::map<std::string, Builtin> all = [] {
    std::map<std::string, Builtin> m;
    for (const auto& part :
         {numberBuiltins(), vectorBuiltins(), stringBuiltins(), timeBuiltins(), objectBuiltins()})
      for (const Builtin& b : part) readSignature(m[b.name] = b);
    return m;
  }();
  return all;
}

std::string plural(std::size_t n) {
  return std::to_string(n) + (n == 1 ? " argument" : " arguments");
}

bool isObject(const Datum& d) {
  const auto* block = std::get_if<BlockPtr>(&d);
  return block && ((*block)->kind == "shape" || (*block)->kind == "union");
}

bool fits(Datum& d, char letter) {
  if (letter == 's') return std::holds_alternative<TextPtr>(d);
  if (letter == 'a') return std::holds_alternative<ArrayPtr>(d);
  if (letter == 'o') return isObject(d);
  const Numbers* n = numbers(d);
  if (!n) return false;
  if (letter == 'n') return n->size == 1;
  if (letter == 'c') return true;
  if (letter == 't') return n->size == 3 && !n->isColour;
  if (n->size == 1) d = Numbers(n->v[0], n->v[0], n->v[0]);
  return n->size <= 3;
}

const char* wanted(char letter) {
  return letter == 's'   ? "a string"
         : letter == 'a' ? "an array"
         : letter == 'o' ? "a declared shape or union"
         : letter == 't' ? "the name of a vector <x, y, z>"
         : letter == 'n' ? "a number"
         : letter == 'v' ? "a vector <x, y, z>"
                         : "a vector or a colour";
}

bool hasRightCount(const Builtin& b, const Call& call) {
  const std::size_t n = call.args.size(), least = b.least, most = b.most;
  if (b.fits(n)) return true;
  const std::string count = most == kAnyNumber ? "at least " + plural(least)
                            : least < most     ? std::to_string(least) + " to " + plural(most)
                                               : (most == 0 ? "no arguments" : plural(most));
  call.context.reporter.error(
      call.span, std::string(b.name) + "() takes " + count + ", found " + std::to_string(n));
  return false;
}

}  // namespace

int Call::integer(std::size_t i) const {
  const double x = number(i);
  return x > -2147483649.0 && x < 2147483648.0 ? int(x) : INT_MIN;
}

Datum Call::complain(std::size_t i, const std::string& message) const {
  context.reporter.error(i < args.size() ? args.span(i) : span, message);
  return {};
}

void Call::warn(std::size_t i, const std::string& message) const {
  context.reporter.warning(i < args.size() ? args.span(i) : span, message);
}

const Builtin* findBuiltin(const std::string& name) {
  const auto found = table().find(name);
  return found == table().end() ? nullptr : &found->second;
}

std::vector<std::string> builtinNames() {
  std::vector<std::string> names;
  for (const auto& [name, b] : table()) names.push_back(name);
  return names;
}

Datum applyBuiltin(const Builtin& builtin, Context& context, const Span& span,
                   std::span<Operand> operands) {
  const Call call{context, span, Arguments(operands)};
  for (const Operand& o : operands)
    if (isBroken(o.value)) return {};
  if (!hasRightCount(builtin, call)) return {};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const char letter = builtin.letter(i);
    if (!fits(call.args[i], letter))
      return call.complain(i, std::string(builtin.name) + "() takes " + wanted(letter) + " here" +
                                  ", found " + describe(call.args[i]));
    if (letter == 's') context.budget.copy(span, call.text(i).size());
  }
  return builtin.apply(call);
}

}  // namespace vestige::lang
