// SPDX-License-Identifier: Apache-2.0
// How every form of a program walks through its steps.
#pragma once
#include "lang/program.h"

namespace vestige::lang {

/// A step of `n` numbers, as the language computes it elsewhere. `doubt`: see Program::run().
double applyStep(Program::Code code, const double* a, int n, bool& doubt) noexcept;

/// The value of a program on numbers of type N, whose function `apply(code, operands, count)`
/// computes a step. Both branches of a choice are computed.
template <class N, class Apply>
N walk(const Program& program, const N* args, const Apply& apply) noexcept {
  using Code = Program::Code;
  N stack[Program::kStack];
  N* top = stack;  // one past the last number
  for (const Program::Step& s : program.steps) {
    if (s.code == Code::skipUnless || s.code == Code::skipIf) continue;
    top -= s.count;
    if (s.code == Code::argument)
      *top = args[s.index];
    else if (s.code == Code::constant)
      *top = N(program.constants[s.index]);
    else if (s.code == Code::inner)
      *top = walk(*program.inner[s.index], top, apply);
    else
      *top = apply(s.code, top, int(s.count));
    ++top;
  }
  return stack[0];
}

}  // namespace vestige::lang
