// SPDX-License-Identifier: Apache-2.0
// What lies over the picture: the path that was picked, with its footprints on the surfaces.
#include <imgui.h>

#include <cmath>

#include "app/window/projection.h"
#include "app/window/window.h"

namespace vestige::app {
namespace {

constexpr ImU32 kRay = IM_COL32(255, 210, 60, 255), kBehind = IM_COL32(0, 0, 0, 160),
                kEllipse = IM_COL32(80, 220, 255, 255), kZonogon = IM_COL32(255, 90, 200, 200),
                kVector = IM_COL32(140, 255, 120, 255);
constexpr int kSegments = 40, kPieces = 24;
constexpr float kDot = 3;  ///< pixels of an ordinary display: a smaller footprint is a dot

ImVec2 vec(Vec2 v) { return {float(v.x), float(v.y)}; }

}  // namespace

void Window::drawOverlay() {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  if (isRegion_ && isDragged_)
    list.AddRect({float(downX_ / density_), float(downY_ / density_)},
                 {float(lastX_ / density_), float(lastY_ / density_)}, kRay, 0, 0, 2 * scale_);
  if (inspection_ && snapshot_ && inspection_->open == snapshot_->open) drawPath(list);
}

void Window::drawPath(ImDrawList& list) {
  const auto& vertices = inspection_->path.vertices;
  const Camera& seen = *snapshot_->camera;
  const Real aspect = Real(sheet_.width) / Real(sheet_.height);
  Vec2 last = {(Real(inspection_->x) + Real(0.5)) / Real(sheet_.width),
               (Real(inspection_->y) + Real(0.5)) / Real(sheet_.height)};
  const auto project = [&](Vec3 p) -> std::optional<Vec2> {
    const auto film = onFilm(seen, p, aspect, last);
    if (!film) return std::nullopt;
    return onWindow({film->x * Real(sheet_.width), film->y * Real(sheet_.height)});
  };
  // A line in pieces: a camera may bend it, and parts of it may lie behind the camera.
  const auto line = [&](Vec3 a, Vec3 b, ImU32 colour, float width) {
    std::optional<Vec2> before;
    for (int i = 0; i <= kPieces; ++i) {
      const auto at = project(a + Real(i) / kPieces * (b - a));
      if (at && before) list.AddLine(vec(*before), vec(*at), colour, width * scale_);
      before = at;
    }
  };
  const auto outline = [&](const std::vector<Vec3>& corners, ImU32 colour, float width) {
    std::optional<Vec2> before = corners.empty() ? std::nullopt : project(corners.back());
    for (const Vec3 c : corners) {
      const auto at = project(c);
      if (at && before) list.AddLine(vec(*before), vec(*at), colour, width * scale_);
      before = at;
    }
  };
  std::optional<Vec3> from;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const PathVertex& v = vertices[k];
    const bool isGone = v.surface.object < 0;
    const Vec3 at =
        isGone && from
            ? *from - Real(0.5) *
                          length(inspection_->open->scene().view().bounds().isEmpty()
                                     ? Vec3{1, 1, 1}
                                     : inspection_->open->scene().view().bounds().size()) *
                          v.toPrev
            : v.surface.position;
    if (from) line(*from, at, kBehind, 5), line(*from, at, kRay, 2);
    from = at;
    if (isGone) break;
    const auto middle = project(at);
    if (middle) {
      if (const auto film = onFilm(seen, at, aspect, last)) last = *film;
    }
    const Region3 r = regionOf(v, reckoning_);
    std::vector<Vec3> round;
    for (int i = 0; i < kSegments; ++i) {
      const Real t = 2 * kPi * Real(i) / kSegments;
      round.push_back(at + Real(0.5) * std::cos(t) * r.a + Real(0.5) * std::sin(t) * r.b);
    }
    std::vector<Vec3> corners;
    for (const Vec3 c : r.polygon) corners.push_back(at + c);
    outline(corners, kBehind, 3.5f), outline(corners, kZonogon, 1.5f);
    outline(round, kBehind, 4), outline(round, kEllipse, 2);
    for (const Vec3 d : r.vectors) line(at, at + Real(0.5) * d, kVector, 1.5f);
    if (!middle) continue;
    const bool isChosen = int(k) == vertex_;
    const auto dot = [&](float radius, ImU32 colour) {
      list.AddCircleFilled(vec(*middle), radius * scale_, colour);
    };
    dot(isChosen ? kDot + 3 : kDot + 1, kBehind);
    dot(isChosen ? kDot + 1.5f : kDot, isChosen ? kEllipse : kRay);
    const auto label = [&](float right, float up, ImU32 colour) {
      list.AddText({float(middle->x) + right * scale_, float(middle->y) - up * scale_}, colour,
                   std::to_string(k + 1).c_str());
    };
    label(7, 17, kBehind), label(6, 18, kRay);
  }
}

}  // namespace vestige::app
