// SPDX-License-Identifier: Apache-2.0
// The inside of a Scene: what the builder fills and integrators see as SceneView.
#pragma once
#include <memory>
#include <vector>

#include "engine/light/light_tree.h"
#include "engine/scene/material.h"
#include "engine/scene/media.h"
#include "engine/scene/scene.h"
#include "engine/texture/texture_store.h"
#include "engine/trace/world.h"

namespace vestige {

struct Scene::Impl final : Tracer, Materials, LightSet, PatchSet {
  SceneView view{*this, *this, *this, *this};
  std::shared_ptr<TextureStore> textures = std::make_shared<TextureStore>();
  World world;
  Media media;
  /// Where a pinhole camera stands, whose rays all start there, and the solids around it.
  Vec3 cameraOrigin;
  MediumStack cameraMedia;
  std::vector<Material> materials;
  std::vector<int> objectMaterial;                   ///< by Surface::object
  std::vector<ObjectInfo> objects;                   ///< by Surface::object
  std::vector<std::shared_ptr<const Shape>> shapes;  ///< kept alive
  std::vector<std::shared_ptr<Light>> ownedLights;
  std::vector<const Light*> lightList;
  std::vector<int> infinite;
  LightTable lightsByPower;
  LightTree lightTree;
  std::shared_ptr<const Camera> camera;
  std::shared_ptr<Integrator> integrator;
  std::string integratorName;
  FilmSettings film;
  std::uint64_t hash = 0;
  bool hasTextures = false;
  bool hasOneView = true;  ///< shadow rays meet what indirect rays meet

  /// After everything was added: builds the tree, see World::commit(), and the table of lights.
  void commit(const std::shared_ptr<const World::Body>& before);
  /// After the camera was set and the scene committed.
  void findCameraMedia();

  bool intersect(const Ray& ray, Surface& surface) const noexcept override {
    return media.isNone() ? world.intersect(ray, surface) : meetAmongSolids(ray, surface);
  }
  Rgb transmittance(const Ray& ray) const noexcept override;
  MediumStack mediaAt(Vec3 position) const noexcept override {
    return position == cameraOrigin ? cameraMedia : media.at(world, position);
  }
  Rgb mediumTransmittance(const Ray& ray, Real distance) const noexcept override {
    return media.transmittance(media.seenBy(ray.media, ray.kind), distance);
  }
  void shade(const Surface& surface, Vec3 toPrev, const Footprint& footprint, InputBuffer& buffer,
             Interaction& result) const noexcept override {
    interact(material(surface), surface, toPrev, footprint, media.indices(), buffer, result);
  }
  Rgb opacity(const Surface& s) const noexcept override { return material(s).opacityAt(s); }
  Rgb emitted(const Surface& surface, const Receiver& r) const noexcept override;
  Real lightPdf(const Surface& surface, const Receiver& r) const noexcept override;
  std::span<const Light* const> lights() const noexcept override { return lightList; }
  std::optional<LightChoice> chooseLight(Real u) const noexcept override {
    return lightList.empty() ? std::nullopt : std::optional(lightsByPower.choose(u));
  }
  std::optional<LightChoice> chooseLight(const Receiver& r, Real u) const noexcept override {
    return lightTree.choose(r, u);
  }
  Real lightChance(int light, const Receiver& r) const noexcept override {
    return lightTree.chance(light, r);
  }
  bool shadowsMatchIndirect() const noexcept override { return hasOneView; }
  std::span<const int> infiniteLights() const noexcept override { return infinite; }
  bool usesFootprints() const noexcept override { return hasTextures; }
  bool usesFootprint(const Surface& s) const noexcept override { return material(s).usesFootprint; }
  Vec2 texels(const Surface& s) const noexcept override { return material(s).texels(); }
  Bounds bounds() const noexcept override { return world.bounds(); }
  std::span<const Patch> patches() const noexcept override { return world.patches(); }
  SurfacePoint patchPoint(int patch, Vec2 uv) const noexcept override {
    return world.patchPoint(patch, uv);
  }
  Real patchArea(int patch, Vec2 low, Vec2 high) const noexcept override {
    return world.patchArea(patch, low, high);
  }

 private:
  /// intersect() and transmittance() where there are dielectric solids.
  bool meetAmongSolids(const Ray& ray, Surface& surface) const noexcept;
  Rgb transmittanceAmongSolids(const Ray& ray) const noexcept;
  const Material& material(const Surface& s) const noexcept {
    return materials[std::size_t(objectMaterial[std::size_t(s.object)])];
  }
};

}  // namespace vestige
