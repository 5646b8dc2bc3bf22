// SPDX-License-Identifier: Apache-2.0
// Schemas as people and as programs read them.
#pragma once
#include <string>
#include <vector>

#include <vestige/schema.h>

namespace vestige::app {

/// Cells of one line of a table.
using Row = std::vector<std::string>;
/// Columns aligned; the last one is wrapped at words to the width.
std::string table(const std::vector<Row>& rows, int width);

/// One plugin with its parameters.
std::string schemaText(const Schema& schema, int width);

/// An array with an object a schema: kind, name, summary, parameters, children.
std::string schemasJson(const std::vector<const Schema*>& schemas);

/// "number", "colour or pigment", "<x, y, z>", "\"a\" | \"b\"".
std::string typeText(const Parameter& p);
/// As a scene would write it; "" for none.
std::string valueText(const Value& v);
/// ">= 0", "> 0", "0 .. 1", "".
std::string rangeText(const Parameter& p);

}  // namespace vestige::app
