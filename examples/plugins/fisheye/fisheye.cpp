// SPDX-License-Identifier: Apache-2.0
// An equidistant fisheye: the angle from the view grows evenly with the distance from the middle of
// the film, up to angle / 2 at its left and right edge. Beyond that circle the film sees nothing.
#include <vestige/dual_camera.h>

namespace vestige {
namespace {

class Fisheye final : public DualCamera<Fisheye> {
 public:
  enum Row { kAngle = kViewRows };

  static Schema schema() {
    return {.kind = "camera",
            .name = "fisheye",
            .summary = "equidistant fisheye",
            .params = viewRows(
                {real("angle", 180).range(1, 360).in("degrees").doc("across the image circle")})};
  }

  explicit Fisheye(const Values& values)
      : DualCamera(viewFrame(values)), reach_(radians(values.real(kAngle)) / 2) {}

  template <class T>
  std::optional<TRay<T>> ray(const TVec2<T>& film, const TVec2<T>&, Real aspect) const noexcept {
    using std::cos, std::sin, std::sqrt;
    const T x = T(2) * film.x - T(1), y = (T(1) - T(2) * film.y) / T(aspect);
    const T r = sqrt(x * x + y * y);
    if (value(r) > 1) return std::nullopt;
    const T angle = T(reach_) * r;
    const T stretch = value(r) > Real(1e-3) ? sin(angle) / r : T(reach_);
    return TRay<T>{{}, {stretch * x, stretch * y, cos(angle)}};
  }

  /// (r dr) / (sin a da), times the film's share of the circle's square.
  Real pdf(Vec3, Vec3 direction, Real aspect) const noexcept override {
    const Vec3 d = inView(direction);
    const Real sine = std::hypot(d.x, d.y), r = std::atan2(sine, d.z) / reach_;
    const Real up = sine > 0 ? std::abs(d.y) / sine * r : 0;
    if (r > 1 || up > 1 / aspect) return 0;
    return aspect / 4 / reach_ * (sine > Real(1e-6) ? r / sine : 1 / reach_);
  }

 private:
  Real reach_;  ///< rad
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::Fisheye)
