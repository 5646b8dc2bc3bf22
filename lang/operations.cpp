// SPDX-License-Identifier: Apache-2.0
#include "lang/operations.h"

#include <cmath>

#include "lang/builtins.h"
#include "lang/dictionary.h"
#include "lang/program_steps.h"
#include "lang/spline.h"

namespace vestige::lang {
namespace {

/// IEC 61966-2-1; below zero its linear part goes on, as in POV-Ray.
double decodeSrgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

double truth(bool b) { return b ? 1 : 0; }

/// Weights of `.gray`, POV-Ray's; what a number or a short vector does not have is 0.
double grey(const Numbers& n) { return 0.297 * n.v[0] + 0.589 * n.v[1] + 0.114 * n.v[2]; }

/// The component that a word names.
int componentOf(Word word) {
  if (const int channel = channelOf(word); channel >= 0) return channel;
  switch (word) {
    case Word::x:
    case Word::u:
      return 0;
    case Word::y:
    case Word::v:
      return 1;
    case Word::t:
      return 3;
    default:
      return 2;
  }
}

std::string quoted(const char* word) { return std::string("'") + word + "'"; }

}  // namespace

Datum Operations::apply(const Operation& o, std::span<Operand> operands) {
  switch (o.kind) {
    case Operation::Kind::unary:
      return unary(o, operands[0]);
    case Operation::Kind::binary:
      return binary(o, operands[0], operands[1]);
    case Operation::Kind::vector:
      return vector(operands);
    case Operation::Kind::colour:
      return colour(o, operands[0]);
    case Operation::Kind::channels:
      return channels(o, operands);
    case Operation::Kind::member:
      return member(o, operands[0]);
    case Operation::Kind::index:
      return index(o, operands);
    case Operation::Kind::spline:
      return spline(o, operands);
    case Operation::Kind::builtin:
      return applyBuiltin(*o.name->builtin, context_, o.span, operands);
    default:
      return {};
  }
}

const Numbers* Operations::numbersOf(const Operand& operand, const char* who) {
  const Numbers* n = numbers(operand.value);
  if (!n && !isBroken(operand.value))
    context_.reporter.error(
        operand.span,
        quoted(who) + " takes a number, a vector or a colour, found " + describe(operand.value));
  return n;
}

std::optional<double> Operations::number(const Operand& operand, const char* role) {
  const Numbers* n = numbers(operand.value);
  if (n && n->size == 1) return n->v[0];
  if (!isBroken(operand.value))
    context_.reporter.error(
        operand.span, std::string(role) + " takes a number, found " + describe(operand.value));
  return {};
}

Datum Operations::unary(const Operation& o, const Operand& operand) {
  const Numbers* n = numbersOf(operand, textOf(o.op));
  if (!n) return {};
  Numbers r = *n;
  for (int i = 0; i < r.size; ++i) {
    double& x = r.v[std::size_t(i)];
    if (o.op == Op::minus) x = -x;
    if (o.op == Op::invert) x = truth(!isTrue(x));
  }
  return r;
}

double Operations::applied(const Operation& o, double x, double y) {
  const double operands[] = {x, y};
  bool isByZero = false;
  const double r = applyStep(Program::codeOf(o.op), operands, 2, isByZero);
  if (isByZero) context_.reporter.warning(o.wordSpan, "division by zero");
  return r;
}

Datum Operations::binary(const Operation& o, const Operand& left, const Operand& right) {
  const auto* s = std::get_if<TextPtr>(&left.value);
  if (s && isRelation(o.op)) return relation(o, *s, right);
  const Numbers* x = numbersOf(left, textOf(o.op));
  const Numbers* y = numbersOf(right, textOf(o.op));
  if (!x || !y) return {};
  Numbers r;
  r.size = std::max(x->size, y->size);
  r.isColour = x->isColour || y->isColour;
  for (int i = 0; i < r.size; ++i) r.v[std::size_t(i)] = applied(o, x->at(i), y->at(i));
  return r;
}

Datum Operations::relation(const Operation& o, const TextPtr& left, const Operand& right) {
  if (const auto* t = std::get_if<TextPtr>(&right.value)) {
    context_.budget.copy(o.span, std::min(left->size(), (*t)->size()));
    return Numbers(applied(o, left->compare(**t), 0));
  }
  if (!isBroken(right.value))
    context_.reporter.error(
        right.span,
        quoted(textOf(o.op)) + " after a string takes a string, found " + describe(right.value));
  return {};
}

Datum Operations::vector(std::span<const Operand> operands) {
  Numbers r;
  r.size = int(operands.size());
  bool isWhole = true;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const auto x = number(operands[i], "a component of a vector");
    isWhole &= x.has_value();
    r.v[i] = x.value_or(0);
  }
  return isWhole ? Datum(r) : Datum();
}

