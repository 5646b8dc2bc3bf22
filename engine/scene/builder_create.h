// SPDX-License-Identifier: Apache-2.0
// How the builder creates a plugin of a block: included by its parts only.
#pragma once
#include <fmt/format.h>

#include <new>
#include <string_view>

#include "engine/scene/builder.h"

namespace vestige {

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
    const bool isMemory = std::string_view(why.text) == std::bad_alloc().what();
    error(span, fmt::format("{} {}: {}", block.kind, block.plugin,
                            isMemory ? "is too large for the memory of this machine" : why.text));
  }
  return made;
}

}  // namespace vestige
