// SPDX-License-Identifier: Apache-2.0
// Perspective through a round lens: sharp in one plane across the view, blurred before and behind.
//
// A film point is seen sharply at `focus` = eye + f d, with d as in camera pinhole and f the
// distance of the plane of focus along the view; the ray to it starts anywhere on the lens
// [MATH 1.2]. The lens adds two random numbers: without their derivatives, textures would blur
// exactly where the picture is sharp.
#include <vestige/tools/sampling.h>
#include <vestige/tools/view_frame.h>

namespace vestige {
namespace {

class ThinLens final : public Camera {
 public:
  enum Row { kAngle = kViewRows, kAperture, kFocalPoint, kFocusDistance };

  static Schema schema() {
    return {
        .kind = "camera",
        .name = "thin_lens",
        .summary = "perspective with depth of field",
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
                 .doc("the plane of focus goes through it; without it and focus_distance: look_at"),
             real("focus_distance", 0)
                 .unset()
                 .positive()
                 .in("scene units")
                 .doc("distance of the plane of focus along the view, in place of focal_point")})};
  }

  explicit ThinLens(const Values& values)
      : view_(viewFrame(values)),
        film_(PerspectiveFilm::of(values, kAngle)),
        focus_(focusDistance(values)),
        lensRadius_(values.real(kAperture) / 2 * view_.across) {
    if (!(lensRadius_ >= 0))
      throw PluginError(kAperture, "aperture is " + words(values.real(kAperture)) +
                                       ": expected the diameter of the lens, 0 or more");
  }

  std::optional<CameraSample> sample(CameraNumbers n) const noexcept override {
    const Ray r = ray(n);
    return CameraSample{r.origin, normalize(r.direction)};
  }

  Real pdf(Vec3 origin, Vec3 direction, Real aspect) const noexcept override {
    const Real c = dot(direction, view_.forward);
    if (!(c > 0)) return 0;
    const Vec3 inFocus = origin + focus_ / c * direction;  // uniform there, whatever the origin
    return film_.pdf(view_, inFocus - view_.location, direction, aspect);
  }

  RayJacobian sampleDerivatives(CameraNumbers n) const noexcept override {
    const Vec3 toFocus = ray(n).direction;
    const Mat3 across = (1 / length(toFocus)) * projection(normalize(toFocus));
    const Mat3x2 film = across * (focus_ * film_.du(view_, n.aspect));
    const Disk k = concentricDisk(n.lens);
    const Vec3 du = onLens(k.du[0]), dv = onLens(k.du[1]);
    return {.dOrigin = {Vec3{}, Vec3{}, du, dv},
            .dDirection = {film.c[0], film.c[1], -(across * du), -(across * dv)}};
  }

  int variables() const noexcept override { return lensRadius_ > 0 ? 4 : 2; }

 private:
  Real focusDistance(const Values& values) const {
    if (values.has(kFocusDistance)) {
      if (values.has(kFocalPoint))
        throw PluginError(kFocusDistance,
                          "focal_point and focus_distance are both given: expected one of them");
      const Real f = values.real(kFocusDistance);
      if (!(f > 0))
        throw PluginError(kFocusDistance,
                          "focus_distance is " + words(f) + ": expected more than 0");
      return f * view_.along;
    }
    const int row = values.has(kFocalPoint) ? int(kFocalPoint) : int(kLookAt);
    const Vec3 point = values.vec3(row);
    const Real f = dot(values.toWorld().point(point) - view_.location, view_.forward);
    if (!(f > 0))
      throw PluginError(row, "focal_point " + words(point) +
                                 " lies behind the camera or beside it: expected a point in "
                                 "front");
    return f;
  }

  /// Vector from the eye to a point of the lens, given on the unit disk.
  Vec3 onLens(Vec2 d) const noexcept { return lensRadius_ * (d.x * view_.right + d.y * view_.up); }
  /// Ray from the lens to the plane of focus; the direction has the length of the distance.
  Ray ray(CameraNumbers n) const noexcept {
    const Vec3 lens = onLens(concentricDisk(n.lens).d);
    return {view_.location + lens, focus_ * film_.toPoint(view_, n.film, n.aspect) - lens};
  }

  ViewFrame view_;
  PerspectiveFilm film_;
  Real focus_, lensRadius_;  ///< world, scene units
};

}  // namespace
}  // namespace vestige

VESTIGE_PLUGIN(vestige::Camera, vestige::ThinLens)
