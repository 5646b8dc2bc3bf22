// SPDX-License-Identifier: Apache-2.0
// Compiles the tree of a function to its program: steps on a stack of numbers, in the order of the
// operands. Both branches of a choice are computed, so each call costs the same.
#include "lang/function.h"

#include <cmath>
#include <cstring>
#include <map>

#include "lang/builtins.h"
#include "lang/eval.h"

namespace vestige::lang {
namespace {

constexpr int kStack = 256;                   ///< numbers of one call
constexpr int kDeepestCall = 16;              ///< of functions within functions
constexpr std::int64_t kDearest = 1'000'000;  ///< steps of one evaluation, inner calls included

using Kernel = double (*)(const double* args, int count);

double truth(bool b) { return b ? 1 : 0; }
bool areEqual(double x, double y) { return x == y || std::abs(x - y) <= kTruth; }

template <double (*f)(double)>
double plain(const double* a, int) {
  return f(a[0]);
}
template <double (*f)(double)>
double nearUnit(const double* a, int) {
  return f(std::clamp(a[0], -1.0, 1.0));
}
template <bool takesLarger>
double extreme(const double* a, int n) {
  double best = a[0];
  for (int i = 1; i < n; ++i) best = takesLarger ? std::max(best, a[i]) : std::min(best, a[i]);
  return best;
}
int whole(double x) { return std::isnan(x) ? 0 : int(std::clamp(x, -2147483648.0, 2147483647.0)); }
template <char op>
double bitwise(const double* a, int n) {
  int bits = whole(a[0]);
  for (int i = 1; i < n; ++i)
    bits = op == '&' ? bits & whole(a[i]) : op == '|' ? bits | whole(a[i]) : bits ^ whole(a[i]);
  return bits;
}
double choose(const double* a, int n) {
  if (a[0] < 0) return a[1];
  return n == 3 || a[0] == 0 ? a[2] : a[3];
}

/// Operators and built-in functions of numbers, as the language computes them elsewhere.
const std::map<std::string, Kernel>& kernels() {
  constexpr double kHalfTurn = 3.14159265358979323846;
  static const std::map<std::string, Kernel> all = {
      {"+", [](const double* a, int) { return a[0] + a[1]; }},
      {"-", [](const double* a, int n) { return n == 1 ? -a[0] : a[0] - a[1]; }},
      {"*", [](const double* a, int) { return a[0] * a[1]; }},
      {"/", [](const double* a, int) { return a[1] == 0 ? HUGE_VAL : a[0] / a[1]; }},
      {"%", [](const double* a, int) { return a[1] == 0 ? HUGE_VAL : std::fmod(a[0], a[1]); }},
      {"!", [](const double* a, int) { return truth(!isTrue(a[0])); }},
      {"&", [](const double* a, int) { return truth(isTrue(a[0]) && isTrue(a[1])); }},
      {"|", [](const double* a, int) { return truth(isTrue(a[0]) || isTrue(a[1])); }},
      {"=", [](const double* a, int) { return truth(areEqual(a[0], a[1])); }},
      {"!=", [](const double* a, int) { return truth(!areEqual(a[0], a[1])); }},
      {"<", [](const double* a, int) { return truth(a[0] < a[1]); }},
      {"<=", [](const double* a, int) { return truth(a[0] < a[1] || areEqual(a[0], a[1])); }},
      {">", [](const double* a, int) { return truth(a[0] > a[1]); }},
      {">=", [](const double* a, int) { return truth(a[0] > a[1] || areEqual(a[0], a[1])); }},
      {"?", [](const double* a, int) { return isTrue(a[0]) ? a[1] : a[2]; }},
      {"abs", plain<std::fabs>},
      {"acos", nearUnit<std::acos>},
      {"acosh", plain<std::acosh>},
      {"asin", nearUnit<std::asin>},
      {"asinh", plain<std::asinh>},
      {"atan", plain<std::atan>},
      {"atan2", [](const double* a, int) { return std::atan2(a[0], a[1]); }},
      {"atanh", plain<std::atanh>},
      {"bitwise_and", bitwise<'&'>},
      {"bitwise_or", bitwise<'|'>},
      {"bitwise_xor", bitwise<'^'>},
      {"ceil", plain<std::ceil>},
      {"cos", plain<std::cos>},
      {"cosh", plain<std::cosh>},
      {"degrees", [](const double* a, int) { return a[0] * (180 / kHalfTurn); }},
      {"div", [](const double* a, int) { return std::trunc(a[0] / a[1]); }},
      {"exp", plain<std::exp>},
      {"floor", plain<std::floor>},
      {"int", plain<std::trunc>},
      {"ln", plain<std::log>},
      {"log", plain<std::log10>},
      {"max", extreme<true>},
      {"min", extreme<false>},
      {"mod", [](const double* a, int) { return std::fmod(a[0], a[1]); }},
      {"pow", [](const double* a, int) { return std::pow(a[0], a[1]); }},
      {"radians", [](const double* a, int) { return a[0] * (kHalfTurn / 180); }},
      {"select", choose},
      {"sin", plain<std::sin>},
      {"sinh", plain<std::sinh>},
      {"sqrt", plain<std::sqrt>},
      {"tan", plain<std::tan>},
      {"tanh", plain<std::tanh>}};
  return all;
}

class Program final : public vestige::Function {
 public:
  /// Exactly one of these: an argument, a constant, a kernel, an inner function.
  struct Step {
    int argument = -1;
    double constant = 0;
    Kernel kernel = nullptr;
    std::shared_ptr<const Program> inner = nullptr;
    int count = 0;  ///< operands taken from the stack
  };

