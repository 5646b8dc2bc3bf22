// SPDX-License-Identifier: Apache-2.0
#include "engine/render/start_path.h"

namespace vestige {
namespace {

/// The derivatives of a camera ray by the film's numbers, after the pixel filter.
RayJacobian filmJacobian(const PathSource& source, const CameraNumbers& numbers, FilterOffset dx,
                         FilterOffset dy) noexcept {
  RayJacobian jacobian = source.camera.sampleDerivatives(numbers);
  for (auto* d : {&jacobian.dOrigin, &jacobian.dDirection}) {
    (*d)[0] *= dx.slope / Real(source.width);
    (*d)[1] *= dy.slope / Real(source.height);
  }
  return jacobian;
}

}  // namespace

StartedPath startPath(const PathSource& source, int x, int y, std::uint32_t index,
                      const PathOutputs& outputs) noexcept {
  const Sampler sampler(std::uint32_t(x), std::uint32_t(y), index, source.seed);
  const Vec2 u = sampler.pair(dimension::kFilm);
  const FilterOffset dx = source.filter.sample(u.x);
  const FilterOffset dy = source.filter.sample(u.y);
  const Real w = Real(source.width), h = Real(source.height);
  const int variables = source.camera.variables();
  const CameraNumbers numbers{
      {(Real(x) + Real(0.5) + dx.offset) / w, (Real(y) + Real(0.5) + dy.offset) / h},
      variables > 2 ? sampler.pair(dimension::kLens) : Vec2{},
      w / h};
  constexpr CameraSample kNone{{}, {}, {}};
  const CameraSample ray = source.camera.sample(numbers).value_or(kNone);
  const bool isSeen = !isBlack(ray.weight);
  const Real time = 0;  // nothing moves yet; dimension::kTime is reserved for it
  return {{.scene = source.scene,
           .sampler = sampler,
           .ray = {ray.origin, ray.direction, 0, kInfinity, time, RayKind::camera,
                   source.scene.mediaAt(ray.origin)},
           .jacobian = source.wantsJacobian && isSeen ? filmJacobian(source, numbers, dx, dy)
                                                      : RayJacobian{},
           .cameraVariables = variables,
           .declaredSamples = source.declaredSamples,
           .counters = outputs.counters,
           .aovs = outputs.aovs,
           .wantsFootprint = source.wantsFootprint,
           .record = outputs.record},
          ray.weight};
}

}  // namespace vestige