// A number fills red, green and blue and what else the word names: `rgbt 0.4` transmits 0.4, and
// `color 0.4` sets all five. A vector gives its components in order, also beyond the word's own;
// the fourth of `rgbt` is transmit.
Datum Operations::colour(const Operation& o, const Operand& operand) {
  const Numbers* n = numbersOf(operand, textOf(o.word));
  if (!n) return {};
  Numbers r;
  r.size = 5, r.isColour = true;
  const bool isBare = isBareColour(o.word);
  const bool isSrgb = o.word >= Word::srgb && o.word <= Word::srgbft;
  const std::string_view word = textOf(o.word);
  const std::string_view tail = isBare ? "ft" : word.substr(isSrgb ? 4 : 3);  // "", f, t, ft
  if (isBare && n->size == 1)
    context_.reporter.warning(o.span, quoted(textOf(o.word)) +
                                          " with one number also sets filter and "
                                          "transmit to it; write 'rgb' for a grey");
  for (int i = 0; i < 5; ++i) r.v[std::size_t(i)] = n->at(i);
  if (n->size == 1 && tail.find('f') == tail.npos) r.v[3] = 0;
  if (n->size == 1 && tail.find('t') == tail.npos) r.v[4] = 0;
  if (tail == "t" && n->size > 3) r.v[4] = r.v[3], r.v[3] = 0;
  if (isSrgb)
    for (std::size_t i = 0; i < 3; ++i) r.v[i] = decodeSrgb(r.v[i]);
  return r;
}

Datum Operations::channels(const Operation& o, std::span<const Operand> operands) {
  Numbers r;
  if (o.given >> 5) {
    const Numbers* base = numbers(operands[5].value);
    if (!base) return {};
    r = *base;
  }
  r.size = 5, r.isColour = true;
  for (std::size_t i = 0; i < 5; ++i)
    if (o.given >> i & 1) {
      const auto x = number(operands[i], "a colour's part");
      if (!x) return {};
      r.v[i] = *x;
    }
  return r;
}

Datum Operations::member(const Operation& o, const Operand& operand) {
  const std::string dotted = std::string(".") + textOf(o.word);
  const Numbers* n = numbersOf(operand, dotted.c_str());
  if (!n) return {};
  const bool isGrey = o.word == Word::gray || o.word == Word::grey;
  const int place = componentOf(o.word);
  if (!isGrey && place >= n->size) {
    context_.reporter.error(o.wordSpan, quoted(dotted.c_str()) + " asks for a component that " +
                                            describe(operand.value) + " does not have");
    return {};
  }
  return Numbers(isGrey ? grey(*n) : n->v[std::size_t(place)]);
}

Datum Operations::entry(const Dictionary& dictionary, const Operand& key) {
  const auto* text = std::get_if<TextPtr>(&key.value);
  if (!text) {
    if (!isBroken(key.value))
      context_.reporter.error(key.span,
                              "a key of a dictionary is a string, found " + describe(key.value));
    return {};
  }
  const auto found = dictionary.entries.find(**text);
  if (found != dictionary.entries.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [name, value] : dictionary.entries) known.push_back(name);
  context_.reporter.error(key.span, "this dictionary has no entry '" + **text + "'" +
                                        context_.suggest(key.span, **text, known));
  return {};
}

Datum Operations::spline(const Operation& o, std::span<const Operand> operands) {
  const auto* s = std::get_if<SplinePtr>(&operands[0].value);
  const auto t = number(operands[1], "a spline");
  return s && t ? Datum((*s)->at(*t, o.word)) : Datum();
}

// The element of an array may be an array, which takes the rest of the indices.
Datum Operations::index(const Operation& o, std::span<const Operand> operands) {
  Datum d = operands[0].value;
  for (std::size_t next = 1; next < operands.size();) {
    if (const auto* found = std::get_if<DictionaryPtr>(&d)) {
      const DictionaryPtr dictionary = *found;
      d = entry(*dictionary, operands[next++]);
      continue;
    }
    const auto* found = std::get_if<ArrayPtr>(&d);
    if (!found) {
      if (!isBroken(d))
        context_.reporter.error(operands[next - 1].span,
                                "'[' follows an array, found " + describe(d));
      return {};
    }
    const ArrayPtr array = *found;
    std::vector<double> indices;
    std::vector<Span> spans;
    for (; indices.size() < array->sizes.size() && next < operands.size(); ++next) {
      const auto i = number(operands[next], "an index");
      if (!i) return {};
      indices.push_back(*i);
      spans.push_back(operands[next].span);
    }
    const auto at = elementAt(context_, *array, indices, spans);
    if (!at) return {};
    d = array->data[*at];
    if (isBroken(d)) context_.reporter.error(o.span, "this element of the array has no value yet");
  }
  return d;
}

std::optional<std::size_t> elementAt(Context& context, const Array& array,
                                     const std::vector<double>& indices,
                                     const std::vector<Span>& spans) {
  if (indices.size() != array.sizes.size()) {
    context.reporter.error(spans[0], "this array has " + std::to_string(array.sizes.size()) +
                                         (array.sizes.size() == 1 ? " dimension" : " dimensions") +
                                         ", found " + std::to_string(indices.size()) +
                                         (indices.size() == 1 ? " index" : " indices"));
    return {};
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const double x = std::floor(indices[i] + kTruth);
    if (!(x >= 0 && x < array.sizes[i])) {
      context.reporter.error(spans[i], "this index runs from 0 to " +
                                           std::to_string(array.sizes[i] - 1) + ", found " +
                                           shortest(indices[i]));
      return {};
    }
    at = at * std::size_t(array.sizes[i]) + std::size_t(x);
  }
  return at;
}

}  // namespace vestige::lang
