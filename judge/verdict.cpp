// SPDX-License-Identifier: Apache-2.0
#include "judge/verdict.h"

namespace vestige::judge {

bool Judgement::passed() const { return !failure(); }

const Verdict* Judgement::failure() const {
  for (const Verdict& v : verdicts)
    if (!v.passed) return &v;
  return nullptr;
}

Verdict verdictOf(const Finding& f, const std::string& culprit) {
  Verdict v{culprit.empty() ? f.method : culprit,
            f.test,
            f.passed(),
            "",
            f.worst.event.line,
            f.worst.error,
            f.worst.events};
  const Event& e = f.worst.event;
  if (!v.passed)
    v.sentence = v.method + " is wrong: " + e.where + (e.where.empty() ? "" : ", ") + e.what;
  else if (f.asked > 0 && f.judged <= f.asked / 3)
    v.sentence = "finite differences are conclusive at only " + std::to_string(f.judged) + " of " +
                 std::to_string(f.asked) + " events";
  return v;
}

}  // namespace vestige::judge
