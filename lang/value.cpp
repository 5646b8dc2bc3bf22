// SPDX-License-Identifier: Apache-2.0
#include "lang/value.h"

#include <charconv>

namespace vestige::lang {

std::string shortest(double x) {
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, x);
  return {buffer, end};
}

std::string describe(const Datum& datum) {
  struct Visitor {
    std::string operator()(std::monostate) const { return "nothing"; }
    std::string operator()(const Numbers& n) const {
      if (n.size == 1) return "the number " + shortest(n.v[0]);
      std::string s = n.isColour ? "the colour <" : "the vector <";
      const int shown = n.isColour && n.v[3] == 0 && n.v[4] == 0 ? 3 : n.size;
      for (int i = 0; i < shown; ++i) s += (i ? ", " : "") + shortest(n.v[std::size_t(i)]);
      return s + ">";
    }
    std::string operator()(const TextPtr& s) const {
      constexpr std::size_t kLongest = 40;
      return "the string \"" + (s->size() > kLongest ? s->substr(0, kLongest) + "..." : *s) + "\"";
    }
    std::string operator()(const BlockPtr& b) const {
      return b->kind == "shape"
                 ? "the shape '" + b->plugin + "'"
                 : "the block '" + b->kind + (b->plugin.empty() ? "" : " " + b->plugin) + "'";
    }
    std::string operator()(const AffinePtr&) const { return "a transform"; }
    std::string operator()(const FunctionPtr&) const { return "a function"; }
    std::string operator()(const ArrayPtr&) const { return "an array"; }
    std::string operator()(const MacroPtr&) const { return "a macro"; }
    std::string operator()(const SplinePtr&) const { return "a spline"; }
    std::string operator()(const DataFilePtr&) const { return "an open file"; }
    std::string operator()(const DictionaryPtr&) const { return "a dictionary"; }
  };
  return std::visit(Visitor{}, datum);
}

}  // namespace vestige::lang
