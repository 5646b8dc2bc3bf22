// SPDX-License-Identifier: Apache-2.0
// What the window says: the line at the bottom, what is wrong with the text, the list of keys.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "app/terminal.h"
#include "app/window/layers.h"
#include "app/window/widgets.h"

namespace vestige::app {
namespace {

constexpr const char* kHelp = R"(left drag      turn around what is looked at
right drag     look around
middle drag, shift + left drag   move sideways
wheel          nearer, farther
W A S D E X    walk, rise, sink
F, click       look there, and make it sharp
click          inspect the path of that pixel
Z              undo a movement     Home  the text's camera
C              the camera as text, to the clipboard
N              the next integrator

ctrl + wheel   zoom the picture    0  fit    1  one to one
ctrl + drag    move the picture
R, drag        render a part       Escape  all again
Space          pause
. ,            exposure up, down
B              keep this picture   V  beside it / difference
P              save the picture    F12  save the window
F5             read the scene again
Tab            hide the panels     H  this help
ctrl + Q       close)";

/// A path is told as it was given; but one in another folder than this one is long.
std::string shortened(std::string text) {
  std::error_code failed;
  const std::string here = std::filesystem::current_path(failed).string() + '/';
  for (std::size_t at; (at = text.find(here)) != text.npos;) text.erase(at, here.size());
  return text;
}

/// Resident memory of this process, bytes.
double memory() {
  double pages = 0;
  if (FILE* f = std::fopen("/proc/self/statm", "r")) {
    double all = 0;
    if (std::fscanf(f, "%lf %lf", &all, &pages) != 2) pages = 0;
    std::fclose(f);
  }
  return pages * double(sysconf(_SC_PAGESIZE));
}

std::string bytesText(double bytes) {
  return bytes > 1e9 ? fmt::format("{:.2f} GB", bytes / 1e9)
                     : fmt::format("{:.0f} MB", bytes / 1e6);
}

}  // namespace

void Window::drawComplaints() {
  if (!preview_) return;
  const Status s = preview_->status();
  if (s.complaints.empty() || (hidesWarnings_ && !s.isWrong)) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float margin = 12 * scale_;
  ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_Always);
  ImGui::SetNextWindowSizeConstraints({0, 0},
                                      {std::max(200 * scale_, size.x - panelWidth() - 2 * margin),
                                       std::max(80 * scale_, size.y * 0.6f)});
  ImGui::SetNextWindowBgAlpha(0.88f);
  ImGui::PushStyleColor(ImGuiCol_Border,
                        s.isWrong ? IM_COL32(255, 80, 60, 255) : IM_COL32(230, 180, 60, 255));
  bool isOpen = true;
  ImGui::Begin(s.isWrong ? "Not what is wanted: an older picture is shown###complaints"
                         : "The scene has warnings###complaints",
               s.isWrong ? nullptr : &isOpen,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_HorizontalScrollbar);
  int shown = 0;
  for (const Complaint& c : s.complaints) {
    if (++shown > 6) {
      text(fmt::format("... and {} more", s.complaints.size() - 6));
      break;
    }
    ImGui::PushID(shown);
    ImGui::PushStyleColor(ImGuiCol_Text, c.severity == Severity::error
                                             ? IM_COL32(255, 150, 130, 255)
                                             : IM_COL32(255, 220, 130, 255));
    text(shortened(c.text));
    ImGui::PopStyleColor();
    if (c.place.line > 0) {
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("click: open in the editor");
      if (ImGui::IsItemClicked()) openInEditor(c.place);
    }
    ImGui::PopID();
  }
  ImGui::End();
  ImGui::PopStyleColor();
  if (!isOpen) hidesWarnings_ = true;
}

void Window::drawStatus() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, size.y - statusHeight()});
  ImGui::SetNextWindowSize({size.x, statusHeight()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale_, 5 * scale_});
  ImGui::Begin(
      "status", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  std::string line;
  if (preview_) {
    const Status s = preview_->status();
    line = s.phase;
    if (s.phase == "preparing") line += fmt::format(" {:.0f} %", 100 * s.share);
    if (snapshot_) line += fmt::format("   {}", count(snapshot_->samples, "sample"));
    if (s.wanted > 0 && s.phase == "rendering") line += fmt::format(" of {}", s.wanted);
    if (s.remaining >= 0 && s.phase == "rendering")
      line += fmt::format("   {} left", durationText(s.remaining));
    if (snapshot_) line += fmt::format("   {}", durationText(snapshot_->seconds));
    if (const double noise = noiseOf(shown_); snapshot_ && layer_.empty() && noise > 0)
      line += fmt::format("   noise {:.3f}", noise);
    if (s.raysPerSecond > 0) line += fmt::format("   {:.2f} Mrays/s", s.raysPerSecond / 1e6);
    line += fmt::format("   first picture {:.0f} ms", 1000 * s.firstPicture);
  }
  line += fmt::format("   {} x {}", sheet_.width, sheet_.height);
  if (screen_->step() > 1) line += fmt::format(", shown at 1/{}", screen_->step());
  line += fmt::format("   {:.0f} %   {}", 100.0 * double(sheet_.zoom), bytesText(memory()));
  if (glfwGetTime() < messageUntil_) line = message_;
  text(line);
  ImGui::SameLine(size.x - 70 * scale_);
  text("H: help");
  ImGui::End();
  ImGui::PopStyleVar();
}

void Window::drawHelp() {
  ImGui::Begin("Keys and mouse", &showsHelp_,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  text(kHelp);
  ImGui::End();
}

}  // namespace vestige::app
