// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/builder.h"

#include <fmt/format.h>

#include "engine/scene/engine_schemas.h"
#include "engine/scene/middle.h"

namespace vestige {
namespace {

/// What a shape wears that says nothing.
Block defaultBrdf() {
  Block b;
  b.kind = "brdf", b.plugin = "lambert";
  return b;
}

/// A word of a key, which cannot run into the next.
std::string word(const std::string& text) { return fmt::format("{}:{}", text.size(), text); }

/// Text that is the same for blocks that create the same shape with the same plugin: a library that
/// was built anew has another entry. "" where that cannot be told.
std::string shapeKey(const Block& block, const SceneDesc& description, const Plugin& plugin) {
  std::string key =
      fmt::format("{} {} ", fmt::ptr(plugin.entry), fmt::ptr(plugin.schema)) + word(block.plugin);
  const auto addText = [&](Span span) {  // files are looked for beside it
    const std::int32_t file = span.file;
    key += word(file >= 0 && file < int(description.files.size()) ? description.files[file] : "");
  };
  addText(block.span);
  for (const Setting& s : block.settings) {
    if (s.name == kEmission || s.name == kEmissionSides) continue;
    if (s.value.kind == Value::Kind::block) return "";
    key += word(s.name) + word(s.value.text);
    if (!s.value.text.empty()) addText(s.value.span);
    for (const double x : s.value.v) key += fmt::format("{},", x);
  }
  return key;
}

/// By whose value a plugin means a span; "": none.
std::string settingAt(Span span, const Block& block) {
  for (const Setting& s : block.settings)
    if (s.value.span.file == span.file && s.value.span.begin == span.begin &&
        s.value.span.end == span.end)
      return s.name;
  return "";
}

std::string described(const Block& block) {
  return block.plugin.empty() ? block.kind : block.kind + " " + block.plugin;
}

}  // namespace

SceneBuilder::SceneBuilder(Scene& scene, const SceneDesc& description, const Registry& registry,
                           const BuildOptions& options, Diagnostics& diagnostics)
    : description_(description),
      registry_(registry),
      options_(options),
      diagnostics_(diagnostics),
      impl_(scene.impl()),
      host_(description, *impl_.textures, diagnostics, options.files,
            options.cache ? options.cache->textures_.get() : nullptr) {}

bool SceneBuilder::build() {
  impl_.hash = description_.hash;
  impl_.textures->setBudget(options_.textureMemory);
  for (const Block& block : description_.blocks) prepareShapes(block);
  impl_.origin = findMiddle();
  for (const Block& block : description_.blocks) addTop(block);
  addCamera();
  addIntegrator();
  if (diagnostics_.hasErrors()) return false;
  impl_.commit(options_.cache ? options_.cache->world_ : nullptr);
  fillCache();
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
  if (block.kind == "shape" || block.kind == "union") addShape(block, nullptr);
}

// ---------------------------------------------------------------- plugins
bool SceneBuilder::known(const Block& block) {
  if (registry_.find(block.kind, block.plugin)) return true;
  Diagnostic& d =
      error(at(block.span), fmt::format("there is no {} called '{}'", block.kind, block.plugin));
  if (const std::string why = registry_.whyMissing(block.kind, block.plugin); !why.empty())
    d.notes.push_back({{}, why});
  return false;
}

template <class Interface>
std::shared_ptr<Interface> SceneBuilder::create(const Block& block) {
  if (!known(block)) return nullptr;
  const std::vector<Parameter>& rows = registry_.find(block.kind, block.plugin)->schema->params;
  const std::vector<Value> values = valuesFor(rows, block);
  host_.setPlace(at(block.span));
  VestigeError why{"", -1};
  auto made = registry_.create<Interface>(block.kind, block.plugin,
                                          Values(values, traced(block.world)), host_, why);
  if (!made) {
    Span span = at(block.span);
    if (why.input >= 0 && why.input < int(values.size()) && values[why.input].span.file >= 0)
      span = values[why.input].span;
    error(span, fmt::format("{}: {}", described(block), why.text));
  }
  return made;
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

// ---------------------------------------------------------------- shapes
std::shared_ptr<const Shape> SceneBuilder::shapeFor(const Block& block) {
  if (!known(block)) return nullptr;
  const std::string key = shapeKey(block, description_, *registry_.find(block.kind, block.plugin));
  if (key.empty()) return create<Shape>(block);
  if (const auto found = shapes_.find(key); found != shapes_.end()) return found->second.shape;
  if (options_.cache)
    if (const auto before = options_.cache->shapes_.find(key);
        before != options_.cache->shapes_.end() && before->second.isFresh())
      return (shapes_[key] = takeShape(before->second, block)).shape;
  return (shapes_[key] = makeShape(block)).shape;
}

const BuildCache::KeptShape& SceneBuilder::takeShape(const BuildCache::KeptShape& kept,
                                                     const Block& block) {
  ++use_.shapesTaken;
  host_.setPlace(at(block.span));
  for (const auto& [file, stamp] : kept.files)
    if (options_.files) options_.files->insert(file);
  for (const BuildCache::KeptShape::Said& said : kept.said) {
    const Value* value = block.find(said.setting);
    if (said.isNote)
      host_.note(said.message);
    else
      host_.warn(value ? value->span : Span{}, said.message);
  }
  return kept;
}

BuildCache::KeptShape SceneBuilder::makeShape(const Block& block) {
  ++use_.shapesMade;
  HostRecord record;
  host_.recordTo(&record);
  BuildCache::KeptShape made;
  made.shape = create<Shape>(block);
  host_.recordTo(nullptr);
  made.files = std::move(record.files);
  for (const HostRecord::Said& said : record.said)
    made.said.push_back({settingAt(said.span, block), said.message, said.isNote});
  return made;
}

void SceneBuilder::fillCache() {
  if (!options_.cache) return;
  BuildCache& cache = *options_.cache;
  const TextureUse textures = impl_.textures->use();
  use_.texturesTaken = textures.taken, use_.texturesMade = textures.made;
  use_.isWorldTaken = impl_.world.body() == cache.world_;
  cache.use_ = use_;
  cache.shapes_ = std::move(shapes_);
  cache.textures_ = impl_.textures;
  cache.world_ = impl_.world.body();
}

void SceneBuilder::prepareShapes(const Block& block) {
  if (block.kind == "union")
    for (const Block& part : block.children) prepareShapes(part);
  if (block.kind != "shape") return;
  place_ = block.span;
  Prepared& made = prepared_[&block];
  std::swap(diagnostics_, made.said);
  if (isInvertible(block.world, block.span)) made.shape = shapeFor(block);
  std::swap(diagnostics_, made.said);
}

/// Messages that were held back, at their place in the order of the text.
void SceneBuilder::report(const Diagnostics& held) {
  for (const Diagnostic& d : held.list()) {
    Diagnostic& said = d.severity == Severity::error     ? diagnostics_.error(d.span, d.message)
                       : d.severity == Severity::warning ? diagnostics_.warning(d.span, d.message)
                                                         : diagnostics_.note(d.span, d.message);
    said.notes = d.notes;
  }
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
  VestigeError why{"", -1};
  return registry_.create<Interface>(block.kind, block.plugin, Values(values, block.world), host,
                                     why);
}

Affine SceneBuilder::traced(const Affine& toWorld) const { return around(impl_.origin, toWorld); }

void SceneBuilder::addShape(const Block& block, const Block* outerBrdf) {
  place_ = block.span;
  // A brdf outside of a union is for the parts that have none of their own.
  const Block* brdf = block.child("brdf") ? block.child("brdf") : outerBrdf;
  if (block.kind == "union") {
    for (const Block& part : block.children)
      if (part.kind == "shape" || part.kind == "union") addShape(part, brdf);
    return;
  }
  const Prepared& made = prepared_.at(&block);
  report(made.said);
  const std::shared_ptr<const Shape>& shape = made.shape;
  if (!shape) return;
  if (shape->parts()) return addMeshParts(block, shape, brdf);
  Placement p;
  p.shape = shape, p.toWorld = traced(block.world), p.closed = shape->isClosed();
  const Value* sides = block.find(kEmissionSides);
  place(p, brdf, block.find(kEmission), sides && sides->text == "both", block);
}

void SceneBuilder::addMeshParts(const Block& block, const std::shared_ptr<const Shape>& shape,
                                const Block* brdf) {
  const Value* sides = block.find(kEmissionSides);
  for (const MeshPart& part : *shape->parts()) {
    Placement p;
    p.shape = shape, p.mesh = &part.mesh, p.toWorld = traced(block.world),
    p.closed = shape->isClosed();
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
  p.translucent = impl_.materials[std::size_t(impl_.objectMaterial[p.object])].isTranslucent;
  if (emission && emission->kind != Value::Kind::none)
    addEmission(p, *emission, bothSides, shapeBlock);
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
  p.light = int(impl_.ownedLights.size());
  impl_.ownedLights.push_back(makeShapeLight(p, radiance, bothSides, mean));
}

// ---------------------------------------------------------------- materials
std::optional<PlacedPigment> SceneBuilder::pigment(const Block& block, const Affine& outer) {
  // A file's own materials know no world: they move with the shape that brought them.
  const Affine world = block.span.file >= 0 ? block.world : outer * block.world;
  if (!isInvertible(world, at(block.span))) return std::nullopt;
  const std::shared_ptr<const Pigment> made = create<Pigment>(block);
  if (!made) return std::nullopt;
  return PlacedPigment{made, traced(world).inverse(), block.own.inverse()};
}

Material SceneBuilder::materialFor(const Block& block, const Affine& partToWorld) {
  Material m;
  const int errorsBefore = diagnostics_.errors();
  m.brdf = create<Brdf>(block);
  if (!m.brdf) return m;
  const std::vector<Parameter>& rows = registry_.schema("brdf", block.plugin)->inputs;
  if (rows.size() > kMaxInputs) {
    error(block.span, fmt::format("brdf {} declares {} inputs, at most {} are possible",
                                  block.plugin, rows.size(), kMaxInputs));
    m.brdf = nullptr;
    return m;
  }
  m.inputs = int(rows.size());
  m.normalMap = m.inputs - 2, m.opacity = m.normalMap + 1;
  for (int i = 0; i < m.inputs; ++i) {
    const Value* given = block.find(rows[i].name);
    if (!given || given->kind != Value::Kind::block) {
      m.constants[i] = constantInput(rows[i], given ? *given : rows[i].initial);
      continue;
    }
    const std::optional<PlacedPigment> p = pigment(*given->block, partToWorld);
    if (!p) continue;
    const Rgba mean = p->pigment->mean();
    m.constants[i] = {{mean.colour.r, mean.colour.g, mean.colour.b, mean.alpha}};
    const bool isReal = rows[i].type == ValueType::real;
    // What enters the light linearly may be averaged; a normal or a roughness may not [MATH T8].
    const bool isFiltered = i == m.opacity || (!isReal && i != m.normalMap && !rows[i].isNonlinear);
    m.textured.push_back({i, isReal, isFiltered, Real(rows[i].low), Real(rows[i].high), *p});
    m.usesFootprint |= isFiltered;
    if (i == m.normalMap) m.hasNormalMap = true;
    if (i == m.opacity) m.isTranslucent = true;
  }
  if (m.constants[m.opacity].v[0] < 1) m.isTranslucent = true;
  if (diagnostics_.errors() > errorsBefore) m.brdf = nullptr;
  return m;
}

// ---------------------------------------------------------------- lights, camera, the rest
void SceneBuilder::addLight(const Block& block) {
  if (!isInvertible(block.world, block.span)) return;
  const std::shared_ptr<Light> light = create<Light>(block);
  if (!light) return;
  const int index = int(impl_.ownedLights.size());
  impl_.ownedLights.push_back(light);
  if (!light->geometry()) return;
  impl_.materials.emplace_back();  // reflects nothing
  impl_.objectMaterial.push_back(int(impl_.materials.size()) - 1);
  impl_.objects.push_back({"light " + block.plugin, "", block.span});
  Placement p;
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
  if (!diagnostics_.hasErrors()) return true;
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
