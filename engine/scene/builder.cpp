// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/builder.h"

#include <fmt/format.h>

#include "engine/scene/aov_slots.h"
#include "engine/scene/builder_create.h"
#include "engine/scene/engine_schemas.h"
#include "engine/scene/middle.h"

namespace vestige {

SceneBuilder::SceneBuilder(Scene& scene, const SceneDesc& description, const Registry& registry,
                           const BuildOptions& options, Diagnostics& diagnostics)
    : description_(description),
      registry_(registry),
      options_(options),
      diagnostics_(diagnostics),
      impl_(scene.impl()),
      host_(description, *impl_.textures, diagnostics, options.files,
            options.cache ? options.cache->textures_.get() : nullptr) {
  host_.setNested({[this](const Block* b) { return nestedBrdf(b); },
                   [this](const Block& b) { return nestedPigment(b); },
                   [this](const Block& b) { return nestedMedium(b); },
                   [this](const Block& b) { return nestedPhase(b); }});
}

bool SceneBuilder::build() {
  impl_.hash = description_.hash;
  impl_.textures->setBudget(options_.textureMemory);
  for (const Block& block : description_.blocks) prepareShapes(block);
  impl_.view.middle = findMiddle();
  for (const Block& block : description_.blocks) addTop(block);
  addCamera();
  addIntegrator();
  if (diagnostics_.hasErrors()) return false;
  impl_.commit(options_.cache ? options_.cache->world_ : nullptr);
  fillCache();
  warnOfSolids();
  if (const std::size_t n = impl_.world.dropped())
    diagnostics_.warning({},
                         fmt::format("left out {} triangles that have no area or a corner that is "
                                     "not a finite number",
                                     n));
  if (impl_.objectMaterial.empty() && impl_.infinite.empty())
    diagnostics_.warning({},
                         "the scene holds no shape and no environment: the picture will be black");
  else if (impl_.lightList.empty())
    diagnostics_.warning({}, "the scene holds no light: the picture will be black");
  return true;
}

void SceneBuilder::addTop(const Block& block) {
  if (block.kind == "film") readFilm(block);
  if (block.kind == "light") addLight(block);
  if (block.kind == "shape" || block.kind == "union") addShape(block, nullptr, RayKind::any);
}

bool SceneBuilder::known(const Block& block) {
  if (registry_.find(block.kind, block.plugin)) return true;
  Diagnostic& d =
      error(at(block.span), fmt::format("there is no {} called '{}'", block.kind, block.plugin));
  if (const std::string why = registry_.whyMissing(block.kind, block.plugin); !why.empty())
    d.notes.push_back({{}, why});
  return false;
}

bool SceneBuilder::isInvertible(const Affine& transform, Span place) {
  // Relative to the lengths of the columns: a scene in nanometres is no error.
  const Mat3 l = transform.linear();
  const double size = double(length(l.c[0])) * length(l.c[1]) * length(l.c[2]);
  const double d = transform.determinant();
  if (std::isfinite(d) && std::abs(d) > 1e-9 * size && size > 0) return true;
  error(place, "its transforms flatten it to no thickness (a scale of 0, or a singular matrix)");
  return false;
}

// ---------------------------------------------------------------- the space it is traced in
/// Shapes say where a scene stands; where all of them are endless, lamps and the camera do.
Vec3 SceneBuilder::findMiddle() {
  Bounds extent;
  const auto add = [&](const Bounds& b) {
    if (!b.isInfinite()) extent.add(b);
  };
  for (const auto& [block, made] : prepared_)
    if (made.shape) add(boundsIn(*made.shape, block->world));
  if (!extent.isEmpty()) return middleOf(extent);
  for (const Block& block : description_.blocks)
    if (block.kind == "light")
      if (const auto light = tryOut<Light>(block)) add(light->extent().box);
  if (const Block* block = description_.last("camera"))
    if (const auto camera = tryOut<Camera>(*block))
      if (const auto ray = camera->sample({{Real(0.5), Real(0.5)}, {Real(0.5), Real(0.5)}, 1}))
        extent.add(ray->origin);
  return middleOf(extent);
}

/// Created in world space to see where it stands, without a word to the user: it is created again,
/// where it is placed. Null as well where that would read files or make other plugins.
template <class Interface>
std::shared_ptr<Interface> SceneBuilder::tryOut(const Block& block) const {
  const Plugin* plugin = registry_.find(block.kind, block.plugin);
  if (!plugin) return nullptr;
  const std::vector<Value> values = valuesFor(plugin->schema->params, block);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i].kind == Value::Kind::block ||
        (plugin->schema->params[i].type == ValueType::file && !values[i].text.empty()))
      return nullptr;
  Diagnostics unheard;
  SceneHost host(description_, *impl_.textures, unheard, nullptr, nullptr);
  VestigeError why{"", -1, -1};
  return registry_.create<Interface>(block.kind, block.plugin, Values(values, block.world), host,
                                     why);
}

Affine SceneBuilder::traced(const Affine& toWorld) const {
  return around(impl_.view.middle, toWorld);
}

