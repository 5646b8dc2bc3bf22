// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/scene.h"

#include "engine/scene/scene_impl.h"

namespace vestige {
namespace {

LightHit seenFrom(const Surface& s, Vec3 from) noexcept {
  const Vec3 d = s.position - from;
  const Real distance = length(d);
  return {from, d / distance, distance, s.position, s.geometricNormal, s.uv};
}

}  // namespace

void Scene::Impl::commit(const std::shared_ptr<const World::Body>& before) {
  world.commit(before);
  std::vector<const Material*> byObject;
  for (const int m : objectMaterial) byObject.push_back(&materials[std::size_t(m)]);
  media.build(world, byObject);
  findCameraMedia();
  for (std::size_t i = 0; i < ownedLights.size(); ++i) {
    ownedLights[i]->setScene(world.bounds());
    lightList.push_back(ownedLights[i].get());
    if (ownedLights[i]->traits().isInfinite) infinite.push_back(int(i));
  }
  for (const Placement& p : world.placements())
    hasOneView &=
        shareKind(p.visibleTo, RayKind::shadow) == shareKind(p.visibleTo, RayKind::indirect);
  std::vector<double> powers;
  for (const Light* l : lightList) powers.push_back(double(luminance(l->power())));
  lightsByPower.build(powers);
  lightTree.build(lightList);
  for (const Material& m : materials) hasTextures |= m.usesFootprint;
  for (const int i : infinite) hasTextures |= lightList[std::size_t(i)]->traits().usesSpread;
}

void Scene::Impl::findCameraMedia() {
  const auto ray = camera->sample({{Real(0.5), Real(0.5)}, {Real(0.5), Real(0.5)}, 1});
  cameraOrigin = ray ? ray->origin : Vec3{};
  cameraMedia = media.at(world, cameraOrigin);
}

bool Scene::Impl::meetAmongSolids(const Ray& ray, Surface& surface) const noexcept {
  const auto meet = [&](const Ray& r) {
    return world.intersect(r, surface) && (surface.solid == 0 || media.follow(world, r, surface));
  };
  if (!media.isRestricted()) return meet(ray);
  Ray among = ray;
  among.media = media.seenBy(ray.media, ray.kind);
  return meet(among);
}

Rgb Scene::Impl::transmittance(const Ray& ray) const noexcept {
  if (!media.isNone()) return transmittanceAmongSolids(ray);
  const auto opacity = [](const void* self, const Surface& s) {
    return static_cast<const Impl*>(self)->opacity(s);
  };
  return world.transmittance(ray, opacity, this);
}

Rgb Scene::Impl::transmittanceAmongSolids(const Ray& ray) const noexcept {
  Media::Shadow shadow{media, world, ray.direction, media.seenBy(ray.media, RayKind::shadow),
                       ray.tMin};
  const std::pair<const Impl*, Media::Shadow*> both{this, &shadow};
  const auto opacity = [](const void* context, const Surface& s) {
    const auto& [self, way] = *static_cast<const std::pair<const Impl*, Media::Shadow*>*>(context);
    return s.solid == 0 || way->pass(s) ? self->opacity(s) : Rgb{};
  };
  const Rgb share = world.transmittance(ray, opacity, &both);
  return isBlack(share) ? Rgb{} : share * shadow.transmittance(ray.tMax);
}

Rgb Scene::Impl::emitted(const Surface& s, const Receiver& r) const noexcept {
  return s.light < 0 ? Rgb{} : lightList[std::size_t(s.light)]->eval(seenFrom(s, r.position));
}

Real Scene::Impl::lightPdf(const Surface& s, const Receiver& r) const noexcept {
  if (s.light < 0) return 0;
  return lightTree.chance(s.light, r) *
         lightList[std::size_t(s.light)]->pdf(r, seenFrom(s, r.position));
}

Scene::Scene() : impl_(std::make_unique<Impl>()) {}
Scene::~Scene() = default;
const SceneView& Scene::view() const noexcept { return impl_->view; }
const Camera& Scene::camera() const noexcept { return *impl_->camera; }
Integrator& Scene::integrator() noexcept { return *impl_->integrator; }
const Integrator& Scene::integrator() const noexcept { return *impl_->integrator; }
const std::string& Scene::integratorName() const noexcept { return impl_->integratorName; }
const FilmSettings& Scene::film() const noexcept { return impl_->film; }
TextureUse Scene::textureUse() const { return impl_->textures->use(); }
std::size_t Scene::triangles() const noexcept { return impl_->world.triangles(); }
std::uint64_t Scene::hash() const noexcept { return impl_->hash; }
const ObjectInfo& Scene::object(int index) const noexcept {
  return impl_->objects[std::size_t(index)];
}

}  // namespace vestige
