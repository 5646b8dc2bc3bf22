// SPDX-License-Identifier: Apache-2.0
// A scene that can be rendered, and how it is made from its description.
#pragma once
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <vestige/camera.h>
#include <vestige/integrator.h>

#include "engine/scene/registry.h"
#include "engine/texture/texture_store.h"

namespace vestige {

class BuildCache;

enum class PixelFilter { box, gaussian, blackmanHarris };

struct FilmSettings {
  int width = 640, height = 480;
  PixelFilter filter = PixelFilter::box;
  double crop[4] = {0, 0, 1, 1};  ///< x0 y0 x1 y1 as shares of the film
};

/// Where an object of the scene came from, for people.
struct ObjectInfo {
  std::string shape;  ///< "sphere", "light area"
  std::string brdf;   ///< "phong"; "": reflects nothing
  Span span;          ///< of the shape in the scene's text
};

class Scene {
 public:
  Scene();
  ~Scene();
  const SceneView& view() const noexcept;
  const Camera& camera() const noexcept;
  Integrator& integrator() noexcept;
  const Integrator& integrator() const noexcept;
  const std::string& integratorName() const noexcept;
  const FilmSettings& film() const noexcept;
  TextureUse textureUse() const;
  std::size_t triangles() const noexcept;
  std::uint64_t hash() const noexcept;                 ///< of the description
  const ObjectInfo& object(int index) const noexcept;  ///< by Surface::object

  struct Impl;
  Impl& impl() noexcept { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

struct BuildOptions {
  std::string integrator = {};  ///< replaces the scene's own by name; "": the scene's, or `path`
  std::string footprint = {};   ///< bound that replaces the integrator's; "": the scene's
  /// Further settings of the integrator, as the scene would have written them; by name.
  std::vector<std::pair<std::string, Value>> settings = {};
  std::size_t textureMemory = TextureStore::kDefaultBudget;  ///< bytes, see TextureStore
  /// Receives the places of all files that were looked for, found or not; null: nobody asks.
  std::set<std::string>* files = nullptr;
  /// What the build may take over from the one before with the same cache; null: nothing.
  std::shared_ptr<BuildCache> cache = nullptr;
};

/// Null if `diagnostics` got an error: missing file, refused parameter, singular transform, ...
std::unique_ptr<Scene> buildScene(const SceneDesc& description, const Registry& registry,
                                  const BuildOptions& options, Diagnostics& diagnostics);
/// The camera, or the integrator, of a description and options in place of the scene's; nothing
/// else is built anew. False, and all as before, if `diagnostics` got an error.
bool renewCamera(Scene& scene, const SceneDesc& description, const Registry& registry,
                 Diagnostics& diagnostics);
bool renewIntegrator(Scene& scene, const SceneDesc& description, const Registry& registry,
                     const BuildOptions& options, Diagnostics& diagnostics);

}  // namespace vestige
