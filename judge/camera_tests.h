// SPDX-License-Identifier: Apache-2.0
// Tests of the contract in camera.h.
#pragma once
#include <vestige/camera.h>

#include "judge/differences.h"
#include "judge/made.h"
#include "judge/plain.h"
#include "judge/verdict.h"

namespace vestige::judge {

struct CameraCase {
  std::string title;  ///< "camera pinhole { angle 40 }"
  std::shared_ptr<const Camera> camera;
};
using CameraCases = std::vector<CameraCase>;

/// Defaults, and random values for every row that plainValue() has one for.
CameraCases cameraCases(const Plugin& plugin, int sets, unsigned seed, TriedRows* rows = nullptr);

Event cameraEvent(const CameraCase& c, CameraNumbers n, const std::string& what);

/// Random events: f(case, numbers, random).
template <class F>
void forCameraEvents(const CameraCases& cases, const Effort& effort, const F& f) {
  Random r(effort.seed);
  for (const CameraCase& c : cases)
    for (int i = 0; i < effort.events(); ++i) {
      const Vec2 film = r.pair(), lens = r.pair();
      f(c, CameraNumbers{film, lens, r.number(Real(0.5), 2)}, r);
    }
}

// camera_density.cpp
struct CameraDensityFindings {
  Finding distribution;  ///< rays of uniform film points are distributed as pdf(): chi-square
  Finding mass;          ///< pdf() integrates to 1 - P(nullopt)
};
/// Tests each lens point separately; skips cameras without a density.
CameraDensityFindings cameraRaysFollowPdf(const CameraCases& cases, const Effort& effort);

// camera_tests.cpp
/// Per unit of film and of lens coordinate.
Finding cameraRaysAreDifferentiated(const CameraCases& cases, const Effort& effort);
/// |dDirection[0] x dDirection[1]| pdf() = 1 wherever there is a density.
Finding cameraAreaIsInverseDensity(const CameraCases& cases, const Effort& effort);
Finding cameraIsNeverNan(const CameraCases& cases, const Effort& effort);

// camera_threads.cpp
Finding cameraAnswersStayTheSame(const CameraCases& cases, const Effort& effort);
std::vector<Timing> cameraTimings(const CameraCases& cases);

}  // namespace vestige::judge
