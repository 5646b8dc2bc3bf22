// SPDX-License-Identifier: Apache-2.0
// The builder's materials: BRDFs with their inputs, and plugins inside others.
#include <vestige/medium.h>

#include "engine/scene/builder_create.h"
#include "engine/scene/engine_schemas.h"

namespace vestige {

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
  // Opacity is looked up at points, as shadow rays see it: docs/adr/0010.
  const bool isFiltered = !isReal && index != m.normalMap && !row->isNonlinear;
  m.textured.push_back({index, isReal, isFiltered, Real(row->low), Real(row->high), *p});
  m.usesFootprint |= isFiltered;
  if (index == m.normalMap) m.hasNormalMap = true;
  if (index == m.opacity) m.isTranslucent = true;
}

/// A surface has one index on each side. Of several BRDFs the first that is given one counts.
void SceneBuilder::chooseIndex(Material& m, int index) {
  const Value* given = inputs_[std::size_t(index)].given;
  if (m.refractiveIndex < 0) {
    m.refractiveIndex = index;
  } else if (const Value* before = inputs_[std::size_t(m.refractiveIndex)].given; !before) {
    if (given) m.refractiveIndex = index;
  } else if (given && (given->v[0] != before->v[0] || given->kind != before->kind)) {
    diagnostics_.warning(
        given->span,
        "a surface has one refractive index: this one is not used, but that of the "
        "first brdf that is given one");
  }
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
  m.inputs = int(inputs_.size());
  for (int i = 0; i < m.inputs; ++i) {
    const Parameter& row = *inputs_[std::size_t(i)].row;
    if (row.name == kNormalMap) m.normalMap = i;
    if (row.name == kOpacity) m.opacity = i;
    if (row.isRefractiveIndex) chooseIndex(m, i);
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

void SceneBuilder::warnOfSolids() {
  if (const int most = impl_.world.solidsAtOnce(); most > MediumStack::kMost)
    diagnostics_.warning({}, fmt::format("about {} solids that refract lie around one point: rays "
                                         "follow {} of them, and the picture is wrong there",
                                         most, MediumStack::kMost));
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

/// Stand in for a medium and a phase function that were refused.
struct NoPhase final : PhaseFunction {
  ScatterValue evaluate(Vec3, Vec3) const noexcept override { return {}; }
  std::optional<PhaseSample> sample(Vec3, Vec2) const noexcept override { return std::nullopt; }
};
struct Vacuum final : Medium {
  FreeFlight fly(const Ray& ray, FlightNumbers) const noexcept override {
    return {false, ray.tMax, {1, 1, 1}};
  }
  Rgb transmittance(const Ray&, FlightNumbers) const noexcept override { return {1, 1, 1}; }
  const PhaseFunction& phase() const noexcept override { return nothing; }
  NoPhase nothing;
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
  if (!made) made = std::make_shared<Vacuum>();
  return made;
}

std::shared_ptr<const PhaseFunction> SceneBuilder::nestedPhase(const Block& block) {
  const Span place = host_.place();
  std::shared_ptr<const PhaseFunction> made = create<PhaseFunction>(block);
  host_.setPlace(place);
  if (!made) made = std::make_shared<NoPhase>();
  return made;
}

}  // namespace vestige