// ---------------------------------------------------------------- lights, camera, the rest
void SceneBuilder::addLight(const Block& block) {
  if (!isInvertible(block.world, block.span)) return;
  const std::shared_ptr<Light> light = create<Light>(block);
  if (!light) return;
  const int index = int(impl_.ownedLights.size());
  impl_.ownedLights.push_back(light);
  const RayKind visibleTo = visibility(block, RayKind::any);
  if (!light->geometry()) {
    if (visibleTo != RayKind::any)
      error(block.span, fmt::format("light {} has no surface that rays could meet: leave out '{}', "
                                    "'{}', '{}' and '{}'",
                                    block.plugin, kVisibleTo, kNoShadow, kNoImage, kNoReflection));
    return;
  }
  if (!shareKind(visibleTo, RayKind::indirect))
    error(block.span, fmt::format("light {} must be visible to indirect rays: they are what it "
                                  "lights surfaces by",
                                  block.plugin));
  impl_.materials.emplace_back();  // reflects nothing
  impl_.objectMaterial.push_back(int(impl_.materials.size()) - 1);
  impl_.objects.push_back({"light " + block.plugin, "", block.span});
  Placement p;
  p.visibleTo = visibleTo;
  p.mesh = light->geometry(), p.object = int(impl_.objectMaterial.size()) - 1, p.light = index;
  impl_.world.add(p);
}

void SceneBuilder::addCamera() {
  const Block* block = description_.last("camera");
  if (!block) {
    error({},
          "the scene has no camera: write one, as 'camera pinhole { location <0, 1, -5> look_at "
          "<0, 1, 0> }'");
    return;
  }
  if (isInvertible(block->world, block->span)) impl_.camera = create<Camera>(*block);
}

void SceneBuilder::addIntegrator() {
  Block wanted;
  wanted.kind = "integrator", wanted.plugin = "path";
  if (const Block* block = description_.last("integrator")) wanted = *block;
  if (!options_.integrator.empty() && options_.integrator != wanted.plugin) {
    wanted = {};
    wanted.kind = "integrator", wanted.plugin = options_.integrator;
  }
  const Schema* schema = registry_.schema("integrator", wanted.plugin);
  if (!options_.footprint.empty() && schema && !schema->find("footprint"))
    diagnostics_.warning(wanted.span, "integrator " + wanted.plugin +
                                          " has no footprints: '--footprint " + options_.footprint +
                                          "' changes nothing");
  else if (!options_.footprint.empty() && schema) {
    auto footprint = std::make_shared<Block>();
    footprint->kind = "footprint", footprint->plugin = options_.footprint;
    Value value;
    value.kind = Value::Kind::block, value.block = std::move(footprint);
    wanted.settings.push_back({"footprint", value, {}});
  }
  for (const auto& [word, value] : options_.settings) {
    if (schema && schema->find(word))
      wanted.settings.push_back({word, value, {}});
    else
      diagnostics_.error(wanted.span,
                         fmt::format("integrator {} has no '{}', which the command line asks for",
                                     wanted.plugin, word));
  }
  impl_.integrator = create<Integrator>(wanted);
  impl_.integratorName = wanted.plugin;
  if (!impl_.integrator) return;
  if (const std::string wrong = whatIsWrong(impl_.integrator->aovs()); !wrong.empty())
    error(wanted.span, fmt::format("integrator {} {}", wanted.plugin, wrong));
}

void SceneBuilder::readFilm(const Block& block) {
  const std::vector<Value> v = valuesFor(registry_.schema("film", "")->params, block);
  impl_.film.width = int(v[0].v[0]), impl_.film.height = int(v[0].v[1]);
  impl_.film.filter = v[1].text == "gaussian"          ? PixelFilter::gaussian
                      : v[1].text == "blackman_harris" ? PixelFilter::blackmanHarris
                                                       : PixelFilter::box;
  std::copy(v[2].v, v[2].v + 4, impl_.film.crop);
  if (!(v[2].v[0] < v[2].v[2] && v[2].v[1] < v[2].v[3]))
    error(v[2].span,
          "crop is <left, top, right, bottom>: left must be less than right and top less "
          "than bottom");
}

Diagnostic& SceneBuilder::error(Span span, std::string message) {
  return diagnostics_.error(span, std::move(message));
}

bool SceneBuilder::renewCamera() {
  const auto before = impl_.camera;
  addCamera();
  if (!diagnostics_.hasErrors()) {
    impl_.findCameraMedia();
    return true;
  }
  impl_.camera = before;
  return false;
}

bool SceneBuilder::renewIntegrator() {
  const auto before = impl_.integrator;
  const std::string name = impl_.integratorName;
  addIntegrator();
  if (!diagnostics_.hasErrors()) return true;
  impl_.integrator = before, impl_.integratorName = name;
  return false;
}

std::unique_ptr<Scene> buildScene(const SceneDesc& description, const Registry& registry,
                                  const BuildOptions& options, Diagnostics& diagnostics) {
  auto scene = std::make_unique<Scene>();
  return SceneBuilder(*scene, description, registry, options, diagnostics).build()
             ? std::move(scene)
             : nullptr;
}

bool renewCamera(Scene& scene, const SceneDesc& description, const Registry& registry,
                 Diagnostics& diagnostics) {
  return SceneBuilder(scene, description, registry, {}, diagnostics).renewCamera();
}

bool renewIntegrator(Scene& scene, const SceneDesc& description, const Registry& registry,
                     const BuildOptions& options, Diagnostics& diagnostics) {
  return SceneBuilder(scene, description, registry, options, diagnostics).renewIntegrator();
}

}  // namespace vestige