  int arity() const noexcept override { return arity_; }
  std::uint64_t fingerprint() const noexcept override { return print_; }

  double eval(std::span<const double> args) const noexcept override {
    double stack[kStack];
    int top = 0;
    for (const Step& s : steps) {
      top -= s.count;
      double& result = stack[top++];
      if (s.kernel)
        result = s.kernel(&result, s.count);
      else if (s.inner)
        result = s.inner->eval({&result, std::size_t(s.count)});
      else
        result = s.argument >= 0 ? args[std::size_t(s.argument)] : s.constant;
    }
    return stack[0];
  }

  /// FNV-1a [Fowler, Noll, Vo], byte by byte.
  void note(std::uint64_t bits) {
    for (int i = 0; i < 8; ++i) {
      print_ ^= static_cast<unsigned char>(bits >> (8 * i));
      print_ *= 0x100000001b3ull;
    }
  }

  std::vector<Step> steps;
  int arity_ = 0, depth = 1;
  std::int64_t cost = 0;
  std::uint64_t print_ = 0xcbf29ce484222325ull;
};

class Compiler {
 public:
  Compiler(Context& context, const Span& use) : context_(context), use_(use) {}

  /// Null if an error was reported.
  std::shared_ptr<const Program> program(const Function& f) {
    if (level_ >= kDeepestCall) return tooDear();
    if (f.program) return std::static_pointer_cast<const Program>(f.program);
    if (!f.body) {
      fail(use_, "a function that transforms a vector gives no number");
      return nullptr;
    }
    auto made = std::make_shared<Program>();
    made->arity_ = int(f.parameters.size());
    made->note(std::uint64_t(made->arity_));
    ++level_;
    const bool isWhole = add(*made, *f.body, 0);
    --level_;
    if (!isWhole) return nullptr;
    if (made->cost > kDearest || made->depth > kDeepestCall) return tooDear();
    f.program = made;
    return made;
  }

 private:
  bool fail(const Span& span, const std::string& message) {
    Diagnostic& d = context_.reporter.error(span, message);
    if (span.file != use_.file || span.begin != use_.begin)
      d.notes.push_back({use_, "the function is used here"});
    return false;
  }

  std::shared_ptr<const Program> tooDear() {
    fail(use_, "this function calls too many others: at most " + std::to_string(kDearest) +
                   " steps and " + std::to_string(kDeepestCall) + " levels are taken");
    return nullptr;
  }

