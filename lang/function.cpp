// SPDX-License-Identifier: Apache-2.0
#include "lang/function.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "lang/builtins.h"
#include "lang/eval.h"

namespace vestige::lang {
namespace {

using Code = Program::Code;
using Kind = Operation::Kind;

constexpr int kDeepestCall = 16;              ///< of functions within functions
constexpr std::int64_t kDearest = 1'000'000;  ///< steps of one evaluation, inner calls included

Code codeOf(const Operation& o) {
  return o.kind == Kind::unary && o.op == Op::minus ? Code::negate : Program::codeOf(o.op);
}

class Compiler {
 public:
  /// `use`: null for a quiet compiler, which reports nothing.
  Compiler(Context& context, const Span* use) : context_(context), use_(use) {}

  /// Null if an error was found.
  std::shared_ptr<const Program> program(const Function& f) {
    if (f.program) return f.program;
    if (level_ >= kDeepestCall) return tooDear();
    if (!f.body) {
      fail(use_ ? *use_ : Span(), f.spline ? "a function that follows a spline gives no number"
                                           : "a function that transforms a vector gives no number");
      return nullptr;
    }
    if (f.parameters.size() > std::size_t(Program::kStack)) {
      fail(f.body->operation.span, "a function has at most " + std::to_string(Program::kStack) +
                                       " parameters, found " + std::to_string(f.parameters.size()));
      return nullptr;
    }
    const auto made = std::make_shared<Program>();
    made->arity_ = int(f.parameters.size());
    made->bytes = context_.budget.take(f.body->operation.span, sizeof(Program));
    ++level_;
    const std::vector<double> around = std::exchange(counters_, {});
    const bool isWhole = add(*made, *f.body, 0);
    counters_ = around;
    --level_;
    if (!isWhole) return nullptr;
    if (made->cost > kDearest || made->depth > kDeepestCall) return tooDear();
    made->finish();
    return f.program = made;
  }

 private:
  bool fail(const Span& span, const std::string& message) {
    if (!use_) return false;
    Diagnostic& d = context_.reporter.error(span, message);
    if (span.file != use_->file || span.begin != use_->begin)
      d.notes.push_back({*use_, "the function is used here"});
    return false;
  }

  std::shared_ptr<const Program> tooDear() {
    fail(use_ ? *use_ : Span(), "this function calls too many others: at most " +
                                    std::to_string(kDearest) + " steps and " +
                                    std::to_string(kDeepestCall) + " levels are taken");
    return nullptr;
  }

  /// Appends steps that push the value of `e` onto the stack above `below` numbers.
  bool add(Program& p, const Expr& e, int below) {
    const Operation& o = e.operation;
    context_.step(o.span);
    const Deeper deeper(context_, o.span);
    if (below >= Program::kStack) return fail(o.span, "this function's expression is too long");
    switch (o.kind) {
      case Kind::parameter:
        if (o.slot < p.arity_)
          push(p, o, {Code::argument, 0, std::uint32_t(o.slot)});
        else
          pushNumber(p, o, counters_[std::size_t(o.slot - p.arity_)]);
        return true;
      case Kind::unary:
      case Kind::binary:
        if (o.op == Op::plus && e.operands.size() == 1) return add(p, *e.operands[0], below);
        return addCall(p, e, below, {codeOf(o)});  // !, -, and what has two operands
      case Kind::choose:
        return addChoice(p, e, below);
      case Kind::series:
        return addSeries(p, e, below);
      case Kind::builtin:
        return addBuiltin(p, e, below);
      case Kind::invoke:
        return addInner(p, e, below);
      default:
        return addConstant(p, e);
    }
  }

  /// Only one of the branches is computed; a 0 takes the place of the other.
  bool addChoice(Program& p, const Expr& e, int below) {
    if (!add(p, *e.operands[0], below)) return false;
    for (const int branch : {1, 2}) {
      const std::size_t skip = p.steps.size();
      push(p, e.operation, {branch == 1 ? Code::skipUnless : Code::skipIf});
      if (!add(p, *e.operands[std::size_t(branch)], below + branch)) return false;
      p.steps[skip].index = std::uint32_t(p.steps.size());
    }
    push(p, e.operation, {Code::choose, 3});
    return true;
  }

  /// The body once for each turn, with the counter as a constant.
  bool addSeries(Program& p, const Expr& e, int below) {
    const Operation& o = e.operation;
    double bounds[2] = {};
    for (const std::size_t i : {0, 1}) {
      const Expr& bound = *e.operands[i];
      if (hasParameter(bound, p.arity_))
        return fail(bound.operation.span,
                    "a sum or a product in a function that a block takes has bounds that do not "
                    "depend on its parameters");
      const auto x = counted(bound, p.arity_);
      if (!x) return false;
      bounds[i] = *x;
    }
    pushNumber(p, o, o.op == Op::plus ? 0 : 1);
    const std::size_t counter = counters_.size();
    for (double i = bounds[0]; i <= bounds[1]; ++i) {
      counters_.resize(counter);
      counters_.push_back(i);
      if (!add(p, *e.operands[2], below + 1)) return false;
      push(p, o, {o.op == Op::plus ? Code::plus : Code::times, 2});
      if (p.cost > kDearest)
        return fail(o.span, "this takes more than " + std::to_string(kDearest) + " steps");
    }
    counters_.resize(counter);
    return true;
  }

