// SPDX-License-Identifier: Apache-2.0
// All tests of a camera, and the method at fault.
#include "judge/judge.h"

namespace vestige::judge {

Judgement judgeCamera(const CameraCases& cases, const Effort& e) {
  const CameraDensityFindings density = cameraRaysFollowPdf(cases, e);
  const Finding rays = cameraRaysAreDifferentiated(cases, e);
  const Finding area = cameraAreaIsInverseDensity(cases, e);
  // Three statements about one map, as for BRDFs: if neither pdf() nor the derivative agrees with
  // the map, the map is wrong.
  const bool isDensity = density.distribution.passed() && density.mass.passed();
  const std::string map = !isDensity && !rays.passed() ? "sample()" : "";
  const std::string ofArea = !map.empty() ? map : rays.passed() ? "pdf()" : rays.method;
  Judgement j;
  j.verdicts = {verdictOf(cameraAnswersStayTheSame(cases, e)),
                verdictOf(cameraIsNeverNan(cases, e)),
                verdictOf(density.distribution, map),
                verdictOf(density.mass, map),
                verdictOf(rays, map),
                verdictOf(area, ofArea)};
  j.timings = cameraTimings(cases);
  return j;
}

}  // namespace vestige::judge