  /// Appends steps that push the value of `e` onto the stack above `below` numbers.
  bool add(Program& p, const Expr& e, int below) {
    context_.step(e.span);
    if (below >= kStack) return fail(e.span, "this function's expression is too long");
    switch (e.kind) {
      case Expr::Kind::parameter:
        push(p, {.argument = e.slot});
        p.note(1);
        p.note(std::uint64_t(e.slot));
        return true;
      case Expr::Kind::unary:
      case Expr::Kind::binary:
      case Expr::Kind::choose:
        if (e.word == "+" && e.args.size() == 1) return add(p, *e.args[0], below);
        return addCall(p, e, below, kernels().at(e.word), nullptr);
      case Expr::Kind::builtin:
        return addBuiltin(p, e, below);
      case Expr::Kind::invoke:
        return addInner(p, e, below);
      default:
        return addConstant(p, e);
    }
  }

  bool addBuiltin(Program& p, const Expr& e, int below) {
    const auto kernel = kernels().find(e.function->name);
    if (kernel == kernels().end()) return addConstant(p, e);
    if (!fits(e))
      return fail(e.span, e.word + "() does not take " + std::to_string(e.args.size()) +
                              (e.args.size() == 1 ? " argument" : " arguments"));
    return addCall(p, e, below, kernel->second, nullptr);
  }

  bool addInner(Program& p, const Expr& e, int below) {
    const auto inner = program(*std::get<FunctionPtr>(e.value));
    if (!inner) return false;
    if (int(e.args.size()) != inner->arity())
      return fail(e.span, "the function '" + e.word + "' takes " + std::to_string(inner->arity()) +
                              (inner->arity() == 1 ? " argument, found " : " arguments, found ") +
                              std::to_string(e.args.size()));
    p.depth = std::max(p.depth, inner->depth + 1);
    return addCall(p, e, below, nullptr, inner);
  }

  bool addCall(Program& p, const Expr& e, int below, Kernel kernel,
               std::shared_ptr<const Program> inner) {
    for (std::size_t i = 0; i < e.args.size(); ++i)
      if (!add(p, *e.args[i], below + int(i))) return false;
    p.note(2);
    p.note(e.args.size());
    if (inner)
      p.note(inner->fingerprint());
    else
      for (const char c : e.word) p.note(std::uint64_t(c));
    p.cost += inner ? inner->cost : 0;
    push(p, {.kernel = kernel, .inner = std::move(inner), .count = int(e.args.size())});
    return true;
  }

  /// Any other expression must already be a number: `A[2]`, `vlength(V)`, `Gold.red`.
  bool addConstant(Program& p, const Expr& e) {
    if (hasParameter(e))
      return fail(e.span,
                  "a function that a block takes is made of numbers: vectors, colours and "
                  "arrays cannot depend on its parameters");
    const Datum d = Evaluator(context_).evaluate(e);
    const Numbers* n = numbers(d);
    if (isBroken(d)) return false;
    if (!n || n->size != 1)
      return fail(e.span, "a function that a block takes is made of numbers, found " + describe(d));
    push(p, {.constant = n->v[0]});
    std::uint64_t bits = 0;
    std::memcpy(&bits, &n->v[0], sizeof bits);
    p.note(3);
    p.note(bits);
    return true;
  }

  static bool hasParameter(const Expr& e) {
    if (e.kind == Expr::Kind::parameter) return true;
    return std::any_of(e.args.begin(), e.args.end(),
                       [](const ExprPtr& arg) { return arg && hasParameter(*arg); });
  }

  /// Whether the number of arguments is valid for the built-in.
  static bool fits(const Expr& e) {
    const std::string_view s = e.function->signature;
    const std::size_t n = e.args.size(), bar = s.find('|');
    if (s.back() == '+') return n + 1 >= s.size();
    if (bar == s.npos) return n == s.size();
    return n >= bar && n + 1 <= s.size();
  }

  void push(Program& p, Program::Step step) {
    context_.budget.reserveOne(use_, p.steps);
    p.steps.push_back(std::move(step));
    ++p.cost;
  }

  Context& context_;
  Span use_;
  int level_ = 0;  ///< of functions within functions
};

}  // namespace

std::shared_ptr<const vestige::Function> programOf(Context& context, const Function& function,
                                                   const Span& span) {
  return Compiler(context, span).program(function);
}

}  // namespace vestige::lang
