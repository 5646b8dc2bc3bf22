// SPDX-License-Identifier: Apache-2.0
#include "lang/eval.h"

#include <cmath>
#include <cstring>
#include <map>

#include "lang/builtins.h"

namespace vestige::lang {
namespace {

/// Levels of evaluation for each level of nesting: an expression in parentheses takes several.
constexpr int kLevelsPerNesting = 4;

/// A node of a function costs more than a token.
constexpr std::int64_t kStepsANode = 2;

/// IEC 61966-2-1; below zero its linear part goes on, as in POV-Ray.
double decodeSrgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

double truth(bool b) { return b ? 1 : 0; }

/// POV-Ray's relations: equal within kTruth; < and > are strict without tolerance.
double relation(const std::string& op, double x, double y) {
  const bool equal = x == y || std::abs(x - y) <= kTruth;
  if (op == "=") return truth(equal);
  if (op == "!=") return truth(!equal);
  if (op == "<") return truth(x < y);
  if (op == "<=") return truth(x <= y || equal);
  if (op == ">") return truth(x > y);
  return truth(x >= y || equal);
}

bool isRelation(const std::string& op) { return std::strchr("=!<>", op[0]) != nullptr; }

/// Weights of `.gray`, POV-Ray's.
double grey(const Numbers& n) { return 0.297 * n.v[0] + 0.589 * n.v[1] + 0.114 * n.v[2]; }

}  // namespace

Datum Evaluator::evaluate(const Expr& e, Arguments a) {
  if (depth_ > context_.deepest() * kLevelsPerNesting)
    context_.stopTooDeep(e.span, "these functions are");
  if (calls_ > 0) context_.step(e.span, kStepsANode);
  ++depth_;
  const auto step = [&]() -> Datum {
    switch (e.kind) {
      case Expr::Kind::constant:
        return e.value;
      case Expr::Kind::parameter:
        return Numbers(a[std::size_t(e.slot)]);
      case Expr::Kind::unary:
        return unary(e, a);
      case Expr::Kind::binary:
        return binary(e, a);
      case Expr::Kind::choose:
        return choose(e, a);
      case Expr::Kind::vector:
        return vector(e, a);
      case Expr::Kind::colour:
        return colour(e, a);
      case Expr::Kind::channels:
        return channels(e, a);
      case Expr::Kind::member:
        return member(e, a);
      case Expr::Kind::index:
        return index(e, a);
      case Expr::Kind::builtin:
        return builtin(e, a);
      case Expr::Kind::invoke:
        return invoke(e, a);
    }
    return {};
  };
  Datum result = step();
  --depth_;
  return result;
}

const Numbers* Evaluator::wantNumbers(const Datum& d, const Expr& operand, const std::string& who) {
  const Numbers* n = numbers(d);
  if (!n && !isBroken(d))
    context_.reporter.error(operand.span,
                            who + " takes a number, a vector or a colour, found " + describe(d));
  return n;
}

bool Evaluator::wantNumber(const Datum& d, const Expr& operand, const std::string& who, double& x) {
  const Numbers* n = numbers(d);
  if (n && n->size == 1) {
    x = n->v[0];
    return true;
  }
  if (!isBroken(d))
    context_.reporter.error(operand.span, who + " takes a number, found " + describe(d));
  return false;
}

Datum Evaluator::unary(const Expr& e, Arguments a) {
  const Datum d = evaluate(*e.args[0], a);
  const Numbers* n = wantNumbers(d, *e.args[0], "'" + e.word + "'");
  if (!n) return {};
  Numbers r = *n;
  for (double& x : r.v) {
    if (e.word == "-") x = -x;
    if (e.word == "!") x = truth(!isTrue(x));
  }
  return r;
}

double Evaluator::apply(const std::string& op, double x, double y, const Expr& e) {
  if (op == "+") return x + y;
  if (op == "-") return x - y;
  if (op == "*") return x * y;
  if (op == "&") return truth(isTrue(x) && isTrue(y));
  if (op == "|") return truth(isTrue(x) || isTrue(y));
  if (op != "/" && op != "%") return relation(op, x, y);
  if (y != 0) return op == "/" ? x / y : std::fmod(x, y);
  context_.reporter.warning(e.wordSpan, "division by zero");
  return HUGE_VAL;  // POV-Ray's result, for 0/0 too
}

Datum Evaluator::binary(const Expr& e, Arguments a) {
  const Datum left = evaluate(*e.args[0], a), right = evaluate(*e.args[1], a);
  const auto* s = std::get_if<TextPtr>(&left);
  const auto* t = std::get_if<TextPtr>(&right);
  const std::string who = "'" + e.word + "'";
  if (s && isRelation(e.word)) {
    if (t) {
      context_.budget.copy(e.span, std::min((*s)->size(), (*t)->size()));
      return Numbers(relation(e.word, (*s)->compare(**t), 0));
    }
    if (!isBroken(right))
      context_.reporter.error(e.args[1]->span,
                              who + " after a string takes a string, found " + describe(right));
    return {};
  }
  const Numbers* x = wantNumbers(left, *e.args[0], who);
  const Numbers* y = wantNumbers(right, *e.args[1], who);
  if (!x || !y) return {};
  Numbers r;
  r.size = std::max(x->size, y->size);
  r.isColour = x->isColour || y->isColour;
  for (int i = 0; i < r.size; ++i) r.v[std::size_t(i)] = apply(e.word, x->at(i), y->at(i), e);
  return r;
}

Datum Evaluator::choose(const Expr& e, Arguments a) {
  const Datum condition = evaluate(*e.args[0], a);
  double x = 0;
  if (!wantNumber(condition, *e.args[0], "the condition of '?'", x)) return {};
  return evaluate(*e.args[isTrue(x) ? 1 : 2], a);
}

Datum Evaluator::vector(const Expr& e, Arguments a) {
  Numbers r;
  r.size = int(e.args.size());
  bool isWhole = true;
  for (std::size_t i = 0; i < e.args.size(); ++i)
    isWhole &= wantNumber(evaluate(*e.args[i], a), *e.args[i], "a component of a vector", r.v[i]);
  return isWhole ? Datum(r) : Datum();
}

// A number fills red, green and blue and what else the word names: `rgbt 0.4` transmits 0.4, and
// `color 0.4` sets all five. A vector gives its components in order, also beyond the word's own.
Datum Evaluator::colour(const Expr& e, Arguments a) {
  const Datum d = evaluate(*e.args[0], a);
  const Numbers* n = wantNumbers(d, *e.args[0], "'" + e.word + "'");
  if (!n) return {};
  Numbers r;
  r.size = 5, r.isColour = true;
  const bool isBare = e.word == "color" || e.word == "colour";
  const bool isSrgb = e.word[0] == 's';
  const std::string tail = isBare ? "ft" : e.word.substr(isSrgb ? 4 : 3);  // "", f, t, ft
  if (isBare && n->size == 1)
    context_.reporter.warning(e.span, "'" + e.word +
                                          "' with one number also sets filter and "
                                          "transmit to it; write 'rgb' for a grey");
  for (int i = 0; i < 5; ++i) r.v[std::size_t(i)] = n->at(i);
  if (n->size == 1 && tail.find('f') == std::string::npos) r.v[3] = 0;
  if (n->size == 1 && tail.find('t') == std::string::npos) r.v[4] = 0;
  if (tail == "t" && n->size == 4) r.v[4] = r.v[3], r.v[3] = 0;
  if (isSrgb)
    for (std::size_t i = 0; i < 3; ++i) r.v[i] = decodeSrgb(r.v[i]);
  return r;
}

Datum Evaluator::channels(const Expr& e, Arguments a) {
  Numbers r;
  if (e.args[5]) {
    const Datum base = evaluate(*e.args[5], a);
    if (!numbers(base)) return {};
    r = *numbers(base);
  }
  r.size = 5, r.isColour = true;
  for (std::size_t i = 0; i < 5; ++i)
    if (e.args[i] && !wantNumber(evaluate(*e.args[i], a), *e.args[i], "a colour's part", r.v[i]))
      return {};
  return r;
}

Datum Evaluator::member(const Expr& e, Arguments a) {
  static const std::map<std::string, int> places = {
      {"x", 0},   {"y", 1},     {"z", 2},    {"t", 3},      {"u", 0},       {"v", 1},
      {"red", 0}, {"green", 1}, {"blue", 2}, {"filter", 3}, {"transmit", 4}};
  const Datum d = evaluate(*e.args[0], a);
  const Numbers* n = wantNumbers(d, *e.args[0], "'." + e.word + "'");
  if (!n) return {};
  const bool isGrey = e.word == "gray" || e.word == "grey";
  const int place = isGrey ? 2 : places.at(e.word);
  if (n->size == 1 || place >= n->size) {
    context_.reporter.error(e.wordSpan, "'." + e.word + "' asks for a component that " +
                                            describe(d) + " does not have");
    return {};
  }
  return Numbers(isGrey ? grey(*n) : n->v[std::size_t(place)]);
}

// The element of an array may be an array, which takes the rest of the indices.
Datum Evaluator::index(const Expr& e, Arguments a) {
  Datum d = evaluate(*e.args[0], a);
  for (std::size_t next = 1; next < e.args.size();) {
    const auto* found = std::get_if<ArrayPtr>(&d);
    if (!found) {
      if (!isBroken(d))
        context_.reporter.error(e.args[next - 1]->span,
                                "'[' follows an array, found " + describe(d));
      return {};
    }
    const ArrayPtr array = *found;
    std::vector<double> indices;
    std::vector<Span> spans;
    for (; indices.size() < array->sizes.size() && next < e.args.size(); ++next) {
      const Expr& arg = *e.args[next];
      if (!wantNumber(evaluate(arg, a), arg, "an index", indices.emplace_back())) return {};
      spans.push_back(arg.span);
    }
    const auto at = elementAt(context_, *array, indices, spans);
    if (!at) return {};
    d = array->data[*at];
    if (isBroken(d)) context_.reporter.error(e.span, "this element of the array has no value yet");
  }
  return d;
}

Datum Evaluator::builtin(const Expr& e, Arguments a) {
  Call call{context_, e.span, {}, {}};
  for (const ExprPtr& arg : e.args) {
    call.args.push_back(evaluate(*arg, a));
    call.spans.push_back(arg->span);
  }
  return applyBuiltin(*e.function, call);
}

Datum Evaluator::invoke(const Expr& e, Arguments a) {
  const Function& f = *std::get<FunctionPtr>(e.value);
  context_.step(e.span);
  const std::size_t wanted = f.body ? f.parameters.size() : 3;
  if (e.args.size() != wanted) {
    context_.reporter.error(e.span, "the function '" + e.word + "' takes " +
                                        std::to_string(wanted) +
                                        (wanted == 1 ? " argument" : " arguments") + ", found " +
                                        std::to_string(e.args.size()));
    return {};
  }
  std::vector<double> args(wanted);
  for (std::size_t i = 0; i < wanted; ++i)
    if (!wantNumber(evaluate(*e.args[i], a), *e.args[i], "'" + e.word + "'", args[i])) return {};
  if (f.body) {
    ++calls_;
    Datum result = evaluate(*f.body, args);
    --calls_;
    return result;
  }
  Numbers r(0, 0, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& m = f.transform.m[i];
    r.v[i] = m[0] * args[0] + m[1] * args[1] + m[2] * args[2] + m[3];
  }
  return r;
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
    const double x = std::trunc(indices[i]);
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
