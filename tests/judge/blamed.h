// SPDX-License-Identifier: Apache-2.0
// What the judge said, checked.
#pragma once
#include "judge/judge.h"
#include "support/catch.h"

namespace vestige::test {

inline std::string failures(const judge::Judgement& j) {
  std::string text;
  for (const judge::Verdict& v : j.verdicts)
    if (!v.passed) text += v.test + ": " + v.sentence + "\n    " + v.worst + "\n";
  return text;
}

/// The first failure names the method, in a sentence and with the event.
inline void checkBlamed(const judge::Judgement& j, const std::string& method) {
  INFO(failures(j));
  REQUIRE(j.failure());
  CHECK(j.failure()->method == method);
  CHECK_THAT(j.failure()->sentence, containsText(method + " is wrong: "));
  CHECK(j.failure()->excess > 1);
  CHECK_THAT(j.failure()->worst, containsText("broken"));
}

}  // namespace vestige::test
