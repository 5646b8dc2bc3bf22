// SPDX-License-Identifier: Apache-2.0
#include "engine/scene/builder.h"

#include <fmt/format.h>
#include <vestige/medium.h>

#include <sstream>

#include "engine/light/shape_light.h"
#include "engine/scene/aov_slots.h"
#include "engine/scene/engine_schemas.h"
#include "engine/scene/middle.h"

namespace vestige {
namespace {

/// The material of a shape that names none.
Block defaultBrdf() {
  Block b;
  b.kind = "brdf", b.plugin = "lambert";
  return b;
}

/// Whether the shape itself never sees a setting.
bool isEngineRow(const std::string& name) {
  for (const char* row :
       {kEmission, kEmissionSides, kVisibleTo, kNoShadow, kNoImage, kNoReflection})
    if (name == row) return true;
  return false;
}

/// A word of a key, which cannot run into the next.
std::string word(const std::string& text) { return fmt::format("{}:{}", text.size(), text); }

/// A value as part of a key; false where it holds a block.
bool addValue(std::string& key, const Value& value) {
  if (value.kind == Value::Kind::block) return false;
  key += word(value.text);
  for (const double x : value.v) key += fmt::format("{},", x);
  if (value.function) key += fmt::format("f{},", value.function->fingerprint());
  if (!value.list) return true;
  key += fmt::format("[{}:", value.list->entries.size());
  for (const Entry& entry : value.list->entries) {
    key += fmt::format("{},", entry.key);
    if (!addValue(key, entry.value)) return false;
  }
  return true;
}

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
    if (isEngineRow(s.name)) continue;
    key += word(s.name);
    if (!addValue(key, s.value)) return "";
    if (!s.value.text.empty() || s.value.list) addText(s.value.span);
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
            options.cache ? options.cache->textures_.get() : nullptr) {
  host_.setNested({[this](const Block* b) { return nestedBrdf(b); },
                   [this](const Block& b) { return nestedPigment(b); },
                   [this](const Block& b) { return nestedMedium(b); }});
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
  warnOfOpenSolids();
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
  VestigeError why{"", -1, -1};
  auto made = registry_.create<Interface>(block.kind, block.plugin,
                                          Values(values, traced(block.world)), host_, why);
  if (!made) {
    Span span = at(block.span);
    if (why.input >= 0 && why.input < int(values.size()) && values[why.input].span.file >= 0) {
      const Value& blamed = values[why.input];
      const int entries = blamed.list ? int(blamed.list->entries.size()) : 0;
      span = why.entry >= 0 && why.entry < entries ? blamed.list->entries[why.entry].span
                                                   : blamed.span;
    }
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
  VestigeError why{"", -1, -1};
  return registry_.create<Interface>(block.kind, block.plugin, Values(values, block.world), host,
                                     why);
}

Affine SceneBuilder::traced(const Affine& toWorld) const {
  return around(impl_.view.middle, toWorld);
}

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
  if (p.light >= 0) p.isDielectric = false;  // lamps are found by their surfaces: docs/adr/0014
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

// ---------------------------------------------------------------- materials
std::optional<PlacedPigment> SceneBuilder::pigment(const Block& block, const Affine& outer) {
  // A file's own materials know no world: they move with the shape that brought them.
  const Affine world = block.span.file >= 0 ? block.world : outer * block.world;
  if (!isInvertible(world, at(block.span))) return std::nullopt;
  const std::shared_ptr<const Pigment> made = create<Pigment>(block);
  if (!made) return std::nullopt;
  return PlacedPigment{made, traced(world).inverse(), block.own.inverse()};
}

void SceneBuilder::addInputs(const Block& block, bool isNested) {
  if (!known(block)) return;
  const std::vector<Parameter>& rows = registry_.schema("brdf", block.plugin)->inputs;
  const std::size_t own = registry_.find("brdf", block.plugin)->schema->inputs.size();
  const auto refuse = [&](const Value* given, const std::string& name) {
    if (given)
      error(given->span, fmt::format("'{}' belongs to the surface: write it in the outer brdf, not "
                                     "in one inside it",
                                     name));
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Value* given = block.find(rows[i].name);
    if (i < own || !isNested)
      inputs_.push_back({&rows[i], given});
    else
      refuse(given, rows[i].name);
  }
  for (const char* row : {kOpacityCutoff, kPriority, kAbsorption})
    if (isNested) refuse(block.find(row), row);
}

/// Constant or textured.
void SceneBuilder::evaluateInput(Material& m, int index, const Affine& partToWorld) {
  const auto [row, given] = inputs_[std::size_t(index)];
  if (!given || given->kind != Value::Kind::block) {
    m.constants[index] = constantInput(*row, given ? *given : row->initial);
    return;
  }
  const std::optional<PlacedPigment> p = pigment(*given->block, partToWorld);
  if (!p) return;
  const Rgba mean = p->pigment->mean();
  m.constants[index] = {{mean.colour.r, mean.colour.g, mean.colour.b, mean.alpha}};
  const bool isReal = row->type == ValueType::real;
  // What enters the light linearly may be averaged; a normal or a roughness may not [MATH T8].
  // Opacity is looked up at points, as shadow rays see it: docs/adr/0012.
  const bool isFiltered = !isReal && index != m.normalMap && !row->isNonlinear;
  m.textured.push_back({index, isReal, isFiltered, Real(row->low), Real(row->high), *p});
  m.usesFootprint |= isFiltered;
  if (index == m.normalMap) m.hasNormalMap = true;
  if (index == m.opacity) m.isTranslucent = true;
}

Material SceneBuilder::materialFor(const Block& block, const Affine& partToWorld) {
  Material m;
  const int errorsBefore = diagnostics_.errors();
  inputs_.clear();
  addInputs(block, false);
  firstInput_ = 0;
  std::shared_ptr<Brdf> brdf = create<Brdf>(block);
  firstInput_ = -1;
  if (!brdf || diagnostics_.errors() > errorsBefore) return m;
  if (inputs_.size() > kMaxInputs) {
    error(block.span, fmt::format("brdf {} and those inside it declare {} inputs, at most {} are "
                                  "possible",
                                  block.plugin, inputs_.size(), kMaxInputs));
    return m;
  }
  m.batch = static_cast<const BrdfBatch*>(registry_.find("brdf", block.plugin)->entry->batch);
  m.inputs = int(inputs_.size());
  for (int i = m.inputs - 1; i >= 0; --i) {  // of several indices the outermost counts
    const Parameter& row = *inputs_[std::size_t(i)].row;
    if (row.name == kNormalMap) m.normalMap = i;
    if (row.name == kOpacity) m.opacity = i;
    if (row.isRefractiveIndex) m.refractiveIndex = i;
  }
  for (int i = 0; i < m.inputs; ++i) evaluateInput(m, i, partToWorld);
  if (const Value* given = block.find(kPriority)) m.priority = int(given->v[0]);
  if (const Value* given = block.find(kAbsorption)) {
    const InputValue a = constantInput(rgb(kAbsorption, 0), *given);
    m.absorption = {a.v[0], a.v[1], a.v[2]};
  }
  if (const Value* cutoff = block.find(kOpacityCutoff)) m.cutoff = Real(cutoff->v[0]);
  if (!isOpaque(m.cut(Inputs(m.constants.data()).rgb(m.opacity)))) m.isTranslucent = true;
  if (diagnostics_.errors() > errorsBefore) return m;
  m.brdf = std::move(brdf);
  m.isDielectric = m.refractiveIndex >= 0 && m.transmits();
  return m;
}

void SceneBuilder::warnOfOpenSolids() {
  std::vector<bool> isSolid(impl_.objects.size());
  for (int k = 1; k <= impl_.world.solids(); ++k)
    isSolid[std::size_t(impl_.world.solid(std::uint32_t(k)).object)] = true;
  for (std::size_t k = 0; k < impl_.objects.size(); ++k) {
    const Material& m = impl_.materials[std::size_t(impl_.objectMaterial[k])];
    if (isSolid[k] || (isBlack(m.absorption) && m.priority == 0)) continue;
    diagnostics_.warning(impl_.objects[k].span,
                         fmt::format("'{}' and '{}' do nothing here: they are for solids that "
                                     "refract, which are closed (a mesh: watertight) and do not "
                                     "shine",
                                     kPriority, kAbsorption));
  }
}

// ---------------------------------------------------------------- plugins inside others
namespace {

/// Stands in for a BRDF that was refused; nothing is rendered with it.
class NoBrdf final : public Brdf {
  ScatterValue evaluate(const ScatterPoint&, Vec3) const noexcept override { return {}; }
  std::optional<ScatterSample> sample(const ScatterPoint&, ScatterNumbers) const noexcept override {
    return std::nullopt;
  }
};

/// A pigment inside another: the outer one asks it in the outer one's space.
class InnerPigment final : public Pigment {
 public:
  InnerPigment(std::shared_ptr<const Pigment> pigment, const Affine& own)
      : placed_{std::move(pigment), own.inverse(), own.inverse()} {}
  Rgba eval(const Lookup& at) const noexcept override { return placed_.eval(at); }
  Rgba mean() const noexcept override { return placed_.pigment->mean(); }
  std::optional<PatternValue> pattern(const Lookup& at) const noexcept override {
    return placed_.pigment->pattern(placed_.inside(at));
  }
  Vec2 texels() const noexcept override { return placed_.texels(); }

 private:
  PlacedPigment placed_;
};

}  // namespace

NestedBrdf SceneBuilder::nestedBrdf(const Block* block) {
  static const Block plain = defaultBrdf();
  const Block& inner = block ? *block : plain;
  const int first = int(inputs_.size()), outer = firstInput_;
  const Span place = host_.place();
  std::shared_ptr<Brdf> brdf;
  if (outer < 0) {
    error(at(inner.span), "only a brdf can hold another brdf");
  } else {
    addInputs(inner, true);
    firstInput_ = first;
    brdf = create<Brdf>(inner);
    firstInput_ = outer;
  }
  host_.setPlace(place);
  if (!brdf) return {std::make_shared<NoBrdf>(), 0};
  return {brdf, first - outer};
}

std::shared_ptr<const Pigment> SceneBuilder::nestedPigment(const Block& block) {
  const Span place = host_.place();
  std::shared_ptr<const Pigment> made;
  if (isInvertible(block.own, at(block.span))) made = create<Pigment>(block);
  host_.setPlace(place);
  struct Black final : Pigment {
    Rgba eval(const Lookup&) const noexcept override { return {}; }
  };
  if (!made) return std::make_shared<Black>();
  return std::make_shared<InnerPigment>(std::move(made), block.own);
}

std::shared_ptr<const Medium> SceneBuilder::nestedMedium(const Block& block) {
  const Span place = host_.place();
  std::shared_ptr<const Medium> made = create<Medium>(block);
  host_.setPlace(place);
  struct Isotropic final : PhaseFunction {
    ScatterValue evaluate(Vec3, Vec3) const noexcept override { return {}; }
    std::optional<PhaseSample> sample(Vec3, Vec2) const noexcept override { return std::nullopt; }
  };
  struct Vacuum final : Medium {
    FreeFlight fly(const Ray& ray, FlightNumbers) const noexcept override {
      return {false, ray.tMax, {1, 1, 1}};
    }
    Rgb transmittance(const Ray&, FlightNumbers) const noexcept override { return {1, 1, 1}; }
    const PhaseFunction& phase() const noexcept override { return phase_; }
    Isotropic phase_;
  };
  return made ? made : std::make_shared<Vacuum>();
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
