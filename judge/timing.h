// SPDX-License-Identifier: Apache-2.0
// Time of a call of a method.
#pragma once
#include <vestige/math.h>

#include <chrono>
#include <vector>

namespace vestige::judge {

/// Nanoseconds per call of `call(question)`, which returns a number from its result; 0 without
/// questions.
template <class Question, class Call>
double nanoseconds(const std::vector<Question>& questions, const Call& call) {
  using Clock = std::chrono::steady_clock;
  if (questions.empty()) return 0;
  const auto start = Clock::now();
  std::size_t calls = 0;
  Real sum = 0;  // so that nothing is optimised away
  do {
    for (const Question& q : questions) sum += call(q);
    calls += questions.size();
  } while (Clock::now() - start < std::chrono::milliseconds(10));
  const volatile Real keep = sum;
  (void)keep;
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / double(calls);
}

}  // namespace vestige::judge