  /// The value of an expression that depends on nothing but counters.
  std::optional<double> counted(const Expr& e, int arity) {
    Program p;
    p.arity_ = arity;
    Program::Run notes;
    if (!add(p, e, 0)) return {};
    return p.run(nullptr, notes);
  }

  bool addBuiltin(Program& p, const Expr& e, int below) {
    const Builtin& builtin = *e.operation.name->builtin;
    const Code code = Program::codeOf(builtin.name);
    if (code == Code::unknown) return addConstant(p, e);
    const std::size_t count = e.operands.size();
    if (!builtin.fits(count))
      return fail(e.operation.span, *e.operation.name + "() does not take " +
                                        std::to_string(count) +
                                        (count == 1 ? " argument" : " arguments"));
    return addCall(p, e, below, {code});
  }

  bool addInner(Program& p, const Expr& e, int below) {
    const auto inner = program(*std::get<FunctionPtr>(e.operands[0]->value));
    if (!inner) return false;
    const int count = int(e.operands.size()) - 1;
    if (count != inner->arity())
      return fail(e.operation.span,
                  "the function '" + *e.operation.name + "' takes " +
                      std::to_string(inner->arity()) +
                      (inner->arity() == 1 ? " argument, found " : " arguments, found ") +
                      std::to_string(count));
    p.depth = std::max(p.depth, inner->depth + 1);
    p.cost += inner->cost;
    p.inner.push_back(inner);
    return addCall(p, e, below, {Code::inner, 0, std::uint32_t(p.inner.size() - 1)}, 1);
  }

  /// The operands from `first` on, then the step.
  bool addCall(Program& p, const Expr& e, int below, Program::Step step, std::size_t first = 0) {
    for (std::size_t i = first; i < e.operands.size(); ++i)
      if (!add(p, *e.operands[i], below + int(i - first))) return false;
    step.count = std::uint16_t(e.operands.size() - first);
    push(p, e.operation, step);
    return true;
  }

  /// Any other expression must already be a number: `A[2]`, `vlength(V)`, `Gold.red`.
  bool addConstant(Program& p, const Expr& e) {
    if (hasParameter(e))
      return fail(e.operation.span,
                  "a function that a block takes is made of numbers: vectors, colours and "
                  "arrays cannot depend on its parameters");
    const Reporter::Muted muted(context_.reporter, !use_);
    const Datum d = Evaluator(context_).evaluate(e);
    const Numbers* n = numbers(d);
    if (isBroken(d)) return false;
    if (!n || n->size != 1)
      return fail(e.operation.span,
                  "a function that a block takes is made of numbers, found " + describe(d));
    pushNumber(p, e.operation, n->v[0]);
    return true;
  }

  void pushNumber(Program& p, const Operation& o, double x) {
    reserveOne(p, o, p.constants);
    p.constants.push_back(x);
    push(p, o, {Code::constant, 0, std::uint32_t(p.constants.size() - 1)});
  }

  /// Whether it depends on one of the first slots; counters come behind the parameters.
  static bool hasParameter(const Expr& e, int slots = std::numeric_limits<int>::max()) {
    if (e.operation.kind == Kind::parameter) return e.operation.slot < slots;
    return std::any_of(e.operands.begin(), e.operands.end(), [slots](const ExprPtr& operand) {
      return operand && hasParameter(*operand, slots);
    });
  }

  void push(Program& p, const Operation& o, Program::Step step) {
    reserveOne(p, o, p.steps);
    p.steps.push_back(step);
    ++p.cost;
  }

  /// Space for one more element, which counts as long as the program lives.
  template <class Vector>
  void reserveOne(Program& p, const Operation& o, Vector& v) {
    if (v.size() < v.capacity()) return;
    const std::size_t wanted = v.size() + v.size() / 2 + 4;
    context_.budget.need(o.span, double(wanted * sizeof v[0]));
    p.bytes.grow(std::int64_t((wanted - v.capacity()) * sizeof v[0]));
    v.reserve(wanted);
  }

  Context& context_;
  const Span* use_;
  int level_ = 0;                 ///< of functions within functions
  std::vector<double> counters_;  ///< of the sums and products around a step, as they are now
};

}  // namespace

std::shared_ptr<const Program> programOf(Context& context, const Function& function,
                                         const Span& span) {
  return Compiler(context, &span).program(function);
}

const Program* programForCalls(Context& context, const Function& function) {
  if (!function.program && !function.isTree)
    function.isTree = !Compiler(context, nullptr).program(function);
  return function.program.get();
}

}  // namespace vestige::lang
