// SPDX-License-Identifier: Apache-2.0
// Schemas as a reference in Markdown: a page a kind, and an index.
#pragma once
#include <string>
#include <vector>

#include <vestige/schema.h>

namespace vestige::app {

struct Page {
  std::string name;  ///< of the file: "brdf.md"; "README.md" is the index
  std::string text;
};

/// The index first. `schemas` by kind, as the registry gives them.
std::vector<Page> schemaPages(const std::vector<const Schema*>& schemas);

/// Text that Markdown shows as it is, within a paragraph, a heading or a cell of a table.
std::string plainMarkdown(const std::string& text);

}  // namespace vestige::app
