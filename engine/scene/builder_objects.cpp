// SPDX-License-Identifier: Apache-2.0
// The builder's objects: shapes at their places, with visibility, material and emission.
#include <fmt/format.h>

#include <sstream>

#include "engine/light/shape_light.h"
#include "engine/scene/builder.h"
#include "engine/scene/engine_schemas.h"

namespace vestige {

RayKind SceneBuilder::visibility(const Block& block, RayKind outer) {
  static const std::map<std::string, RayKind> words = {{"camera", RayKind::camera},
                                                       {"shadow", RayKind::shadow},
                                                       {"reflection", RayKind::reflection},
                                                       {"refraction", RayKind::refraction},
                                                       {"indirect", RayKind::indirect}};
  RayKind kinds = outer;
  if (const Value* given = block.find(kVisibleTo)) {
    kinds = RayKind{};
    std::istringstream text(given->text);
    for (std::string w; text >> w;) {
      if (const auto found = words.find(w); found != words.end())
        kinds = kinds | found->second;
      else
        error(at(given->span), fmt::format("'{}' takes camera, shadow, reflection, refraction and "
                                           "indirect, found '{}'",
                                           kVisibleTo, w));
    }
  }
  const auto remove = [&](const char* row, RayKind k) {
    const Value* given = block.find(row);
    if (given && given->v[0] != 0) kinds = without(kinds, k);
  };
  remove(kNoShadow, RayKind::shadow);
  remove(kNoImage, RayKind::camera | RayKind::refraction);
  remove(kNoReflection, RayKind::reflection);
  return kinds;
}

void SceneBuilder::addShape(const Block& block, const Block* outerBrdf, RayKind outerKinds) {
  place_ = block.span;
  const RayKind visibleTo = visibility(block, outerKinds);
  // A brdf outside of a union is for the parts that have none of their own.
  const Block* brdf = block.child("brdf") ? block.child("brdf") : outerBrdf;
  if (block.kind == "union") {
    for (const Block& part : block.children)
      if (part.kind == "shape" || part.kind == "union") addShape(part, brdf, visibleTo);
    return;
  }
  const Prepared& made = prepared_.at(&block);
  report(made.said);
  const std::shared_ptr<const Shape>& shape = made.shape;
  if (!shape) return;
  if (shape->parts()) return addMeshParts(block, shape, brdf, visibleTo);
  Placement p;
  p.shape = shape;
  p.toWorld = traced(block.world);
  p.closed = shape->isClosed();
  p.visibleTo = visibleTo;
  const Value* sides = block.find(kEmissionSides);
  place(p, brdf, block.find(kEmission), sides && sides->text == "both", block);
}

void SceneBuilder::addMeshParts(const Block& block, const std::shared_ptr<const Shape>& shape,
                                const Block* brdf, RayKind visibleTo) {
  const Value* sides = block.find(kEmissionSides);
  for (const MeshPart& part : *shape->parts()) {
    Placement p;
    p.shape = shape;
    p.mesh = &part.mesh;
    p.toWorld = traced(block.world);
    p.closed = shape->isClosed();
    p.visibleTo = visibleTo;
    const Value* emission = block.find(kEmission);
    if (!emission && part.emission.kind != Value::Kind::none) emission = &part.emission;
    place(p, brdf ? brdf : part.brdf.get(), emission, sides && sides->text == "both", block);
  }
}

void SceneBuilder::place(Placement p, const Block* brdf, const Value* emission, bool bothSides,
                         const Block& shapeBlock) {
  p.object = addObject(brdf, shapeBlock.world);
  if (p.object < 0) return;
  impl_.objects.push_back({shapeBlock.plugin, brdf ? brdf->plugin : "lambert", shapeBlock.span});
  const Material& material = impl_.materials[std::size_t(impl_.objectMaterial[p.object])];
  p.translucent = material.isTranslucent;
  p.isDielectric = material.isDielectric;
  p.priority = material.priority;
  if (emission && emission->kind != Value::Kind::none)
    addEmission(p, *emission, bothSides, shapeBlock);
  if (p.light >= 0) p.isDielectric = false;  // lamps are found by their surfaces: docs/adr/0012
  impl_.world.add(p);
}

int SceneBuilder::addObject(const Block* brdf, const Affine& partToWorld) {
  static const Block plain = defaultBrdf();
  const Material material = materialFor(brdf ? *brdf : plain, partToWorld);
  if (!material.brdf) return -1;
  impl_.materials.push_back(material);
  impl_.objectMaterial.push_back(int(impl_.materials.size()) - 1);
  return int(impl_.objectMaterial.size()) - 1;
}

void SceneBuilder::addEmission(Placement& p, const Value& emission, bool bothSides,
                               const Block& shapeBlock) {
  const Real area = p.mesh ? Real(1) : p.shape->area();
  if (!(area > 0) || (p.shape && p.shape->bounds().isInfinite())) {
    error(emission.span.file >= 0 ? emission.span : shapeBlock.span,
          fmt::format(
              "'{}' has no end, so it cannot shine: use a bounded shape, or light environment",
              shapeBlock.plugin));
    return;
  }
  std::function<Rgb(const SurfacePoint&)> radiance;
  Rgb mean;
  if (emission.kind == Value::Kind::block) {
    const std::optional<PlacedPigment> placed = pigment(*emission.block, shapeBlock.world);
    if (!placed) return;
    mean = placed->pigment->mean().colour;
    radiance = [placed = *placed](const SurfacePoint& at) { return placed.eval(at, {}).colour; };
  } else {
    const InputValue c = constantInput(rgb(kEmission, 0), emission);
    mean = {c.v[0], c.v[1], c.v[2]};
    if (isBlack(mean)) return;
    radiance = [mean](const SurfacePoint&) { return mean; };
  }
  // What is cut away does not shine, and of a thin veil only its share.
  const Material& material = impl_.materials[std::size_t(impl_.objectMaterial[p.object])];
  if (material.isTranslucent) {
    // A textured opacity has its mean there, which a cutoff would make all or nothing.
    const Rgb opacity = Inputs(material.constants.data()).rgb(material.opacity);
    const bool isEven = std::none_of(material.textured.begin(), material.textured.end(),
                                     [&](const auto& t) { return t.input == material.opacity; });
    mean = (isEven ? material.cut(opacity) : opacity) * mean;
    radiance = [material, whole = std::move(radiance)](const SurfacePoint& at) {
      return material.opacityAt(at) * whole(at);
    };
  }
  p.light = int(impl_.ownedLights.size());
  impl_.ownedLights.push_back(makeShapeLight(p, radiance, bothSides, mean));
}

}  // namespace vestige
