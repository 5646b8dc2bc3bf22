// SPDX-License-Identifier: Apache-2.0
// All tests of a camera, and who is to blame.
#include "judge/judge.h"

namespace vestige::judge {

Judgement judgeCamera(const CameraCases& cases, const Effort& e) {
  const Finding rays = cameraRaysAreDifferentiated(cases, e);
  Judgement j;
  j.verdicts = {verdictOf(cameraAnswersStayTheSame(cases, e)),
                verdictOf(cameraIsNeverNan(cases, e)), verdictOf(rays),
                verdictOf(cameraAreaIsInverseDensity(cases, e), rays.passed() ? "" : rays.method)};
  j.timings = cameraTimings(cases);
  return j;
}

}  // namespace vestige::judge
