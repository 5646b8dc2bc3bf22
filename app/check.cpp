// SPDX-License-Identifier: Apache-2.0
// vestige check: all that is wrong with a scene, and no picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/scene_input.h"
#include "app/terminal.h"

namespace vestige::app {
namespace {

using Json = nlohmann::ordered_json;

struct CheckRequest {
  SceneInput input;
  bool json = false;
  bool syntaxOnly = false;
};

const char* word(Severity s) {
  return s == Severity::error ? "error" : s == Severity::warning ? "warning" : "note";
}

/// A place as editors want it. None: "file" is null.
Json placeOf(const Span& span, const lang::Sources& sources) {
  const lang::Place p = lang::locate(span, sources);
  Json json = {{"file", nullptr}};
  if (p.line == 0) return json;
  json["file"] = p.file;
  json["line"] = p.line, json["column"] = p.column;
  json["end_line"] = p.endLine, json["end_column"] = p.endColumn;
  json["utf16_column"] = p.utf16Column, json["end_utf16_column"] = p.endUtf16Column;
  return json;
}

/// What a message says and where.
Json toJson(Severity severity, const Span& span, const std::string& message,
            const lang::Sources& sources) {
  Json json = {{"severity", word(severity)}, {"message", message}};
  json.update(placeOf(span, sources));
  return json;
}

/// The edits that mend diagnostic `i`: places as above, and the text to put there.
Json editsOf(const lang::Result& text, std::size_t i) {
  Json list = Json::array();
  for (const lang::Edit& e : text.edits) {
    if (e.diagnostic != i) continue;
    Json edit = placeOf(e.span, *text.sources);
    edit["text"] = e.text;
    list.push_back(edit);
  }
  return list;
}

void printJson(const lang::Result& text) {
  Json list = Json::array();
  int warnings = 0;
  for (const Diagnostic& d : text.diagnostics.list()) {
    const std::size_t index = list.size();
    Json entry = toJson(d.severity, d.span, d.message, *text.sources);
    entry["notes"] = Json::array();
    for (const Note& n : d.notes)
      entry["notes"].push_back(toJson(Severity::note, n.span, n.message, *text.sources));
    entry["edits"] = editsOf(text, index);
    list.push_back(entry);
    warnings += d.severity == Severity::warning;
  }
  const Json json = {
      {"errors", text.diagnostics.errors()}, {"warnings", warnings}, {"diagnostics", list}};
  // Scene text may hold bytes that are no UTF-8.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
}

int runCheck(const CheckRequest& request) {
  const Registry registry = loadRegistry(request.input.pluginPaths);
  const LoadedScene loaded =
      loadScene(request.input, registry, request.syntaxOnly ? Stage::text : Stage::built);
  const bool accepted = isAccepted(loaded.text, request.input.werror);
  if (request.json)
    printJson(loaded.text);
  else
    printDiagnostics(loaded.text);
  if (!request.json && loaded.text.diagnostics.list().empty())
    std::cout << request.input.file << ": nothing to complain about" << std::endl;
  return accepted ? kFine : kSceneWrong;
}

}  // namespace

void addCheck(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("check", "Say what is wrong with a scene");
  const auto request = std::make_shared<CheckRequest>();
  addSceneOptions(*command, request->input);
  command->add_flag("--json", request->json, "diagnostics as JSON on stdout, for editors");
  command->add_flag("--syntax", request->syntaxOnly,
                    "only the text: no model or image file is opened");
  addLimits(*command, request->input.limits);
  command->callback([request, &chosen] { chosen = [request] { return runCheck(*request); }; });
}

}  // namespace vestige::app
