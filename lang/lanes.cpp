// SPDX-License-Identifier: Apache-2.0
// Programs on eight numbers at once.
#include <algorithm>

#include "lang/program_steps.h"

namespace vestige::lang {
namespace {

using Code = Program::Code;

constexpr int kLanes = 8;

struct Lanes {
  double v[kLanes];
  Lanes() = default;
  explicit Lanes(double x) { std::fill(v, v + kLanes, x); }
};

/// Two operands, in a loop that the compiler can vectorise.
template <class F>
Lanes each(const Lanes* a, F f) {
  Lanes r;
  for (int k = 0; k < kLanes; ++k) r.v[k] = f(a[0].v[k], a[1].v[k]);
  return r;
}

/// Any step, lane by lane.
Lanes oneByOne(Code code, const Lanes* a, int n) {
  Lanes r;
  double operands[Program::kStack];
  bool doubt = false;
  for (int k = 0; k < kLanes; ++k) {
    for (int i = 0; i < n; ++i) operands[i] = a[i].v[k];
    r.v[k] = applyStep(code, operands, n, doubt);
  }
  return r;
}

Lanes apply(Code code, const Lanes* a, int n) {
  switch (code) {
    case Code::plus:
      return each(a, [](double x, double y) { return x + y; });
    case Code::minus:
      return each(a, [](double x, double y) { return x - y; });
    case Code::times:
      return each(a, [](double x, double y) { return x * y; });
    default:
      return oneByOne(code, a, n);
  }
}

}  // namespace

void Program::evalLanes(const double* args, double* values) const noexcept {
  Lanes given[kStack];
  const int count = std::min(arity_, kStack);
  for (int i = 0; i < count; ++i) std::copy_n(args + kLanes * i, kLanes, given[i].v);
  const Lanes result = walk(*this, given, apply);
  std::copy_n(result.v, kLanes, values);
}

}  // namespace vestige::lang
