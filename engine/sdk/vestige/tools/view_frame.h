// SPDX-License-Identifier: Apache-2.0
// Location and axes of cameras, and the flat film of perspective cameras.
//
// The world is left-handed: with y up and the view along +z, +x is on the right of the picture.
#pragma once
#include <vector>

#include <vestige/camera.h>
#include <vestige/plugin.h>
#include <vestige/tools/words.h>

namespace vestige {

/// The first rows of every camera's schema; a camera's own rows begin at kViewRows.
enum ViewRow { kLocation, kLookAt, kSky, kViewRows };

/// These rows, followed by a camera's own.
inline std::vector<Parameter> viewRows(const std::vector<Parameter>& own = {}) {
  std::vector<Parameter> rows = {
      vec3("location", {0, 0, 0}).in("scene units").doc("where the camera stands"),
      vec3("look_at", {0, 0, 1}).in("scene units").doc("the point in the middle of the picture"),
      vec3("sky", {0, 1, 0}).doc("the direction that is upwards in the picture")};
  rows.insert(rows.end(), own.begin(), own.end());
  return rows;
}

/// A camera's place and axes in world space. Axes are unit and orthogonal, even under a shearing
/// transform; a mirroring transform flips `right`, so that the picture is mirrored.
struct ViewFrame {
  Vec3 location;
  Vec3 right, up, forward;
  Real across, along;  ///< world length of a unit of length sideways and along the view
};

/// The axes before the block's transform. Throws PluginError if the rows do not determine them.
inline ViewFrame ownViewFrame(const Values& values) {
  const Vec3 location = values.vec3(kLocation), lookAt = values.vec3(kLookAt);
  const Vec3 sky = values.vec3(kSky), forward = normalize(lookAt - location);
  if (lengthSquared(forward) == 0)
    throw PluginError(kLookAt, "look_at is " + words(lookAt) +
                                   ", the camera's own location: expected another point");
  if (lengthSquared(sky) == 0)
    throw PluginError(kSky, "sky has no direction: expected a vector such as <0, 1, 0>");
  // In a left-handed world right = up x forward by the plain formula for cross products.
  const Vec3 right = cross(normalize(sky), forward);
  if (length(right) < Real(1e-5))
    throw PluginError(kSky, "sky " + words(sky) + " lies along the view direction " +
                                words(forward) + ": expected one that points sideways of it");
  const Vec3 r = normalize(right);
  return {location, r, cross(forward, r), forward, 1, 1};
}

/// The camera's place and axes in world space. Throws PluginError as above.
inline ViewFrame viewFrame(const Values& values) {
  const ViewFrame own = ownViewFrame(values);
  const Affine& m = values.toWorld();
  const Vec3 forward = normalize(m.vector(own.forward)), up = m.vector(own.up);
  const Vec3 right = normalize(cross(up, forward));
  const Real side = m.determinant() < 0 ? Real(-1) : Real(1);
  return {m.point(own.location),       side * right,
          cross(forward, right),       forward,
          length(m.vector(own.right)), length(m.vector(own.forward))};
}

/// The flat film of a perspective camera, one unit in front of the eye.
struct PerspectiveFilm {
  Real halfWidth = 0;  ///< tangent of half the horizontal angle

  /// The row `angle` of a schema: full horizontal angle, POV-Ray's default.
  static Parameter row() {
    return real("angle", 67.380135).range(0, 180).in("degrees").doc("horizontal field of view");
  }
  /// Throws PluginError at that row.
  static PerspectiveFilm of(const Values& values, int angleRow) {
    const Real angle = values.real(angleRow);
    if (!(angle > 0 && angle < 180))
      throw PluginError(angleRow, "angle is " + words(angle) +
                                      ": expected more than 0 and less than 180 degrees (camera "
                                      "panorama sees all around)");
    return {std::tan(radians(angle) / 2)};
  }

  /// Vector from the eye to a film point; its component along the view is 1.
  Vec3 toPoint(const ViewFrame& v, Vec2 film, Real aspect) const noexcept {
    const Vec2 p = {halfWidth * (2 * film.x - 1), halfWidth / aspect * (1 - 2 * film.y)};
    return v.forward + p.x * v.right + p.y * v.up;
  }
  /// Columns: how that point moves, per unit of film coordinate [MATH 1.1].
  Mat3x2 du(const ViewFrame& v, Real aspect) const noexcept {
    return {2 * halfWidth * v.right, -2 * halfWidth / aspect * v.up};
  }
  /// Density for uniform film points of the unit `direction` that goes through film point
  /// `toPoint` (any length), 1/sr; 0 off the film.
  Real pdf(const ViewFrame& v, Vec3 toPoint, Vec3 direction, Real aspect) const noexcept {
    const Real z = dot(toPoint, v.forward), c = dot(direction, v.forward);
    if (!(z > 0 && c > 0)) return 0;
    const Real h = halfWidth / aspect, edge = 1 + Real(1e-6);  // the rim itself is on the film
    if (std::abs(dot(toPoint, v.right)) > z * halfWidth * edge) return 0;
    if (std::abs(dot(toPoint, v.up)) > z * h * edge) return 0;
    return 1 / (4 * halfWidth * h * c * c * c);  // d(solid angle) = cos^3 d(area) at distance 1
  }
};

}  // namespace vestige
