// SPDX-License-Identifier: Apache-2.0
// The meaning of a scene text: blocks with settings, each value with its span in the text. The
// language produces it and the engine reads it; another front end may produce it too.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <vestige/diagnostic.h>
#include <vestige/function.h>
#include <vestige/math.h>
#include <vestige/shared_list.h>

namespace vestige {

struct Block;
struct List;

/// One value of the language. Numbers are double here, whatever Real is.
struct Value {
  enum class Kind {
    none,    ///< not given
    number,  ///< v[0]; true and false are 1 and 0
    vector,  ///< v[0 .. size)
    colour,  ///< red green blue filter transmit, linear Rec. 709
    text,    ///< a string, or the word of a choice
    block,   ///< a pigment in place of a constant, a footprint policy, ...
    list,    ///< of a ValueType::list or ValueType::map
    function,
  };
  Kind kind = Kind::none;
  int size = 0;  ///< 2 to 5 for a vector, 5 for a colour
  double v[5] = {};
  SharedText text;
  std::shared_ptr<const Block> block;
  std::shared_ptr<const List> list;
  std::shared_ptr<const Function> function;
  Span span;
};

/// One entry of a list, `<1, 2>`, or of a map, `[0.3 rgb 1]`.
struct Entry {
  double key = 0;  ///< of a map
  Value value;
  Span span;  ///< of the whole entry
};

struct List {
  std::vector<Entry> entries;  ///< in the order written; keys never decrease
  bool holdsBlocks = false;    ///< whether any value is a block
};

/// `name value` inside a block.
struct Setting {
  std::string name;  ///< of the schema's row; positional values carry their row's name too
  Value value;
  Span span;  ///< of the name, or of a positional value
};

/// `kind plugin { settings, children }`, checked against its schema.
struct Block {
  std::string kind;              ///< "brdf", "shape", "union", "film", ...
  std::string plugin;            ///< "phong", "sphere", ...; "" where the kind has no plugins
  Span span;                     ///< of the head, `brdf phong`
  SharedList<Setting> settings;  ///< a later one overrides an earlier one of the same name
  SharedList<Block> children;    ///< in the order written: a shape's brdf, the parts of a union
  /// Transforms written inside this block's own braces; applied to uv lookups.
  Affine own;
  /// Transform to world space: the block's own transforms, then those of the enclosing blocks that
  /// follow it.
  Affine world;

  const Value* find(const std::string& name) const noexcept {
    for (auto s = settings.rbegin(); s != settings.rend(); ++s)
      if (s->name == name) return &s->value;
    return nullptr;
  }
  /// The last child of a kind (a later brdf overrides an earlier one), or null.
  const Block* child(const std::string& childKind) const noexcept {
    for (auto b = children.rbegin(); b != children.rend(); ++b)
      if (b->kind == childKind) return &*b;
    return nullptr;
  }
  /// All children of a kind in the order written: the layers of a mixture.
  std::vector<const Block*> childrenOf(const std::string& childKind) const {
    std::vector<const Block*> found;
    for (const Block& b : children)
      if (b.kind == childKind) found.push_back(&b);
    return found;
  }
};

/// A whole scene: cameras, film, integrator, lights and shapes in the order written.
struct SceneDesc {
  std::vector<Block> blocks;
  std::vector<std::string> files;  ///< by Span::file, to find files named relative to a text
  std::uint64_t hash = 0;          ///< hash of the meaning, for the image's metadata

  /// The last block of a kind, or null. Only the last camera and the last integrator are used.
  const Block* last(const std::string& kind) const noexcept {
    for (auto b = blocks.rbegin(); b != blocks.rend(); ++b)
      if (b->kind == kind) return &*b;
    return nullptr;
  }
};

}  // namespace vestige
