// SPDX-License-Identifier: Apache-2.0
// The builder's shapes: which are created, which are taken over from the build before.
#include "engine/scene/builder_create.h"
#include "engine/scene/engine_schemas.h"

namespace vestige {
namespace {

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

}  // namespace

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

}  // namespace vestige
