// SPDX-License-Identifier: Apache-2.0
// Everything around, as a latitude-longitude picture: look_at is in the middle, the sky along the
// upper edge, longitude grows to the right. Twice as wide as high shows it undistorted; the picture
// looks as light environment takes its images, turned by nothing if the view is along +z.
#include <vestige/tools/view_frame.h>

namespace vestige {
namespace {

class Panorama final : public Camera {
 public:
  static Schema schema() {
    return {.kind = "camera",
            .name = "panorama",
            .summary = "the whole sphere around the camera, latitude and longitude",
            .params = viewRows()};
  }

  explicit Panorama(const Values& values) : view_(viewFrame(values)) {}

  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    const Angles a(n.film);
    return CameraSample{view_.location, world(a.cosUp * a.sinSide, a.sinUp, a.cosUp * a.cosSide)};
  }

  Real pdf(Vec3, Vec3 direction, Real) const noexcept override {
    // The poles have a whole edge of the film each: the density stays finite by a clamp.
    const Real side = std::hypot(dot(direction, view_.right), dot(direction, view_.forward));
    return 1 / (2 * kPi * kPi * std::max(side, Real(1e-6)));
  }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    const Angles a(n.film);
    const Vec3 dx = 2 * kPi * a.cosUp * world(a.cosSide, 0, -a.sinSide);
    const Vec3 dy = -kPi * world(-a.sinUp * a.sinSide, a.cosUp, -a.sinUp * a.cosSide);
    return {.dOrigin = {}, .dDirection = {dx, dy}};
  }

 private:
  /// Longitude from the middle to the right, latitude from the horizon up.
  struct Angles {
    Real sinSide, cosSide, sinUp, cosUp;
    explicit Angles(Vec2 film) noexcept {
      const Real side = kPi * (2 * film.x - 1), up = kPi * (Real(0.5) - film.y);
      sinSide = std::sin(side), cosSide = std::cos(side), sinUp = std::sin(up);
      cosUp = std::cos(up);
    }
  };
  Vec3 world(Real right, Real up, Real forward) const noexcept {
    return right * view_.right + up * view_.up + forward * view_.forward;
  }

  ViewFrame view_;
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::Panorama)
