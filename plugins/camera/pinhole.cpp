// SPDX-License-Identifier: Apache-2.0
// Perspective through a point: everything is sharp.
//
//     d = forward + tan(angle/2) ((2x - 1) right + (1 - 2y)/aspect up)        [MATH 1.1]
//
// MATH is docs/mathematics.md, here and in the other cameras.
#include <vestige/tools/view_frame.h>

namespace vestige {
namespace {

class Pinhole final : public Camera {
 public:
  enum Row { kAngle = kViewRows };

  static Schema schema() {
    return {.kind = "camera",
            .name = "pinhole",
            .summary = "perspective, sharp at every distance",
            .params = viewRows({PerspectiveFilm::row()})};
  }

  explicit Pinhole(const Values& values)
      : view_(viewFrame(values)), film_(PerspectiveFilm::of(values, kAngle)) {}

  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    return CameraSample{view_.location, normalize(film_.toPoint(view_, n.film, n.aspect))};
  }

  Real pdf(Vec3, Vec3 direction, Real aspect) const noexcept override {
    return film_.pdf(view_, direction, direction, aspect);
  }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    const Vec3 d = film_.toPoint(view_, n.film, n.aspect), direction = normalize(d);
    const Mat3x2 du = (1 / length(d)) * (projection(direction) * film_.du(view_, n.aspect));
    return {.dOrigin = {}, .dDirection = {du.c[0], du.c[1]}};
  }

 private:
  ViewFrame view_;
  PerspectiveFilm film_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::Pinhole)
