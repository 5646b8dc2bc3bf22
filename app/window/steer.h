// SPDX-License-Identifier: Apache-2.0
// A camera moved by hand. Works on the camera's block, so that what is seen can be written into the
// scene's text.
#pragma once
#include <optional>
#include <string>

#include <vestige/schema.h>

namespace vestige::app {

/// Where a camera stands and looks, in world space.
struct View {
  Vec3 location, lookAt, sky;
};

/// Of a scene's camera block; nullopt for one without `location` and `look_at`, which cannot be
/// steered. `schema` has the defaults.
std::optional<View> viewOf(const Block& camera, const Schema& schema);
/// The block with that view, free of transforms; lengths such as a lens' diameter keep their size.
Block withView(const Block& camera, const Schema& schema, const View& view);
/// The same camera without transforms, if it can be steered.
Block placed(const Block& camera, const Schema& schema);
/// With one number in place of the block's: angle, aperture, focus_distance.
Block withNumber(Block camera, const std::string& name, double value);
/// The number of a setting, or its default; nullopt where there is neither.
std::optional<double> numberOf(const Block& camera, const Schema& schema, const std::string& name);

/// Around look_at: `right` and `up` in radians, stopping short of the poles.
View orbit(const View& view, Real right, Real up);
/// The same turn about the camera's own place.
View turn(const View& view, Real right, Real up);
/// Sideways and up, with what is looked at; in scene units.
View pan(const View& view, Real right, Real up);
/// To `factor` times the distance of look_at.
View dolly(const View& view, Real factor);
/// Forward with what is looked at; in scene units.
View walk(const View& view, Real forward);
/// The distance from the camera to what it looks at.
Real distance(const View& view);

/// `camera thin_lens { location <0, 1, -5> ... }`, to be pasted into a scene.
std::string cameraText(const Block& camera);

}  // namespace vestige::app
