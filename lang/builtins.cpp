// SPDX-License-Identifier: Apache-2.0
#include "lang/builtins.h"

#include <cmath>
#include <cstring>
#include <map>

namespace vestige::lang {
namespace {

const std::map<std::string, Builtin>& table() {
  static const std::map<std::string, Builtin> all = [] {
    std::map<std::string, Builtin> m;
    for (const auto& part : {numberBuiltins(), vectorBuiltins(), stringBuiltins()})
      for (const Builtin& b : part) m[b.name] = b;
    return m;
  }();
  return all;
}

std::string plural(std::size_t n) {
  return std::to_string(n) + (n == 1 ? " argument" : " arguments");
}

/// The signature's letter for argument i.
char letterOf(const std::string& letters, std::size_t i) {
  return letters[std::min(i, letters.size() - 1)];
}

bool fits(Datum& d, char letter) {
  if (letter == 's') return std::holds_alternative<TextPtr>(d);
  if (letter == 'a') return std::holds_alternative<ArrayPtr>(d);
  const Numbers* n = numbers(d);
  if (!n) return false;
  if (letter == 'n') return n->size == 1;
  if (n->size == 1) d = Numbers(n->v[0], n->v[0], n->v[0]);
  return true;
}

const char* wanted(char letter) {
  return letter == 's'   ? "a string"
         : letter == 'a' ? "an array"
         : letter == 'n' ? "a number"
                         : "a vector";
}

bool hasRightCount(const Builtin& b, const Call& call, const std::string& letters,
                   std::size_t least, bool repeats) {
  const std::size_t n = call.args.size();
  if (n >= least && (repeats || n <= letters.size())) return true;
  const std::string count =
      repeats ? "at least " + plural(least)
      : least < letters.size()
          ? std::to_string(least) + " to " + plural(letters.size())
          : (letters.empty() ? std::string("no arguments") : plural(letters.size()));
  call.context.reporter.error(
      call.span, std::string(b.name) + "() takes " + count + ", found " + std::to_string(n));
  return false;
}

}  // namespace

int Call::integer(std::size_t i) const {
  const double x = number(i);
  if (std::isnan(x)) return 0;
  return int(std::clamp(x, -2147483648.0, 2147483647.0));
}

Datum Call::complain(std::size_t i, const std::string& message) const {
  context.reporter.error(i < spans.size() ? spans[i] : span, message);
  return {};
}

void Call::warn(std::size_t i, const std::string& message) const {
  context.reporter.warning(i < spans.size() ? spans[i] : span, message);
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

Datum applyBuiltin(const Builtin& builtin, const Call& given) {
  Call call = given;
  std::string letters = builtin.signature;
  const bool repeats = !letters.empty() && letters.back() == '+';
  if (repeats) letters.pop_back();
  const std::size_t bar = letters.find('|');
  const std::size_t least = bar == std::string::npos ? letters.size() : bar;
  if (bar != std::string::npos) letters.erase(bar, 1);
  for (const Datum& d : call.args)
    if (isBroken(d)) return {};
  if (!hasRightCount(builtin, call, letters, least, repeats)) return {};
  for (std::size_t i = 0; i < call.args.size(); ++i) {
    const char letter = letterOf(letters, i);
    if (!fits(call.args[i], letter))
      return call.complain(i, std::string(builtin.name) + "() takes " + wanted(letter) + " here" +
                                  ", found " + describe(call.args[i]));
  }
  for (const Datum& d : call.args)
    if (const auto* s = std::get_if<TextPtr>(&d)) call.context.budget.copy(call.span, (*s)->size());
  return builtin.apply(call);
}

}  // namespace vestige::lang
