// SPDX-License-Identifier: Apache-2.0
// A view camera: a lens of some aperture whose plane of focus may be tilted, and whose film may be
// shifted. Tilted, it is sharp along a plane that runs away from the camera (a table from end to
// end), or in a narrow band only, which makes a town look like a toy.
//
// As camera thin_lens, but the points of focus lie on the plane through `focal_point` with normal
// n = forward turned by `tilt` downwards and by `swing` to the right: the point for direction d is
// eye + k d with k = reach / (n . d), reach = n . (focal_point - eye). That changes with the film:
// dk = -k (n . dd) / (n . d).
#include <vestige/tools/sampling.h>
#include <vestige/tools/view_frame.h>

namespace vestige {
namespace {

class TiltShift final : public Camera {
 public:
  enum Row { kAngle = kViewRows, kAperture, kFocalPoint, kTilt, kSwing, kShift };

  static Schema schema() {
    return {
        .kind = "camera",
        .name = "tilt_shift",
        .summary = "perspective with depth of field, tilted focus and shifted film",
        .params = viewRows(
            {PerspectiveFilm::row(),
             real("aperture", 0)
                 .range(0, 1e12)
                 .need()
                 .in("scene units")
                 .doc("diameter of the lens; 0 is a pinhole"),
             vec3("focal_point", {0, 0, 0})
                 .unset()
                 .in("scene units")
                 .doc("the plane of focus goes through it; without it: look_at"),
             real("tilt", 0).range(-89, 89).in("degrees").doc(
                 "turns the plane of focus towards the floor"),
             real("swing", 0).range(-89, 89).in("degrees").doc("... and to the right"),
             vec2("shift", {0, 0})
                 .range(-1e6, 1e6)
                 .doc("of the film, to the right and upwards: 1 takes what is 45 degrees aside to "
                      "the middle")})};
  }

  explicit TiltShift(const Values& values)
      : view_(viewFrame(values)),
        film_(PerspectiveFilm::of(values, kAngle)),
        shift_(values.vec2(kShift)),
        lensRadius_(values.real(kAperture) / 2 * view_.across),
        normal_(normalize(view_.forward - std::tan(radians(values.real(kTilt))) * view_.up +
                          std::tan(radians(values.real(kSwing))) * view_.right)) {
    const int row = values.has(kFocalPoint) ? int(kFocalPoint) : int(kLookAt);
    const Vec3 point = values.toWorld().point(values.vec3(row)) - view_.location;
    reach_ = dot(normal_, point);
    if (!(dot(point, view_.forward) > 0 && reach_ > 0))
      throw PluginError(row, "the plane of focus through " + words(values.vec3(row)) +
                                 " does not pass in front of the camera: expected another point, "
                                 "or less tilt");
  }

  /// Nullopt where the plane of focus is never reached.
  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    const Vec3 d = toPoint(n);
    if (!isInFocus(d)) return std::nullopt;
    const Vec3 lens = onLens(concentricDisk(n.lens).d);
    return CameraSample{view_.location + lens, normalize(focus(d) - lens)};
  }

  Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept override {
    const Vec3 lens = origin - view_.location;
    const Real c = dot(direction, normal_);
    if (!(c > 0)) return 0;
    // Back to the film: through the point of focus, seen from the eye.
    const Real way = (reach_ - dot(normal_, lens)) / c;
    const Vec3 point = lens + way * direction;
    const Real z = dot(point, view_.forward);
    if (!(z > 0 && way > 0)) return 0;
    const Vec3 d = point / z;
    if (!isInFocus(d)) return 0;
    // Solid angle at the lens over that at the eye, of one patch of the plane of focus.
    const Real r2 = lengthSquared(point), eye = dot(point, normal_) / (r2 * std::sqrt(r2));
    const Real here = c / sqr(way);
    return film_.pdf(view_, d - shift(), normalize(d), aspect) * eye / here;
  }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    const Vec3 d = toPoint(n);
    if (!isInFocus(d)) return {};
    const Disk k = concentricDisk(n.lens);
    const Vec3 toFocus = focus(d) - onLens(k.d);
    const Mat3 across = (1 / length(toFocus)) * projection(normalize(toFocus));
    const Mat3x2 dd = film_.du(view_, n.aspect);
    const Real scale = reach_ / dot(normal_, d);
    const auto moved = [&](Vec3 c) {
      return across * (scale * (c - dot(normal_, c) / dot(normal_, d) * d));
    };
    const Vec3 du = onLens(k.du[0]), dv = onLens(k.du[1]);
    return {.dOrigin = {Vec3{}, Vec3{}, du, dv},
            .dDirection = {moved(dd.c[0]), moved(dd.c[1]), -(across * du), -(across * dv)}};
  }

  int variables() const noexcept override { return lensRadius_ > 0 ? 4 : 2; }

 private:
  static constexpr Real kGrazing = Real(1e-3);  ///< beyond it focus is as good as at infinity

  Vec3 shift() const noexcept { return shift_.x * view_.right + shift_.y * view_.up; }
  /// From the eye to a film point; its part along the view is 1.
  Vec3 toPoint(CameraNumbers n) const noexcept {
    return film_.toPoint(view_, n.film, n.aspect) + shift();
  }
  bool isInFocus(Vec3 d) const noexcept { return dot(normal_, d) > kGrazing * length(d); }
  /// From the eye to the plane of focus along d.
  Vec3 focus(Vec3 d) const noexcept { return reach_ / dot(normal_, d) * d; }
  /// From the eye to a point of the lens, given on the unit disk.
  Vec3 onLens(Vec2 d) const noexcept { return lensRadius_ * (d.x * view_.right + d.y * view_.up); }

  ViewFrame view_;
  PerspectiveFilm film_;
  Vec2 shift_;
  Real lensRadius_;  ///< world, scene units
  Vec3 normal_;      ///< of the plane of focus, unit
  Real reach_ = 0;   ///< from the eye to that plane, along the normal
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::TiltShift)
