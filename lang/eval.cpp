// SPDX-License-Identifier: Apache-2.0
#include "lang/eval.h"

#include "lang/function.h"
#include "lang/spline.h"

namespace vestige::lang {
namespace {

/// A node of a function costs more than a token.
constexpr std::int64_t kStepsANode = 2;

}  // namespace

std::optional<bool> Evaluator::condition(const Operand& operand) {
  const auto x = operations_.number(operand, "the condition of '?'");
  return x ? std::optional(isTrue(*x)) : std::nullopt;
}

Datum Evaluator::evaluate(const Expr& e, Arguments a) {
  const Operation& o = e.operation;
  context_.step(o.span, kStepsANode);
  if (o.kind == Operation::Kind::constant) return e.value;
  if (o.kind == Operation::Kind::parameter) return Numbers(a[std::size_t(o.slot)]);
  const Deeper deeper(context_, o.span);
  if (o.kind == Operation::Kind::choose) return choose(e, a);
  if (o.kind == Operation::Kind::series) return series(e, a);
  std::vector<Operand> operands(e.operands.size());
  for (std::size_t i = 0; i < operands.size(); ++i)
    if (const Expr* operand = e.operands[i].get())
      operands[i] = {evaluate(*operand, a), operand->operation.span};
  return apply(o, operands);
}

Datum Evaluator::choose(const Expr& e, Arguments a) {
  const Expr& test = *e.operands[0];
  const auto isFirst = condition({evaluate(test, a), test.operation.span});
  return isFirst ? evaluate(*e.operands[*isFirst ? 1 : 2], a) : Datum();
}

/// Each turn is paid for by the steps of its body.
Datum Evaluator::series(const Expr& e, Arguments a) {
  const Operation& o = e.operation;
  double bounds[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto x = operations_.number({evaluate(*e.operands[i], a), e.operands[i]->operation.span},
                                      "a bound of a sum");
    if (!x) return {};
    bounds[i] = *x;
  }
  const Expr& body = *e.operands[2];
  std::vector<double> own(a.begin(), a.end());
  own.resize(std::size_t(o.slot) + 1);
  double& counter = own.back();
  double total = o.op == Op::plus ? 0 : 1;
  for (counter = bounds[0]; counter <= bounds[1]; ++counter) {
    const auto x = operations_.number({evaluate(body, own), body.operation.span}, "a sum");
    if (!x) return {};
    total = o.op == Op::plus ? total + *x : total * *x;
  }
  return Numbers(total);
}

Datum Evaluator::invoke(const Operation& o, std::span<const Operand> operands) {
  const auto* function = std::get_if<FunctionPtr>(&operands[0].value);
  if (!function) return {};  // already reported
  const Function& f = **function;
  context_.step(o.span);
  const std::size_t wanted = f.body ? f.parameters.size() : f.spline ? 1 : 3;
  const std::size_t found = operands.size() - 1;
  if (found != wanted) {
    context_.reporter.error(o.span, "the function '" + *o.name + "' takes " +
                                        std::to_string(wanted) +
                                        (wanted == 1 ? " argument" : " arguments") + ", found " +
                                        std::to_string(found));
    return {};
  }
  arguments_.resize(wanted);
  for (std::size_t i = 0; i < wanted; ++i) {
    const Numbers* n = numbers(operands[i + 1].value);
    const bool isNumber = n && n->size == 1;
    if (!isNumber) {
      operations_.number(operands[i + 1], ("'" + *o.name + "'").c_str());
      return {};
    }
    arguments_[i] = n->v[0];
  }
  return call(o, f);
}

/// The value at `arguments_`. The tree is evaluated where the program cannot: for what is not a
/// number, and for warnings and errors.
Datum Evaluator::call(const Operation& o, const Function& f) {
  const std::vector<double>& a = arguments_;
  if (f.spline) return f.spline->at(a[0], Word::none);
  if (!f.body) {
    Numbers r(0, 0, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& m = f.transform.m[i];
      r.v[i] = m[0] * a[0] + m[1] * a[1] + m[2] * a[2] + m[3];
    }
    return r;
  }
  if (const Program* program = programForCalls(context_, f)) {
    Program::Run run;
    const double x = program->run(a.data(), run);
    context_.step(o.span, run.steps * kStepsANode);
    if (!run.doubt) return Numbers(x);
  }
  const std::vector<double> own = a;  // inner calls take the others
  return evaluate(*f.body, own);
}

}  // namespace vestige::lang
