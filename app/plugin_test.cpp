// SPDX-License-Identifier: Apache-2.0
// vestige plugin test: judges one library, which need not be installed, and tells which of its
// methods is wrong.
#include "app/plugin_test.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "app/options.h"
#include "judge/judge.h"
#include "judge/pictures.h"

namespace vestige::app {
namespace {

namespace fs = std::filesystem;

constexpr int kPluginWrong = 1;  ///< exit code: a test failed

struct TestRequest {
  std::string file, report;
  judge::Effort effort;
};

Plugin opened(const std::string& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Failure(kMachineFailed, fmt::format("there is no library '{}'", file));
  std::string why;
  // Absolute, or it would be looked for among the system's.
  const std::optional<Plugin> plugin = openPlugin(fs::absolute(file).string(), {}, why);
  if (!plugin)
    throw Failure(kMachineFailed, fmt::format("plugin library '{}' was not loaded: {}", file, why));
  return *plugin;
}

std::string reportText(const Plugin& plugin, const TestRequest& request,
                       const judge::Judgement& judgement) {
  std::string text =
      fmt::format("{} {}, version {}: {} samples, seed {}\n\n", plugin.kind, plugin.name,
                  plugin.version, request.effort.samples, request.effort.seed);
  std::string failures;
  for (const judge::Verdict& v : judgement.verdicts) {
    const char* result = !v.passed ? "FAIL" : v.events > 0 ? "pass" : "none";
    text +=
        fmt::format("{}  {:<58} {:>8} events  {}\n", result, v.test, v.events,
                    v.passed ? v.sentence : fmt::format("{:.3g} times the tolerance", v.excess));
    if (!v.passed) failures += fmt::format("\n{}\n    {}\n", v.sentence, v.worst);
  }
  text += failures;
  if (!judgement.timings.empty()) text += "\nnanoseconds a call:";
  for (const judge::Timing& t : judgement.timings)
    text += fmt::format("  {} {:.0f}", t.method, t.nanoseconds);
  if (!judgement.timings.empty()) text += "\n";
  if (!judgement.unchecked.empty()) text += "\n" + judgement.unchecked + "\n";
  return text;
}

std::string legends(const std::vector<judge::Picture>& pictures) {
  std::string text;
  for (const judge::Picture& p : pictures) text += fmt::format("\n{}: {}\n", p.file, p.legend);
  return text;
}

void writeReport(const std::string& folder, const std::string& text,
                 const std::vector<judge::Picture>& pictures) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  std::ofstream file(fs::path(folder) / "report.txt");
  if (failed || !(file << text << std::flush))
    throw Failure(kMachineFailed, fmt::format("cannot write into '{}'", folder));
  std::string error;
  if (!judge::writePictures(pictures, folder, error)) throw Failure(kMachineFailed, error);
}

int runTest(const TestRequest& request) {
  const Plugin plugin = opened(request.file);
  const judge::Judgement judgement = judge::judgePlugin(plugin, request.effort);
  std::string text = reportText(plugin, request, judgement);
  std::vector<judge::Picture> pictures;
  if (!request.report.empty()) pictures = judge::picturesOf(plugin, request.effort);
  text += legends(pictures);
  if (!request.report.empty())
    if (const std::string why = judge::leftOutPictures(plugin, pictures); !why.empty())
      text += "\n" + why + "\n";
  std::cout << text << std::flush;
  if (!request.report.empty()) writeReport(request.report, text, pictures);
  return judgement.passed() ? int(kFine) : kPluginWrong;
}

}  // namespace

void addPluginTest(CLI::App& plugin, Action& chosen) {
  CLI::App* command = plugin.add_subcommand(
      "test", "Test whether a library keeps its contract, and which method does not");
  const auto r = std::make_shared<TestRequest>();
  command->add_option("library", r->file, "the plugin, a .so file")->required()->type_name("FILE");
  addInteger(
      *command, "--samples", 64, 1 << 26, [r](auto n) { r->effort.samples = int(n); },
      "of every statistical test, per set of parameters (32768)");
  addInteger(
      *command, "--seed", 0, 1 << 30, [r](auto n) { r->effort.seed = unsigned(n); },
      "of all random numbers: the same seed finds the same (1)");
  command->add_option("--report", r->report, "write report.txt and pictures into this folder")
      ->take_last()
      ->type_name("DIR");
  command->callback([r, &chosen] { chosen = [r] { return runTest(*r); }; });
}

}  // namespace vestige::app
