// SPDX-License-Identifier: Apache-2.0
// vestige compare: how far a picture is from a reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/output.h"
#include "engine/picture/compare.h"

namespace vestige::app {
namespace {

struct CompareRequest {
  std::string picture, reference, differenceFile;
  bool json = false;
};

Image readPicture(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw Failure(kCommandLineWrong, fmt::format("there is no picture '{}'", file));
  std::string error;
  Image image = readImage(file, error);
  if (image.width == 0) throw Failure(kCommandLineWrong, error);
  if (image.channels.size() < 3)
    throw Failure(kCommandLineWrong,
                  fmt::format("'{}' has {} of the three channels R, G, B that are compared", file,
                              image.channels.size()));
  return image;
}

void printText(const Comparison& c) {
  const auto row = [](const char* name, const std::string& value, const char* meaning) {
    std::cout << fmt::format("{:<17} {:<28} {}\n", name, value, meaning);
  };
  row("RMSE", fmt::format("{:.6g}", c.rmse), "root of the mean squared difference");
  row("relMSE", fmt::format("{:.6g}", c.relMse), "mean of (a - b)^2 / (b^2 + 0.01)");
  row("relMSE trimmed", fmt::format("{:.6g}", c.relMseTrimmed),
      "without the worst 0.1 % of pixels");
  row("mean ratio",
      fmt::format("{:.5f} {:.5f} {:.5f}", c.meanRatio[0], c.meanRatio[1], c.meanRatio[2]),
      "mean of a / mean of b: red, green, blue");
  row("block difference", fmt::format("{:.6g}", c.blockDifference),
      "of 16 x 16 block means, relative, on average");
  row("FLIP", fmt::format("{:.6g}", c.flip), "difference that an eye sees, 0 to 1");
  std::cout << std::flush;
}

void printJson(const Comparison& c) {
  const nlohmann::ordered_json json = {{"rmse", c.rmse},
                                       {"rel_mse", c.relMse},
                                       {"rel_mse_trimmed", c.relMseTrimmed},
                                       {"mean_ratio", c.meanRatio},
                                       {"block_difference", c.blockDifference},
                                       {"flip", c.flip}};
  std::cout << json.dump(2) << std::endl;
}

int runCompare(const CompareRequest& request) {
  const OutputOptions output{request.differenceFile.empty()
                                 ? std::vector<std::string>{}
                                 : std::vector<std::string>{request.differenceFile},
                             {},
                             false};
  checkOutputs(output, false);
  const Image a = readPicture(request.picture), b = readPicture(request.reference);
  if (a.width != b.width || a.height != b.height)
    throw Failure(
        kCommandLineWrong,
        fmt::format("the pictures differ in size: '{}' is {} x {}, '{}' is {} x {}",
                    request.picture, a.width, a.height, request.reference, b.width, b.height));
  Image difference;
  const Comparison c = compareImages(a, b, output.files.empty() ? nullptr : &difference);
  if (request.json)
    printJson(c);
  else
    printText(c);
  std::string error;
  if (!output.files.empty() && !writeImage(output.files[0], difference, {}, error))
    throw Failure(kMachineFailed, error);
  return kFine;
}

}  // namespace

void addCompare(CLI::App& program, Action& chosen) {
  CLI::App* command = program.add_subcommand("compare", "Measure how two pictures differ");
  const auto request = std::make_shared<CompareRequest>();
  command->add_option("picture", request->picture, "the picture in question")
      ->required()
      ->type_name("FILE");
  command->add_option("reference", request->reference, "what it should look like")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--output", request->differenceFile, "write a picture of the difference")
      ->take_last()
      ->type_name("FILE");
  command->add_flag("--json", request->json, "numbers as JSON");
  command->callback([request, &chosen] { chosen = [request] { return runCompare(*request); }; });
}

}  // namespace vestige::app
