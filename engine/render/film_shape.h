// SPDX-License-Identifier: Apache-2.0
// The film of a scene: its resolution, crop window and units.
#pragma once
#include "engine/film/film.h"
#include "engine/scene/scene.h"

namespace vestige {

/// Resolution of a scene's film with the command line's changes (0: the scene's), and its crop
/// window. Cheap: no storage.
struct FilmShape {
  int width, height;
  Crop crop;
};
FilmShape filmShape(const Scene& scene, int width, int height, const double crop[4]);
/// The largest distance from the origin of the camera and the finite part of the scene, scene
/// units; 1 if there is neither. A function of the scene alone.
double sceneSize(const Scene& scene);
/// An empty film of that shape, whose units follow the scene's size. The AOVs by name: the common
/// ones, or those of the scene's integrator. Throws as the constructor of Film.
Film makeFilm(const Scene& scene, int width, int height, const double crop[4],
              const std::vector<std::string>& aovs);

}  // namespace vestige
